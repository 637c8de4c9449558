// hedgerow/triangulate.h and the flips of hedgerow/edit.h.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "hedgerow/delaunay.h"
#include "hedgerow/edit.h"
#include "hedgerow/triangulate.h"
#include "hedgerow/voronoi.h"
#include "peers/planar.h"
#include "runner.h"

namespace hedgerow::bench {

namespace {

std::vector<Point2> points_of(const Dataset& data) {
  const Positions positions = data.positions();
  std::vector<Point2> points(static_cast<std::size_t>(positions.count));
  for (std::size_t i = 0; i < points.size(); ++i) {
    const float* xyz = positions[static_cast<Index>(i)];
    points[i] = {double{xyz[0]}, double{xyz[1]}};
  }
  return points;
}

/// Reads the points; writes the three columns.
Traffic triangulation_traffic(const Dataset& data) {
  const auto [halfedges, vertices, faces] = counts_of(data);
  return {2 * sizeof(double) * vertices, kIndexBytes * (2 * halfedges + vertices)};
}

/// The dataset was triangulated from its own points, so its mesh is the answer.
Work prepare_triangulation(const Dataset& data, const Execution& execution) {
  auto points = std::make_shared<std::vector<Point2>>(points_of(data));
  auto output = std::make_shared<std::optional<Triangulation>>();
  Work work;
  work.run = [points, execution, output] {
    Result<Triangulation> result = triangulate(*points, execution);
    if (result) output->emplace(std::move(*result));
  };
  work.cleanup = [output] { output->reset(); };
  work.check = [&data, output]() -> std::string {
    if (!output->has_value()) return "triangulation failed; not measured";
    const bool is_right = std::ranges::equal((*output)->mesh.opposite(), data.reference().opposite);
    return is_right ? "" : "other opposites than the reference; not measured";
  };
  work.digest = [output] { return output->has_value() ? digest_of((*output)->mesh) : 0; };
  work.notes = [points]() -> Notes { return {{"points", static_cast<double>(points->size())}}; };
  return work;
}

[[maybe_unused]] Work prepare_peer(const Dataset& data) {
  auto points = std::make_shared<std::vector<Point2>>(points_of(data));
  auto faces = std::make_shared<Index>(0);
  Work work;
  work.run = [points, faces] { *faces = count_cgal_triangles(*points); };
  work.check = [&data, faces] {
    return *faces == data.mesh.face_count() ? "" : "another number of faces; not measured";
  };
  work.digest = [faces] { return static_cast<std::uint64_t>(*faces); };
  work.notes = [points]() -> Notes { return {{"points", static_cast<double>(points->size())}}; };
  return work;
}

Work prepare_voronoi(const Dataset& data, const Execution& execution) {
  auto points = std::make_shared<std::vector<Point2>>(points_of(data));
  auto output = std::make_shared<std::optional<Voronoi>>();
  const Box2 box = box_round(*points);
  Work work;
  work.run = [points, execution, output, box] {
    Result<Voronoi> result = voronoi(*points, box, execution);
    if (result) output->emplace(std::move(*result));
  };
  work.cleanup = [output] { output->reset(); };
  work.check = [output, box]() -> std::string {
    if (!output->has_value()) return "no diagram; not measured";
    double sum = 0;
    for (Index f = 0; f < (*output)->mesh.face_count(); ++f) sum += cell_area(**output, FaceId(f));
    const double area = (box.high[0] - box.low[0]) * (box.high[1] - box.low[1]);
    return std::abs(sum - area) < 1e-9 * area ? "" : "cells do not fill the box; not measured";
  };
  work.digest = [output] { return output->has_value() ? digest_of((*output)->mesh) : 0; };
  work.notes = [points]() -> Notes { return {{"points", static_cast<double>(points->size())}}; };
  return work;
}

/// A mesh that is edited, and edges of it that do not meet and may be flipped for ever.
struct Flips {
  EditMesh mesh;
  std::vector<HalfedgeId> edges;
};
std::shared_ptr<Flips> make_flips(const Dataset& data) {
  auto flips = std::make_shared<Flips>();
  flips->mesh = std::move(*EditMesh::of(data.mesh, Execution::serial()));
  flips->mesh.set_recording(false);
  std::vector<HalfedgeId> all;
  const EditView view = flips->mesh.view();
  for (HalfedgeId h(0); h.value < view.halfedge_count(); ++h.value) {
    if (h < view.opposite[h]) all.push_back(h);
  }
  flips->edges = flips->mesh.flip_batch(all, Execution::serial()).done;
  // What may be flipped back may be flipped again.
  flips->edges = flips->mesh.flip_batch(flips->edges, Execution::serial()).done;
  return flips;
}

/// Of each flip: six half-edges with four entries, read and written, and both faces.
Traffic flip_traffic(const Dataset& data) {
  const double flips = counts_of(data).faces / 2;
  return {kIndexBytes * 26 * flips, kIndexBytes * 26 * flips};
}

Work prepare_flips(const Dataset& data, const Execution& execution, bool is_batch) {
  const std::shared_ptr<Flips> flips = make_flips(data);
  auto done = std::make_shared<std::size_t>(0);
  Work work;
  work.run = [flips, execution, is_batch, done] {
    *done = 0;
    if (is_batch) {
      *done = flips->mesh.flip_batch(flips->edges, execution).done.size();
    } else {
      for (const HalfedgeId h : flips->edges) *done += flips->mesh.flip(h) ? 1 : 0;
    }
  };
  work.check = [flips, done] {
    return *done == flips->edges.size() ? "" : "flips were refused; not measured";
  };
  // The number is the answer: the mesh goes to and fro between runs.
  work.digest = [done] { return static_cast<std::uint64_t>(*done); };
  work.notes = [flips]() -> Notes { return {{"flips", static_cast<double>(flips->edges.size())}}; };
  return work;
}

void add_flips(const DatasetKey& key, const Plan& plan) {
  add({"flip", key, 1, "",
       [](const Dataset& data, const Execution& execution) {
         return prepare_flips(data, execution, false);
       },
       flip_traffic, Mix::copy});
  for (const int threads : plan.threads) {
    add({"flip", key, threads, "batch",
         [](const Dataset& data, const Execution& execution) {
           return prepare_flips(data, execution, true);
         },
         flip_traffic, Mix::copy});
  }
}

/// Made anew between the runs, for each leaves nothing to flip.
Work prepare_surface(const Dataset& data, const Execution& execution, DelaunayOrder order) {
  auto mesh = std::make_shared<EditMesh>();
  auto report = std::make_shared<DelaunayReport>();
  const auto renew = [&data, mesh] { *mesh = std::move(*EditMesh::of(data.mesh, Execution())); };
  renew();
  Work work;
  work.run = [&data, mesh, report, execution, order] {
    DelaunayOptions options;
    options.order = order;
    const auto result = flip_to_delaunay(*mesh, data.positions(), options, execution);
    *report = result.value_or(DelaunayReport{});
  };
  work.cleanup = renew;
  work.check = [report] {
    return report->flips > 0 && report->left == 0 ? "" : "edges are left; not measured";
  };
  work.digest = [mesh] {
    const auto origin = mesh->view().origin;
    return digest_of(std::span(origin.data(), static_cast<std::size_t>(origin.size())));
  };
  work.notes = [report]() -> Notes {
    const auto candidates = static_cast<double>(report->candidates);
    const auto accepted = static_cast<double>(report->candidates - report->postponed);
    return {{"flips", static_cast<double>(report->flips)},
            {"accepted_percent", 100 * accepted / candidates}};
  };
  return work;
}

/// Reads and writes what a flip does, about one a vertex; tests read each edge's four points.
Traffic surface_traffic(const Dataset& data) {
  const auto [halfedges, vertices, faces] = counts_of(data);
  return {kIndexBytes * 4 * halfedges + kPointBytes * vertices, kIndexBytes * 26 * vertices};
}

void add_surface(const Plan& plan) {
  const DatasetKey key{"terrain", plan.is_smoke ? 200 : 2'000'000, ""};
  add({"delaunay", key, 1, "queue",
       [](const Dataset& data, const Execution& execution) {
         return prepare_surface(data, execution, DelaunayOrder::queue);
       },
       surface_traffic, Mix::copy});
  for (const int threads : plan.threads) {
    add({"delaunay", key, threads, "",
         [](const Dataset& data, const Execution& execution) {
           return prepare_surface(data, execution, DelaunayOrder::rounds);
         },
         surface_traffic, Mix::copy});
  }
}

}  // namespace

void add_planar(const Plan& plan) {
  for (const DatasetKey& key : plan.planar) {
    for (const int threads : plan.threads) {
      add({"triangulate", key, threads, "", prepare_triangulation, triangulation_traffic,
           Mix::triad});
    }
#if defined(HEDGEROW_BENCH_CGAL)
    add({"triangulate", key, 1, "cgal",
         [](const Dataset& data, const Execution&) { return prepare_peer(data); },
         triangulation_traffic, Mix::triad});
#endif
    add({"voronoi", key, 1, "", prepare_voronoi, triangulation_traffic, Mix::triad});
    add_flips(key, plan);
  }
  if (!plan.planar.empty()) add_surface(plan);
}

}  // namespace hedgerow::bench
