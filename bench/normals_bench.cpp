// hedgerow/normals.h: face normals, and vertex normals by both methods, into the caller's arrays;
// the workspace is kept, so nothing is allocated while the clock runs.
#include <array>
#include <memory>
#include <utility>

#include "hedgerow/normals.h"
#include "hedgerow/workspace.h"
#include "peers/measured_mesh.h"
#include "runner.h"

namespace hedgerow::bench {

namespace {

struct Output {
  explicit Output(Index count) : values(3 * static_cast<std::size_t>(count), 0.0F) {}
  [[nodiscard]] NormalsOut view() noexcept {
    return {values.data(), static_cast<std::int64_t>(values.size() / 3)};
  }

  Buffer<float> values;
  Workspace workspace;
};

using Compute = Result<NormalStats> (*)(const Dataset&, const NormalOptions&, const Execution&,
                                        Output&);

Result<NormalStats> compute_faces(const Dataset& data, const NormalOptions& options,
                                  const Execution& execution, Output& out) {
  return face_normals(data.faces(), data.positions(), out.view(), options, execution);
}
Result<NormalStats> compute_facelist(const Dataset& data, const NormalOptions& options,
                                     const Execution& execution, Output& out) {
  return scatter_vertex_normals(data.faces(), data.positions(), out.view(), options, execution,
                                out.workspace);
}
Result<NormalStats> compute_halfedge(const Dataset& data, const NormalOptions& options,
                                     const Execution& execution, Output& out) {
  return gather_vertex_normals(data.mesh, data.positions(), out.view(), options, execution,
                               out.workspace);
}

/// What `weight` should give where the reference has it: the others are compared with each other.
const std::vector<float>* expected_normals(const Dataset& data, Compute compute,
                                           NormalWeight weight) {
  if (compute == compute_faces) return &data.reference.face_normals;
  if (weight == NormalWeight::area) return &data.reference.area_normals;
  if (weight == NormalWeight::uniform) return &data.reference.uniform_normals;
  return nullptr;
}

Work prepare_engine(const Dataset& data, const Execution& execution, Compute compute,
                    NormalWeight weight) {
  const NormalOptions options{.weight = weight};
  const bool is_face = compute == compute_faces;
  auto out = std::make_shared<Output>(is_face ? data.mesh.face_count() : data.mesh.vertex_count());
  Work work;
  work.run = [&data, execution, options, compute, out] {
    static_cast<void>(compute(data, options, execution, *out));
  };
  if (!compute(data, options, execution, *out)) {
    work.error = "the operation failed; not measured";
  } else if (const auto* expected = expected_normals(data, compute, weight)) {
    const std::vector<Index> skipped =
        is_face ? std::vector<Index>{} : vertices_with_several_fans(data.mesh);
    work.error = compare_normals(out->values.span(), *expected, kNormalTolerance, skipped);
  } else {
    // The other method, serially, must give the same bits.
    Output other(data.mesh.vertex_count());
    const Compute check = compute == compute_facelist ? compute_halfedge : compute_facelist;
    const bool is_done = check(data, options, Execution::serial(), other).has_value();
    work.error = is_done ? compare_normals(out->values.span(), other.values.span(), 0.0F, {})
                         : "the other method failed; not measured";
  }
  return work;
}

Work prepare_peer(const Dataset& data, const Peer& peer, bool is_face) {
  const auto mesh = built_mesh(peer, data.faces(), data.positions());
  Work work;
  if (!mesh) {
    work.error = "refuses a face of this mesh; not measured";
    return work;
  }
  if (is_face) {
    work.run = [mesh] { mesh->compute_face_normals(); };
  } else {
    work.run = [mesh] { mesh->compute_vertex_normals(); };
  }
  work.run();
  if (is_face) {
    work.error =
        compare_normals(mesh->face_normals(), data.reference.face_normals, kNormalTolerance, {});
  } else {
    const auto& expected = peer.weight == NormalWeight::area ? data.reference.area_normals
                                                             : data.reference.uniform_normals;
    work.error = compare_normals(mesh->vertex_normals(), expected, kNormalTolerance,
                                 vertices_with_several_fans(data.mesh));
  }
  return work;
}

double face_bytes(const Dataset& data) {
  const Counts counts = counts_of(data);
  return kIndexBytes * counts.halfedges + kPointBytes * (counts.vertices + counts.faces);
}
double facelist_bytes(const Dataset& data) {
  const Counts counts = counts_of(data);
  return kIndexBytes * counts.halfedges + 2 * kPointBytes * counts.vertices;
}
/// Beside what the face list takes: `opposite`, and `outgoing`.
double halfedge_bytes(const Dataset& data) {
  const Counts counts = counts_of(data);
  return facelist_bytes(data) + kIndexBytes * (counts.halfedges + counts.vertices);
}

struct Operation {
  const char* name;
  Compute compute;
  double (*bytes)(const Dataset&);
};
constexpr std::array<Operation, 3> kOperations = {
    {{"face_normals", compute_faces, face_bytes},
     {"vertex_normals_facelist", compute_facelist, facelist_bytes},
     {"vertex_normals_halfedge", compute_halfedge, halfedge_bytes}}};

constexpr std::array<std::pair<NormalWeight, const char*>, 3> kOtherWeights = {
    {{NormalWeight::uniform, "uniform"},
     {NormalWeight::angle, "angle"},
     {NormalWeight::max, "max"}}};

void add_engine(const Plan& plan, const Operation& operation, const DatasetKey& key, int threads,
                NormalWeight weight, const std::string& variant) {
  add(plan,
      {operation.name, key, threads, variant,
       [compute = operation.compute, weight](const Dataset& data, const Execution& execution) {
         return prepare_engine(data, execution, compute, weight);
       },
       operation.bytes});
}

}  // namespace

void add_normals(const Plan& plan) {
  for (const Operation& operation : kOperations) {
    for (const DatasetKey& key : plan.all) {
      for (const int threads : plan.threads) {
        add_engine(plan, operation, key, threads, NormalWeight::area, "");
      }
    }
    if (operation.compute == compute_faces) continue;
    for (const auto& [weight, variant] : kOtherWeights) {
      for (const int threads : plan.threads) {
        add_engine(plan, operation, plan.large.front(), threads, weight, variant);
      }
    }
  }
  for (const DatasetKey& key : plan.large) {
    for (const Peer& peer : peers()) {
      if (!peer.has_normals) continue;
      for (const bool is_face : {true, false}) {
        // Libraries that keep half-edges walk them for vertex normals; their time includes the face
        // normals that they need first.
        const Operation& operation = is_face ? kOperations[0] : kOperations[2];
        add(plan, {operation.name, key, 1, peer.name,
                   [&peer, is_face](const Dataset& data, const Execution&) {
                     return prepare_peer(data, peer, is_face);
                   },
                   operation.bytes});
      }
    }
  }
}

}  // namespace hedgerow::bench
