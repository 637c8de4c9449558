#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "hedgerow/face_list.h"
#include "hedgerow/index.h"
#include "hedgerow/normals.h"
#include "hedgerow/positions.h"

namespace hedgerow::bench {

/// A mesh of another kind that the engine is measured beside: a baseline or a peer library. Each
/// operation is the one that a user of that library would call, on one thread.
///
/// What it returns for a check is in the numbering of the face list it was built from.
class MeasuredMesh {
 public:
  virtual ~MeasuredMesh() = default;

  [[nodiscard]] virtual std::vector<Index> opposite() const = 0;

  /// Face normals from the positions.
  virtual void compute_face_normals() = 0;
  /// Vertex normals from the positions, so face normals too where the library needs them.
  virtual void compute_vertex_normals() = 0;
  [[nodiscard]] virtual std::vector<float> face_normals() const = 0;
  [[nodiscard]] virtual std::vector<float> vertex_normals() const = 0;

  /// sums[v] = sum of the ids of v's neighbours, modulo 2^32, by the library's circulator.
  virtual void fill_one_ring_sums(std::span<std::uint32_t> sums) const = 0;

  /// sums[i] = the same sum for vertices[i]; the peer libraries only.
  virtual void fill_one_ring_sums_at(std::span<const Index> /*vertices*/,
                                     std::span<std::uint32_t> /*sums*/) const {}
  /// Takes over other positions of the same vertices; the peer libraries with normals only.
  virtual void move_to(Positions /*positions*/) {}

  /// Connected components, isolated vertices left out; the baselines only.
  [[nodiscard]] virtual Index component_count() const { return kInvalidIndex; }
};

/// A kind of mesh to measure. `build` returns null where the library refuses the faces.
struct Peer {
  const char* name;
  std::unique_ptr<MeasuredMesh> (*build)(const FaceList& faces, Positions positions);
  bool has_normals;
  NormalWeight weight;  ///< of its vertex normals
  bool triangles_only;
  bool is_baseline;  ///< one of ours, so measured on every input
};

/// The mesh that `peer` builds, kept until faces of another mesh are asked for: building takes
/// longer than most measurements. Null where the library refuses the faces.
/// Lifetime   That of the face list's arrays, which tell one mesh from another, must be longer.
[[nodiscard]] std::shared_ptr<MeasuredMesh> built_mesh(const Peer& peer, const FaceList& faces,
                                                       Positions positions);
/// Frees those that are kept, before the arrays of their faces are freed.
void forget_built_meshes();

/// The baselines, then the peer libraries that were found when this was built.
[[nodiscard]] std::span<const Peer> peers();

}  // namespace hedgerow::bench
