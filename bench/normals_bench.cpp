// hedgerow/normals.h: face normals, and vertex normals by both methods, into the caller's arrays;
// the workspace is kept, so nothing is allocated while the clock runs.
#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <utility>

#include "hedgerow/normals.h"
#include "hedgerow/workspace.h"
#include "peers/measured_mesh.h"
#include "runner.h"
#include "stored_form.h"

namespace hedgerow::bench {

namespace {

/// Memory that begins at a page. Rows of the smallest meshes are compared to a few per cent, and
/// how arrays lie to one another in their pages is worth more than that.
class Pages {
 public:
  explicit Pages(std::size_t bytes) : memory_(bytes + kPage), bytes_(bytes) {}

  [[nodiscard]] std::span<std::byte> span() noexcept {
    const auto address = reinterpret_cast<std::uintptr_t>(memory_.data());
    return memory_.span().subspan((kPage - address % kPage) % kPage, bytes_);
  }

 private:
  static constexpr std::size_t kPage = 4096;

  Buffer<std::byte> memory_;
  std::size_t bytes_;
};

struct Output {
  explicit Output(Index count, std::size_t scratch_bytes = 0)
      : memory(3 * sizeof(float) * static_cast<std::size_t>(count)),
        scratch(scratch_bytes),
        workspace(scratch_bytes == 0 ? Workspace() : Workspace(scratch.span())) {
    std::ranges::fill(values(), 0.0F);
  }
  [[nodiscard]] std::span<float> values() noexcept {
    return {reinterpret_cast<float*>(memory.span().data()), memory.span().size() / sizeof(float)};
  }
  [[nodiscard]] NormalsOut view() noexcept {
    return {values().data(), static_cast<std::int64_t>(values().size() / 3)};
  }

