#include <algorithm>
#include <optional>
#include <vector>

#include "build/input_faces.h"
#include "kernels/check_faces.h"

namespace hedgerow::detail {

namespace {

// The index as the caller wrote it, also where it does not fit an `Index`.
std::int64_t written_index(const FaceList& list, std::int64_t corner) noexcept {
  const auto* base = static_cast<const std::byte*>(list.corners);
  const std::size_t offset =
      list.is_triangles() ? static_cast<std::size_t>(corner / 3) * list.stride_bytes +
                                static_cast<std::size_t>(corner % 3) * size_bytes(list.format)
                          : static_cast<std::size_t>(corner) * list.stride_bytes;
  switch (list.format) {
    case IndexFormat::uint16:
      return *reinterpret_cast<const std::uint16_t*>(base + offset);
    case IndexFormat::uint32:
      return *reinterpret_cast<const std::uint32_t*>(base + offset);
    case IndexFormat::int64:
      return *reinterpret_cast<const std::int64_t*>(base + offset);
    default:
      return *reinterpret_cast<const std::int32_t*>(base + offset);
  }
}

// The corners of one face that repeat an earlier corner, ascending. Sorts where comparing all pairs
// would be quadratic.
void find_repeats(std::span<const Index> corners, std::vector<Index>& order,
                  std::vector<Index>& repeats) {
  repeats.clear();
  order.resize(corners.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Index>(i);
  const auto vertex = [&](Index i) { return corners[static_cast<std::size_t>(i)]; };
  std::sort(order.begin(), order.end(), [&](Index a, Index b) {
    return vertex(a) != vertex(b) ? vertex(a) < vertex(b) : a < b;
  });
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (vertex(order[i]) == vertex(order[i - 1])) repeats.push_back(order[i]);
  }
  std::sort(repeats.begin(), repeats.end());
}

std::optional<Defect> defect_of(const kernels::FaceColumns& faces, Index f, const FaceList& list,
                                std::vector<Index>& order, std::vector<Index>& repeats) {
  const Index begin = faces.begin(f);
  const std::span<const Index> corners(faces.corners + begin,
                                       static_cast<std::size_t>(faces.degree(f)));
  Defect defect;
  defect.face = FaceId(f);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (corners[i] >= 0 && corners[i] < faces.vertex_count) continue;
    defect.kind = DefectKind::out_of_range;
    defect.value = written_index(list, begin + static_cast<std::int64_t>(i));
    return defect;
  }
  if (corners.size() < 3) {
    defect.kind = DefectKind::too_few_corners;
    defect.value = static_cast<std::int64_t>(corners.size());
    return defect;
  }
  if (corners.size() <= kernels::kPairwiseDegree &&
      kernels::check_faces({f, f + 1}, faces).bad_count == 0) {
    return std::nullopt;
  }
  find_repeats(corners, order, repeats);
  if (repeats.empty()) return std::nullopt;
  defect.kind = DefectKind::repeated_vertex;
  defect.vertex = VertexId(corners[static_cast<std::size_t>(repeats[0])]);
  return defect;
}

}  // namespace

Error error_of(const Defect& defect, std::int64_t limit, std::int64_t count) noexcept {
  switch (defect.kind) {
    case DefectKind::out_of_range:
      return {ErrorCode::index_out_of_range, defect.face.value, defect.value, limit, count};
    case DefectKind::too_few_corners:
      return {ErrorCode::too_few_corners, defect.face.value, defect.value, 3, count};
    case DefectKind::repeated_vertex:
      return {ErrorCode::repeated_vertex, defect.face.value, defect.vertex.value, 0, count};
    case DefectKind::duplicate_face:
      return {ErrorCode::duplicate_face, defect.face.value, defect.value, 0, count};
    case DefectKind::nonmanifold_edge:
      return {ErrorCode::nonmanifold_edge, defect.halfedge.value, defect.value, 2, count};
    case DefectKind::inconsistent_edge:
      return {ErrorCode::inconsistent_edge, defect.halfedge.value, defect.value, 0, count};
    case DefectKind::nonmanifold_vertex:
      return {ErrorCode::nonmanifold_vertex, defect.vertex.value, defect.value, 1, count};
    default:
      return {ErrorCode::isolated_vertex, defect.vertex.value, 0, 0, count};
  }
}

Result<void> repair_single_faces(InputFaces& faces, const FaceList& list, const Policies& policies,
                                 std::vector<Defect>& defects) {
  const kernels::FaceColumns columns = faces.columns();
  std::vector<std::uint8_t> keep(static_cast<std::size_t>(columns.face_count), 1);
  std::vector<Index> order;
  std::vector<Index> repeats;
  std::vector<Index> corners_to_split;
  bool drops = false;
  for (Index f = 0; f < columns.face_count; ++f) {
    const auto defect = defect_of(columns, f, list, order, repeats);
    if (!defect) continue;
    defects.push_back(*defect);
    if (policies[defect->kind] == Action::split) {
      for (const Index corner : repeats) corners_to_split.push_back(columns.begin(f) + corner);
    } else {
      keep[static_cast<std::size_t>(f)] = 0;
      drops = true;
    }
  }
  std::stable_sort(defects.begin(), defects.end(),
                   [](const Defect& a, const Defect& b) { return a.kind < b.kind; });
  for (const Defect& defect : defects) {
    if (policies[defect.kind] != Action::fail) continue;
    const auto count = std::count_if(defects.begin(), defects.end(),
                                     [&](const Defect& d) { return d.kind == defect.kind; });
    return fail(error_of(defect, columns.vertex_count, count));
  }
  if (!corners_to_split.empty()) split_corners(faces, corners_to_split);
  if (drops) drop_faces(faces, keep);
  return {};
}

}  // namespace hedgerow::detail
