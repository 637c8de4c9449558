#pragma once

#include <array>
#include <cmath>
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

/// What a shader asks at the hit of a ray: the normal, from those of the corners of the triangle,
/// and the neighbours of the vertex next to it.
struct HitQuestion {
  std::array<Index, 3> vertices{};
  std::array<float, 3> weights{};
  Index nearest = 0;
};

/// What the answers add up to: compared between ways to the same answers.
struct HitSum {
  std::uint32_t ring = 0;  ///< of the ids of the neighbours, modulo 2^32
  double normal = 0;       ///< of the three coordinates of unit normals
};

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

  /// Keeps these normals the way a user of the library would, for the hits; the peers only.
  virtual void set_vertex_normals(Positions /*normals*/) {}
  [[nodiscard]] virtual HitSum answer_hits(std::span<const HitQuestion> /*hits*/) const {
    return {};
  }
  /// Takes over other positions of the same vertices; the peer libraries with normals only.
  virtual void move_to(Positions /*positions*/) {}

  /// Connected components, isolated vertices left out; the baselines only.
  [[nodiscard]] virtual Index component_count() const { return kInvalidIndex; }
};

inline void add_unit_normal(const std::array<float, 3>& normal, HitSum& sum) noexcept {
  sum.normal += static_cast<double>(normal[0] + normal[1] + normal[2]);
}
/// Adds a normal that was interpolated, made a unit one.
inline void add_normal(const std::array<float, 3>& normal, HitSum& sum) noexcept {
  const float squared = normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2];
  if (!(squared > 0)) return;
  const float scale = 1 / std::sqrt(squared);
  add_unit_normal({normal[0] * scale, normal[1] * scale, normal[2] * scale}, sum);
}

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