  Pages memory;
  Pages scratch;
  Workspace workspace;
  bool is_done = false;
};

using Compute = Result<NormalStats> (*)(const Dataset&, const NormalOptions&, const Execution&,
                                        Output&);

Result<NormalStats> compute_faces(const Dataset& data, const NormalOptions& options,
                                  const Execution& execution, Output& out) {
  return face_normals(data.mesh, data.positions(), out.view(), options, execution);
}
Result<NormalStats> compute_list_faces(const Dataset& data, const NormalOptions& options,
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

bool is_of_faces(Compute compute) {
  return compute == compute_faces || compute == compute_list_faces;
}

/// What `weight` should give where the reference has it: the others are compared with each other.
const std::vector<float>* expected_normals(const Dataset& data, Compute compute,
                                           NormalWeight weight) {
  if (is_of_faces(compute)) return &data.reference().face_normals;
  if (weight == NormalWeight::area) return &data.reference().area_normals;
  if (weight == NormalWeight::uniform) return &data.reference().uniform_normals;
  return nullptr;
}

/// Why `normals` are wrong, or "".
std::string compare_engine(const Dataset& data, Compute compute, const NormalOptions& options,
                           std::span<const float> normals) {
  if (const auto* expected = expected_normals(data, compute, options.weight)) {
    const std::vector<Index> skipped =
        is_of_faces(compute) ? std::vector<Index>{} : vertices_with_several_fans(data.mesh);
    return compare_normals(normals, *expected, kNormalTolerance, skipped);
  }
  // The other method, serially, must give the same bits.
  Output other(data.mesh.vertex_count());
  const Compute check = compute == compute_facelist ? compute_halfedge : compute_facelist;
  const bool is_done = check(data, options, Execution::serial(), other).has_value();
  return is_done ? compare_normals(normals, other.values(), 0.0F, {})
                 : "the other method failed; not measured";
}

Work prepare_engine(const Dataset& data, const Execution& execution, Compute compute,
                    NormalWeight weight) {
  const NormalOptions options{.weight = weight};
  const bool is_face = is_of_faces(compute);
  const std::size_t scratch_bytes =
      is_face ? 0
      : compute == compute_facelist
          ? scatter_vertex_normals_scratch_bytes(data.faces(), options, execution)
          : gather_vertex_normals_scratch_bytes(data.mesh, options, execution);
  // Up to 63 bytes of a fixed workspace are lost to aligning; none are here.
  auto out = std::make_shared<Output>(is_face ? data.mesh.face_count() : data.mesh.vertex_count(),
                                      scratch_bytes);
  Work work;
  work.run = [&data, execution, options, compute, out] {
    out->is_done = compute(data, options, execution, *out).has_value();
  };
  work.check = [&data, options, compute, out]() -> std::string {
    if (!out->is_done) return "the operation failed; not measured";
    return compare_engine(data, compute, options, out->values());
  };
  work.digest = [out] { return digest_of(out->values()); };
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
  work.check = [&data, &peer, mesh, is_face] {
    const Reference& reference = data.reference();
    if (is_face) {
      return compare_normals(mesh->face_normals(), reference.face_normals, kNormalTolerance, {});
    }
    const auto& expected =
        peer.weight == NormalWeight::area ? reference.area_normals : reference.uniform_normals;
    return compare_normals(mesh->vertex_normals(), expected, kNormalTolerance,
                           vertices_with_several_fans(data.mesh));
  };
  work.digest = [mesh, is_face] {
    return digest_of(is_face ? mesh->face_normals() : mesh->vertex_normals());
  };
  return work;
}

/// Reads corners and positions, as all do; writes a normal a face.
Traffic face_traffic(const Dataset& data) {
  const Counts counts = counts_of(data);
  return {kIndexBytes * counts.halfedges + kPointBytes * counts.vertices,
          kPointBytes * counts.faces};
}
Traffic facelist_traffic(const Dataset& data) {
  return {face_traffic(data).read, kPointBytes * counts_of(data).vertices};
}
/// Reads `opposite` and `outgoing` besides.
Traffic halfedge_traffic(const Dataset& data) {
  const Counts counts = counts_of(data);
  const Traffic list = facelist_traffic(data);
  return {list.read + kIndexBytes * (counts.halfedges + counts.vertices), list.written};
}
/// Reads `next` besides.
Traffic stored_traffic(const Dataset& data) {
  const Traffic walk = halfedge_traffic(data);
  return {walk.read + kIndexBytes * counts_of(data).halfedges, walk.written};
}

struct Operation {
  const char* name;
  Compute compute;
  Traffic (*traffic)(const Dataset&);
  const char* family;
};
constexpr std::array<Operation, 3> kOperations = {
    {{"face_normals", compute_faces, face_traffic, "face_normals"},
     {"vertex_normals_facelist", compute_facelist, facelist_traffic, "vertex_normals"},
     {"vertex_normals_halfedge", compute_halfedge, halfedge_traffic, "vertex_normals"}}};

constexpr Operation kListFaces = {"face_normals", compute_list_faces, face_traffic, "face_normals"};

constexpr std::array<std::pair<NormalWeight, const char*>, 3> kOtherWeights = {
    {{NormalWeight::uniform, "uniform"},
     {NormalWeight::angle, "angle"},
     {NormalWeight::max, "max"}}};

void add_engine(const Operation& operation, const DatasetKey& key, int threads, NormalWeight weight,
                const std::string& variant) {
  add({operation.name, key, threads, variant,
       [compute = operation.compute, weight](const Dataset& data, const Execution& execution) {
         return prepare_engine(data, execution, compute, weight);
       },
       operation.traffic, Mix::triad, operation.family});
}

void add_peer(const DatasetKey& key, const Peer& peer, bool is_face) {
  // Libraries that keep half-edges walk them for vertex normals; their time includes the face
  // normals that they need first.
  const Operation& operation = is_face ? kOperations[0] : kOperations[2];
  add({operation.name, key, 1, peer.name,
       [&peer, is_face](const Dataset& data, const Execution&) {
         return prepare_peer(data, peer, is_face);
       },
       operation.traffic, Mix::triad, operation.family});
}

Work prepare_stored(const Dataset& data, const Execution& execution) {
  auto out = std::make_shared<Output>(data.mesh.vertex_count());
  Work work;
  work.run = [mesh = stored_form(data), &data, execution, out] {
    static_cast<void>(
        gather_vertex_normals(*mesh, data.positions(), out->view(), {}, execution, out->workspace));
  };
  work.check = [&data, out] {
    return compare_normals(out->values(), data.reference().area_normals, kNormalTolerance,
                           vertices_with_several_fans(data.mesh));
  };
  work.digest = [out] { return digest_of(out->values()); };
  return work;
}

}  // namespace

void add_normals(const Plan& plan) {
  for (const DatasetKey& key : plan.all) {
    for (const Operation& operation : kOperations) {
      for (const int threads : plan.threads) {
        add_engine(operation, key, threads, NormalWeight::area, "");
      }
    }
    if (!plan.has_peers(key)) continue;
    for (const Peer& peer : peers()) {
      if (!peer.has_normals) continue;
      for (const bool is_face : {true, false}) add_peer(key, peer, is_face);
    }
  }
  for (const DatasetKey& key : plan.large) {
    for (const int threads : plan.threads) {
      add_engine(kListFaces, key, threads, NormalWeight::area, "list");
      add({"vertex_normals_halfedge", key, threads, "stored", prepare_stored, stored_traffic,
           Mix::triad, "vertex_normals"});
      for (const Operation& operation : {kOperations[1], kOperations[2]}) {
        for (const auto& [weight, variant] : kOtherWeights) {
          // All weights on one dataset; on the others the one that is far more work.
          const bool is_first = key == plan.large.front();
          if (is_first || weight == NormalWeight::angle) {
            add_engine(operation, key, threads, weight, variant);
          }
        }
      }
    }
  }
}

}  // namespace hedgerow::bench
