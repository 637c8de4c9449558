#include "build/input_faces.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "parallel/parallel.h"

namespace hedgerow::detail {

namespace {

constexpr Index kCornerGrain = 1 << 16;  // corners a task: 256 KB read, 256 KB written

template <class Integer>
Index corner_at(const FaceList& list, std::int64_t c) noexcept {
  const auto* base = static_cast<const std::byte*>(list.corners);
  const std::byte* address = list.is_triangles()
                                 ? base + static_cast<std::size_t>(c / 3) * list.stride_bytes +
                                       static_cast<std::size_t>(c % 3) * sizeof(Integer)
                                 : base + static_cast<std::size_t>(c) * list.stride_bytes;
  // What does not fit an Index is out of range for any mesh that does.
  const Integer value = *reinterpret_cast<const Integer*>(address);
  return std::in_range<Index>(value) ? static_cast<Index>(value) : kInvalidIndex;
}

template <class Integer>
Buffer<Index> copy_corners(const FaceList& list, const Execution& execution) {
  Buffer<Index> corners(static_cast<std::size_t>(list.corner_count()));
  Index* out = corners.data();
  par::for_each_range(execution, static_cast<Index>(corners.size()), kCornerGrain,
                      [&, out](IndexRange range) {
                        for (Index c = range.begin; c < range.end; ++c) {
                          out[c] = corner_at<Integer>(list, c);
                        }
                      });
  return corners;
}

Buffer<Index> copy_corners(const FaceList& list, const Execution& execution) {
  switch (list.format) {
    case IndexFormat::uint16:
      return copy_corners<std::uint16_t>(list, execution);
    case IndexFormat::uint32:
      return copy_corners<std::uint32_t>(list, execution);
    case IndexFormat::int64:
      return copy_corners<std::int64_t>(list, execution);
    default:
      return copy_corners<std::int32_t>(list, execution);
  }
}

bool has_only_triangles(std::span<const Index> offsets) noexcept {
  if (3 * (static_cast<std::int64_t>(offsets.size()) - 1) != offsets.back()) return false;
  for (std::size_t f = 0; f < offsets.size(); ++f) {
    if (offsets[f] != static_cast<Index>(3 * f)) return false;
  }
  return true;
}

// numbers[i] is the old number of element i; keeps those of `kept`.
Buffer<Index> compose(const Buffer<Index>& numbers, std::span<const Index> kept) {
  Buffer<Index> composed = Buffer<Index>::copy_of(kept);
  if (numbers.empty()) return composed;
  for (Index& n : composed) n = numbers[static_cast<std::size_t>(n)];
  return composed;
}

}  // namespace

kernels::FaceColumns InputFaces::columns() const noexcept {
  if (first.empty()) {
    return {corners.data(), nullptr, corners.size() / 3, vertex_count};
  }
  return {corners.data(), first.data(), first.size() - 1, vertex_count};
}

InputFaces take_faces(const FaceList& list, bool borrow, const Execution& execution) {
  InputFaces faces;
  faces.vertex_count = static_cast<Index>(list.vertex_count);
  const auto corner_count = static_cast<std::size_t>(list.corner_count());
  if (list.is_native() && borrow) {
    // int32 and uint32 may alias; an index above the largest int32 reads as negative, out of range.
    faces.corners = ColumnStorage::borrow({static_cast<const Index*>(list.corners), corner_count});
  } else {
    faces.corners = copy_corners(list, execution);
  }
  if (list.is_triangles()) return faces;
  const std::span<const Index> offsets(list.offsets, static_cast<std::size_t>(list.face_count) + 1);
  if (has_only_triangles(offsets)) return faces;
  faces.first =
      borrow ? ColumnStorage::borrow(offsets) : ColumnStorage(Buffer<Index>::copy_of(offsets));
  return faces;
}

void drop_faces(InputFaces& faces, std::span<const std::uint8_t> keep) {
  const kernels::FaceColumns old = faces.columns();
  std::vector<Index> kept;
  std::size_t corner_count = 0;
  for (Index f = 0; f < old.face_count; ++f) {
    if (keep[static_cast<std::size_t>(f)] == 0) continue;
    kept.push_back(f);
    corner_count += static_cast<std::size_t>(old.degree(f));
  }
  Buffer<Index> corners(corner_count);
  Buffer<Index> first(kept.size() + 1);
  Index end = 0;
  for (std::size_t i = 0; i < kept.size(); ++i) {
    first[i] = end;
    const Index* begin = old.corners + old.begin(kept[i]);
    std::copy(begin, begin + old.degree(kept[i]), corners.data() + end);
    end += old.degree(kept[i]);
  }
  first[kept.size()] = end;
  faces.faces_new_to_old = compose(faces.faces_new_to_old, kept);
  faces.corners = std::move(corners);
  faces.first = has_only_triangles(first.span()) ? ColumnStorage() : std::move(first);
}

void split_corners(InputFaces& faces, std::span<const Index> halfedges) {
  Buffer<Index> corners = Buffer<Index>::copy_of(faces.corners.span());
  std::vector<Index> origins;
  for (const Index h : halfedges) {
    Index& corner = corners[static_cast<std::size_t>(h)];
    origins.push_back(corner);
    corner = faces.vertex_count + static_cast<Index>(origins.size()) - 1;
  }
  replace_corners(faces, std::move(corners), origins);
}

void replace_corners(InputFaces& faces, Buffer<Index>&& corners,
                     std::span<const Index> new_vertices) {
  const auto old_count = static_cast<std::size_t>(faces.vertex_count);
  std::vector<Index> numbers(old_count);
  std::iota(numbers.begin(), numbers.end(), Index{0});
  numbers.insert(numbers.end(), new_vertices.begin(), new_vertices.end());
  faces.vertices_new_to_old = compose(faces.vertices_new_to_old, numbers);
  faces.vertex_count += static_cast<Index>(new_vertices.size());
  faces.corners = std::move(corners);
}

void drop_isolated_vertices(InputFaces& faces) {
  Buffer<Index> old_to_new(static_cast<std::size_t>(faces.vertex_count), kInvalidIndex);
  for (const Index v : faces.corners.span()) old_to_new[static_cast<std::size_t>(v)] = 0;
  std::vector<Index> kept;
  for (std::size_t v = 0; v < old_to_new.size(); ++v) {
    if (old_to_new[v] == kInvalidIndex) continue;
    old_to_new[v] = static_cast<Index>(kept.size());
    kept.push_back(static_cast<Index>(v));
  }
  if (kept.size() == old_to_new.size()) return;
  Buffer<Index> corners = Buffer<Index>::copy_of(faces.corners.span());
  for (Index& v : corners) v = old_to_new[static_cast<std::size_t>(v)];
  faces.vertices_new_to_old = compose(faces.vertices_new_to_old, kept);
  faces.vertex_count = static_cast<Index>(kept.size());
  faces.corners = std::move(corners);
}

}  // namespace hedgerow::detail
