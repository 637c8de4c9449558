// The six tests of the IMR 2011 suite, over the engine, the baselines and the peer libraries.
#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hedgerow/normals.h"
#include "hedgerow/subdivide.h"
#include "imr/suite.h"
#include "runner.h"

namespace hedgerow::bench {

namespace {

/// What a row runs on: the dataset, or what one step of subdivision makes of it.
struct Input {
  FaceList faces;
  Positions positions;
  const std::vector<Index>* opposite = nullptr;

  [[nodiscard]] ImrInput for_check() const { return {faces, positions, *opposite}; }
};

/// A dataset after one step of sqrt(3): three times the faces, as the paper's order of tests has it
/// when edges are collapsed.
struct Refined {
  SubdivisionOutput output;
  std::vector<Index> opposite;
};

std::shared_ptr<const Refined> refined(const Dataset& data) {
  static std::pair<DatasetKey, std::weak_ptr<const Refined>> newest;
  if (auto known = newest.second.lock(); known && newest.first == data.key) return known;
  SubdivisionOptions options;
  options.scheme = SubdivisionScheme::sqrt3;
  auto made = std::make_shared<Refined>();
  made->output = std::move(*subdivide(data.mesh, data.positions(), options, Execution::serial()));
  const auto opposite = made->output.mesh.opposite();
  made->opposite.assign(opposite.begin(), opposite.end());
  newest = {data.key, made};
  return made;
}

Input input_of(const Dataset& data, const Refined* refined) {
  if (refined == nullptr) return {data.faces(), data.positions(), &data.reference().opposite};
  const Connectivity& mesh = refined->output.mesh;
  return {
      face_list(mesh), {refined->output.positions.data(), mesh.vertex_count()}, &refined->opposite};
}

/// Why the tests are not made for a mesh, or "".
std::string refusal(const Dataset& data) {
  if (!data.mesh.is_triangle_mesh()) return "not all faces are triangles; not measured";
  if (!data.mesh.fans().empty()) return "a vertex has several fans; not measured";
  return "";
}

/// One mesh, the row that is asked of it, and the answer.
struct Subject {
  ImrRow row = ImrRow::circulator;
  const ImrKind* kind = nullptr;
  Execution execution;
  std::shared_ptr<const Refined> refined;
  Input input;
  std::unique_ptr<ImrMesh> mesh;
  RingSums sums;

  void make() { mesh = kind->make(input.faces, input.positions, execution); }
  void run() {
    switch (row) {
      case ImrRow::circulator:
        sums = mesh->circulate();
        break;
      case ImrRow::barycenter:
        mesh->subtract_barycenter();
        break;
      case ImrRow::normals:
        mesh->compute_normals();
        break;
      case ImrRow::smoothing:
        mesh->smooth();
        break;
      case ImrRow::subdivision:
        mesh->subdivide();
        break;
      case ImrRow::collapse:
        mesh->split_and_collapse();
        break;
    }
  }
  /// As it was before the row changed it. A mesh with other faces is freed, and made anew before
  /// the next run: a dozen of them beside each other would be what is measured.
  void renew() {
    if (row == ImrRow::barycenter || row == ImrRow::smoothing) mesh->move_to(input.positions);
    if (row == ImrRow::subdivision || row == ImrRow::collapse) mesh.reset();
  }
  [[nodiscard]] std::string check(const Dataset& data) const {
    switch (row) {
      case ImrRow::circulator:
        return check_rings(input.for_check(), sums);
      case ImrRow::barycenter:
        return check_centered(input.for_check(), mesh->surface());
      case ImrRow::normals:
        return compare_normals(mesh->vertex_normals(), data.reference().uniform_normals,
                               kNormalTolerance, {});
      case ImrRow::smoothing:
        return check_smoothed(input.for_check(), mesh->surface(), kind->is_in_place);
      case ImrRow::subdivision:
        return check_subdivided(input.for_check(), mesh->surface());
      case ImrRow::collapse:
        return check_unchanged(input.for_check(), mesh->surface());
    }
    return "no such row";
  }
  [[nodiscard]] std::uint64_t digest() const {
    if (row == ImrRow::circulator) return sums.face_ids + sums.vertex_ids;
    if (row == ImrRow::normals) return digest_of(mesh->vertex_normals());
    const ImrSurface surface = mesh->surface();
    return digest_of(surface.xyz) ^ digest_of(surface.corners);
  }
};

Work prepare(const Dataset& data, const Execution& execution, ImrRow row, const ImrKind& kind) {
  Work work;
  work.error = refusal(data);
  if (!work.error.empty()) return work;
  auto subject = std::make_shared<Subject>();
  subject->row = row;
  subject->kind = &kind;
  subject->execution = execution;
  if (row == ImrRow::collapse) subject->refined = refined(data);
  subject->input = input_of(data, subject->refined.get());
  subject->make();
  if (!subject->mesh) {
    work.error = "refuses a face of this mesh; not measured";
    return work;
  }
  subject->renew();
  work.setup = [subject] {
    if (!subject->mesh) subject->make();
  };
  work.run = [subject] { subject->run(); };
  work.cleanup = [subject] { subject->renew(); };
  work.check = [subject, &data] { return subject->check(data); };
  work.digest = [subject] { return subject->digest(); };
  return work;
}

/// What the flat layout has to move; nothing is stated of edits, which hop through all of it.
Traffic traffic(const Dataset& data, ImrRow row) {
  const auto [halfedges, vertices, faces] = counts_of(data);
  const double rings = kIndexBytes * (2 * halfedges + vertices);
  switch (row) {
    case ImrRow::circulator:
      return {rings, 0};
    case ImrRow::barycenter:
      return {2 * kPointBytes * vertices, kPointBytes * vertices};
    case ImrRow::normals:
      return {kIndexBytes * halfedges + kPointBytes * (vertices + faces),
              kPointBytes * (vertices + faces)};
    case ImrRow::smoothing:
      return {rings + kPointBytes * vertices, kPointBytes * vertices};
    default:
      return {};
  }
}
Mix mix_of(ImrRow row) {
  if (row == ImrRow::circulator) return Mix::read;
  return row == ImrRow::normals ? Mix::copy : Mix::triad;
}

const std::vector<ImrKind>& kinds() {
  static const std::vector<ImrKind> all = [] {
    std::vector<ImrKind> kinds;
    for (const auto& list : {
           imr_hedgerow(), imr_edited(), imr_baselines(),
#if defined(HEDGEROW_BENCH_OPENMESH)
               imr_openmesh(),
#endif
#if defined(HEDGEROW_BENCH_CGAL)
               imr_cgal(),
#endif
         }) {
      kinds.insert(kinds.end(), list.begin(), list.end());
    }
    return kinds;
  }();
  return all;
}

void add_row(const DatasetKey& key, ImrRow row, const ImrKind& kind, int threads) {
  add({std::string("imr_") + name(row), key, threads, kind.name,
       [row, &kind](const Dataset& data, const Execution& execution) {
         return prepare(data, execution, row, kind);
       },
       [row](const Dataset& data) { return traffic(data, row); }, mix_of(row)});
}

}  // namespace

void add_imr(const Plan& plan) {
  for (const DatasetKey& key : plan.imr) {
    for (const ImrRow row : kImrRows) {
      for (const ImrKind& kind : kinds()) {
        if (std::ranges::find(kind.rows, row) == kind.rows.end()) continue;
        for (const int threads : plan.threads) {
          if (threads == 1 || kind.is_parallel) add_row(key, row, kind, threads);
        }
      }
    }
  }
}

}  // namespace hedgerow::bench
