#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "hedgerow/execution.h"
#include "hedgerow/face_list.h"
#include "hedgerow/index.h"
#include "hedgerow/positions.h"

/// The six tests by which mesh structures are compared since D. Sieger and M. Botsch, "Design,
/// Implementation, and Evaluation of the Surface_mesh Data Structure", 2011: each written for each
/// library as its user would write it. Meshes of triangles, with one fan a vertex.
namespace hedgerow::bench {

enum class ImrRow : std::uint8_t {
  circulator,   ///< faces round each vertex, then vertices round each face
  barycenter,   ///< mean of the points, then taken from each of them
  normals,      ///< of faces, unit; then of vertices: the mean of those, unweighted
  smoothing,    ///< each vertex to the mean of its neighbours, in place; the boundary stays
  subdivision,  ///< sqrt(3): each face split at its centre, then each old inner edge flipped
  collapse,     ///< each face split at its centre, each new vertex collapsed back, then compacted
};
inline constexpr std::array kImrRows = {ImrRow::circulator, ImrRow::barycenter,  ImrRow::normals,
                                        ImrRow::smoothing,  ImrRow::subdivision, ImrRow::collapse};
/// "circulator"
[[nodiscard]] const char* name(ImrRow row) noexcept;

/// What walks round all vertices and all faces meet: counted, as in the paper, and added up by id,
/// so that no step can be left out.
struct RingSums {
  std::int64_t faces = 0;
  std::uint64_t face_ids = 0;
  std::int64_t vertices = 0;
  std::uint64_t vertex_ids = 0;

  friend bool operator==(const RingSums&, const RingSums&) noexcept = default;
};

/// A mesh as an answer: in the numbers of the face list it was built from, new vertices behind.
struct ImrSurface {
  std::vector<float> xyz;      ///< three a vertex
  std::vector<Index> corners;  ///< three a face
};

/// A mesh of one library, with positions. Only the rows of its kind are asked for.
class ImrMesh {
 public:
  virtual ~ImrMesh() = default;

  // Timed, each one repetition of a row.
  [[nodiscard]] virtual RingSums circulate() { return {}; }
  virtual void subtract_barycenter() {}
  virtual void compute_normals() {}
  virtual void smooth() {}
  virtual void subdivide() {}
  virtual void split_and_collapse() {}

  // To compare, and to begin anew.
  virtual void move_to(Positions /*positions*/) {}
  [[nodiscard]] virtual std::vector<float> vertex_normals() const { return {}; }
  [[nodiscard]] virtual ImrSurface surface() const = 0;
};

/// Kinds of row that one mesh answers. `make` returns null where the library refuses the faces.
struct ImrKind {
  const char* name;  ///< "" of the engine's own rows
  std::vector<ImrRow> rows;
  std::unique_ptr<ImrMesh> (*make)(const FaceList& faces, Positions positions,
                                   const Execution& execution);
  bool is_parallel = false;  ///< measured on every number of threads
  bool is_in_place = true;   ///< whether smoothing takes the newest positions
};

// One for each source file; those of libraries only if CMake found them.
[[nodiscard]] std::vector<ImrKind> imr_hedgerow();
[[nodiscard]] std::vector<ImrKind> imr_edited();
[[nodiscard]] std::vector<ImrKind> imr_baselines();
[[nodiscard]] std::vector<ImrKind> imr_openmesh();
[[nodiscard]] std::vector<ImrKind> imr_cgal();

/// What is wrong with an answer, or "": compared with a slow, plain way to it from the face list.
/// \pre `faces` are triangles with one fan a vertex; `opposite` and `normals` are of them.
struct ImrInput {
  FaceList faces;
  Positions positions;
  std::span<const Index> opposite;  ///< of each corner
};
[[nodiscard]] std::string check_rings(const ImrInput& input, const RingSums& sums);
[[nodiscard]] std::string check_centered(const ImrInput& input, const ImrSurface& surface);
[[nodiscard]] std::string check_smoothed(const ImrInput& input, const ImrSurface& surface,
                                         bool is_in_place);
[[nodiscard]] std::string check_subdivided(const ImrInput& input, const ImrSurface& surface);
[[nodiscard]] std::string check_unchanged(const ImrInput& input, const ImrSurface& surface);

/// The share of the centre in the new place of a vertex: L. Kobbelt, "sqrt(3)-subdivision", 2000.
[[nodiscard]] inline double sqrt3_share(int valence) noexcept {
  return (4 - 2 * std::cos(2 * std::numbers::pi / valence)) / 9;
}

}  // namespace hedgerow::bench
