#include <algorithm>
#include <limits>
#include <utility>

#include "scene_impl.h"
#include "triangulate.h"

namespace hedgerow::ray {
namespace {

struct FaceCounts {
  bool are_all_quads = true;
  std::int64_t primitives = 0;
  std::int64_t cut = 0;
};

/// Errors     not_canonical: the half-edges of some face are not in a row.
Result<FaceCounts> count_faces(const PolygonView& mesh) {
  FaceCounts counts;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const HalfedgeId first = mesh.first(FaceId(f));
    const Index degree = mesh.degree(FaceId(f));
    if (degree < 3 || mesh.next(HalfedgeId(first.value + degree - 1)) != first) {
      return fail({ErrorCode::not_canonical, f, degree});
    }
    counts.are_all_quads = counts.are_all_quads && degree == 4 && first.value == 4 * f;
    counts.primitives += degree <= 4 ? 1 : degree - 2;
    if (degree > 4) ++counts.cut;
  }
  return counts;
}

/// The four corners of every primitive, as half-edges.
Buffer<Index> cut_faces(const PolygonView& mesh, Positions positions, std::int64_t count) {
  Buffer<Index> corners(4 * static_cast<std::size_t>(count));
  Index* out = corners.data();
  const auto add = [&](Index a, Index b, Index c, Index d) {
    for (const Index corner : {a, b, c, d}) *out++ = corner;
  };
  Triangulator triangulator;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Index h = mesh.first(FaceId(f)).value;
    const Index degree = mesh.degree(FaceId(f));
    if (degree <= 4) {
      add(h, h + 1, h + 2, h + degree - 1);
      continue;
    }
    const std::span<const Index> vertices(mesh.origin.data() + h, static_cast<std::size_t>(degree));
    for (const auto& [a, b, c] : triangulator.cut(vertices, positions)) {
      add(h + a, h + b, h + c, h + c);
    }
  }
  return corners;
}

/// Embree's indices of vertices where the mesh's own do not serve.
Buffer<std::uint32_t> copy_vertices(const Index* origin, std::size_t count, const Index* corners) {
  Buffer<std::uint32_t> vertices(count);
  for (std::size_t i = 0; i < count; ++i) {
    const auto h = corners == nullptr ? i : static_cast<std::size_t>(corners[i]);
    vertices[i] = static_cast<std::uint32_t>(origin[h]);
  }
  return vertices;
}

/// The origin column is the index buffer: vertex numbers are not negative, so reading them as
/// unsigned changes nothing, and int and unsigned int may alias.
void share_origin(Primitives& primitives, const Index* origin) {
  if constexpr (sizeof(Index) == sizeof(std::uint32_t)) {
    primitives.vertices = reinterpret_cast<const std::uint32_t*>(origin);
  } else {
    const std::size_t count =
        static_cast<std::size_t>(primitives.count) * static_cast<std::size_t>(primitives.sides);
    primitives.copied = copy_vertices(origin, count, nullptr);
    primitives.vertices = primitives.copied.data();
  }
}

}  // namespace

Result<Primitives> make_primitives(const Connectivity& mesh, Positions positions) {
  Primitives primitives;
  primitives.count = mesh.face_count();
  if (mesh.is_triangle_mesh()) {
    share_origin(primitives, mesh.origin().data());
    return primitives;
  }
  const PolygonView view = mesh.polygons();
  const Result<FaceCounts> counts = count_faces(view);
  if (!counts) return fail(counts.error());
  primitives.sides = 4;
  primitives.next_of = view.next_of.data();
  primitives.cut_face_count = counts->cut;
  if (counts->are_all_quads) {
    share_origin(primitives, mesh.origin().data());
    return primitives;
  }
  constexpr std::int64_t kMost =
      std::min<std::int64_t>(kMaxCount / 4, std::numeric_limits<std::uint32_t>::max() - 1);
  if (counts->primitives > kMost) {
    return fail({ErrorCode::too_many_elements, kInvalidIndex, counts->primitives, kMost});
  }
  primitives.count = static_cast<Index>(counts->primitives);
  primitives.corners = cut_faces(view, positions, counts->primitives);
  primitives.copied =
      copy_vertices(mesh.origin().data(), primitives.corners.size(), primitives.corners.data());
  primitives.vertices = primitives.copied.data();
  return primitives;
}

}  // namespace hedgerow::ray
