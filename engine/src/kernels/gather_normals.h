#pragma once

#include <cstdint>
#include <limits>
#include <type_traits>

#include "hedgerow/topology.h"
#include "kernels/normals_source.h"
#include "kernels/one_ring.h"
#include "kernels/term_window.h"

/// Vertex normals by walking round each vertex.
namespace hedgerow::kernels {

struct GatherInput {
  Points points;
  NormalWeight weight{};
  const Index* origin = nullptr;
  const Index* opposite = nullptr;
  Index halfedge_count = 0;
  /// Half-edge 3f + k leaves corner k of face f: faces are arithmetic.
  bool is_triangles = false;
  /// One `face_vector` per face where the faces are not all triangles and the weight is not `max`.
  const Wide* faces = nullptr;
};

/// Fills the face vectors of `range`; each face writes its own element.
void fill_face_vectors(IndexRange range, const FaceSource& faces, const Points& points,
                       NormalWeight weight, PolygonMethod method, Wide* out) noexcept;

/// Writes the normals of the vertices in `range`; each vertex writes its own element. `spill` is
/// empty, holds all half-edges, and is used by one call at a time, as is the window.
[[nodiscard]] NormalStats gather_normals(IndexRange range, const TriangleView& mesh,
                                         const GatherInput& input, IndexSet& spill,
                                         TermWindow& window, const NormalWriter& writer) noexcept;
[[nodiscard]] NormalStats gather_normals(IndexRange range, const PolygonView& mesh,
                                         const GatherInput& input, IndexSet& spill,
                                         TermWindow& window, const NormalWriter& writer) noexcept;

/// The same for `count` vertices by their ids, each once.
[[nodiscard]] NormalStats gather_normals(const Index* ids, Index count, const TriangleView& mesh,
                                         const GatherInput& input, IndexSet& spill,
                                         const NormalWriter& writer) noexcept;
[[nodiscard]] NormalStats gather_normals(const Index* ids, Index count, const PolygonView& mesh,
                                         const GatherInput& input, IndexSet& spill,
                                         const NormalWriter& writer) noexcept;

/// Behind the last corner of a list.
inline constexpr Index kNoCorner = std::numeric_limits<Index>::max();

/// Adds to `sum` what the corners [ids, end) of one vertex add, in ascending order, if the window
/// reaches all their faces. \pre *end == kNoCorner (A loop to there is one that gcc does not
/// vectorise, to the loss of the few corners that there are.)
template <NormalWeight W>
[[nodiscard]] inline bool add_from_window(const Index* ids, const Index* end,
                                          const GatherInput& input, TermWindow& window,
                                          Float3& sum) noexcept {
  using Unsigned = std::make_unsigned_t<Index>;
  const auto face_of = [](Index h) { return static_cast<Index>(static_cast<Unsigned>(h) / 3); };
  if (window.capacity() == 0 || ids == end) return false;
  if (!window.reach(face_of(ids[0]), face_of(end[-1]), 1, input)) return false;
  const Index mask = window.capacity() - 1;
  for (; *ids != kNoCorner; ++ids) {
    const Index face = face_of(*ids);
    const Index corner = rows_of(W) == 1 ? 0 : *ids - 3 * face;
    const std::ptrdiff_t row = std::ptrdiff_t{face & mask} * rows_of(W) + corner;
    sum = sum + window.rows()[row].term;
  }
  return true;
}

/// The sum with what the given corners of triangles add, in their order: the plain form.
template <NormalWeight W>
[[nodiscard]] Float3 add_triangle_corners_scalar(Float3 sum, const Index* ids, Index count,
                                                 const GatherInput& input) noexcept;
/// Four corners at a time where the processor can; else the same as the plain form.
/// \pre ids[0 .. count + 2] may be read and written; count > 0
template <NormalWeight W>
[[nodiscard]] Float3 add_triangle_corners_sse(Float3 sum, Index* ids, Index count,
                                              const GatherInput& input) noexcept;

/// Vertices handed to a group form at a time: as many as the first where there are so many.
inline constexpr Index kLargeGroup = 64;
inline constexpr Index kSmallGroup = 32;
[[nodiscard]] constexpr std::uint64_t whole_group(Index size) noexcept {
  return ~std::uint64_t{0} >> (64 - size);  // a bit for each
}

/// Writes the normals of those of the `size` vertices from `first` on whose bit is set in `wanted`;
/// returns the bits of those that it left to the plain form: vertices with many corners, with a
/// corner outside the usual range, or without a direction. All of them where the build cannot.
/// \pre `size` is one of the two above. `suits_avx2(input.points)`, `suits_avx512`. Wanted vertices
///      have one fan at the most.
template <NormalWeight W>
[[nodiscard]] std::uint64_t gather_group_avx2(Index first, Index size, std::uint64_t wanted,
                                              const TriangleView& mesh, const GatherInput& input,
                                              TermWindow& window,
                                              const NormalWriter& writer) noexcept;
template <NormalWeight W>
[[nodiscard]] std::uint64_t gather_group_avx512(Index first, Index size, std::uint64_t wanted,
                                                const TriangleView& mesh, const GatherInput& input,
                                                TermWindow& window,
                                                const NormalWriter& writer) noexcept;

/// The plain form.
template <NormalWeight W>
[[nodiscard]] std::uint64_t gather_group_plain(Index first, Index size, std::uint64_t wanted,
                                               const TriangleView& mesh, const GatherInput& input,
                                               TermWindow& window,
                                               const NormalWriter& writer) noexcept;

/// The same for kSmallGroup vertices by their ids.
template <NormalWeight W>
[[nodiscard]] std::uint64_t gather_listed_avx2(const Index* ids, std::uint64_t wanted,
                                               const TriangleView& mesh, const GatherInput& input,
                                               const NormalWriter& writer) noexcept;
template <NormalWeight W>
[[nodiscard]] std::uint64_t gather_listed_avx512(const Index* ids, std::uint64_t wanted,
                                                 const TriangleView& mesh, const GatherInput& input,
                                                 const NormalWriter& writer) noexcept;

}  // namespace hedgerow::kernels
