#include "kernels/gather_normals.h"

#include <algorithm>
#include <bit>

#include "kernels/normals_weight.h"

namespace hedgerow::kernels {

namespace {

// Calls visit(p0, p1, p2, k) with the triangle of a half-edge, and which of its corners that is.
template <class Visit>
auto with_triangle(Index h, const GatherInput& input, const Visit& visit) noexcept {
  const Index k = h % 3;
  const Index* corners = input.origin + (h - k);
  return visit(input.points[corners[0]], input.points[corners[1]], input.points[corners[2]],
               static_cast<int>(k));
}

// Calls visit(face, degree, k, point) for a half-edge of any face, with what `face_corner` takes.
template <NormalWeight W, class Visit>
auto with_polygon(Index h, const PolygonView& mesh, const GatherInput& input,
                  const Visit& visit) noexcept {
  const FaceId f = mesh.face(HalfedgeId(h));
  const Index first = mesh.first(f).value;
  const auto point = [&](Index k) { return input.points[input.origin[first + k]]; };
  const Wide face = W == NormalWeight::max ? Wide{} : input.faces[f.value];
  return visit(face, mesh.degree(f), h - first, point);
}

template <NormalWeight W, class View>
Wide any_corner(Index h, const View& mesh, const GatherInput& input) noexcept {
  if constexpr (std::is_same_v<View, PolygonView>) {
    if (!input.is_triangles) {
      return with_polygon<W>(h, mesh, input,
                             [](const auto&... face) { return face_corner<W>(face...); });
    }
  }
  return with_triangle(h, input, [](const auto&... corner) { return wide_corner<W>(corner...); });
}

template <NormalWeight W, class View>
Float3 add_corners(Float3 sum, Index* ids, Index count, const View& mesh,
                   const GatherInput& input) noexcept {
  if constexpr (std::is_same_v<View, PolygonView>) {
    if (!input.is_triangles) {
      for (Index i = 0; i < count; ++i) {
        sum = sum + with_polygon<W>(ids[i], mesh, input, [](const auto&... face) {
                return plain_face_corner<W>(face...);
              });
      }
      return sum;
    }
  }
  return add_triangle_corners_sse<W>(sum, ids, count, input);
}

// The sum again, each term divided by a power of two near the largest.
template <NormalWeight W, class View>
bool sum_in_full_range(VertexId v, const View& mesh, const GatherInput& input, IndexSet& spill,
                       Float3& unit) noexcept {
  int exponent = kNoExponent;
  for_each_corner(mesh, v, [&](Index h) {
    exponent = std::max(exponent, exponent_of(any_corner<W>(h, mesh, input)));
  });
  if (exponent == kNoExponent) return false;
  Float3 sum{0, 0, 0};
  for_each_chunk(mesh, v, spill, [&](Index* ids, Index count) {
    for (Index i = 0; i < count; ++i) {
      sum = sum + scaled(any_corner<W>(ids[i], mesh, input), exponent);
    }
  });
  return normalise_wide(sum, unit);
}

template <NormalWeight W, class View>
void gather_one(VertexId v, const View& mesh, const GatherInput& input, IndexSet& spill,
                TermWindow& window, const NormalWriter& writer, NormalStats& stats) noexcept {
  Float3 sum{0, 0, 0};
  for_each_chunk(mesh, v, spill, [&](Index* ids, Index count) {
    ids[count] = kNoCorner;
    if (add_from_window<W>(ids, ids + count, input, window, sum)) return;
    sum = add_corners<W>(sum, ids, count, mesh, input);
  });
  Float3 unit;
  if (normalise(sum, unit) || sum_in_full_range<W>(v, mesh, input, spill, unit)) {
    writer.write(v.value, unit);
  } else {
    writer.write_degenerate(v.value, stats);
  }
}

template <NormalWeight W, class View>
NormalStats gather(IndexRange range, const View& mesh, const GatherInput& input, IndexSet& spill,
                   TermWindow& window, const NormalWriter& writer) noexcept {
  NormalStats stats;
  for (Index i = range.begin; i < range.end; ++i) {
    gather_one<W>(VertexId(i), mesh, input, spill, window, writer, stats);
  }
  return stats;
}

// Bit i: vertex first + i has one fan at the most. `fan` is moved to the first entry not before it.
std::uint64_t with_one_fan(Index first, Index size, FanTable fans,
                           FanTable::iterator& fan) noexcept {
  while (fan != fans.end() && fan->vertex.value < first) ++fan;
  std::uint64_t wanted = whole_group(size);
  for (; fan != fans.end() && fan->vertex.value < first + size; ++fan) {
    wanted &= ~(std::uint64_t{1} << (fan->vertex.value - first));
  }
  return wanted;
}

template <NormalWeight W>
NormalStats gather_groups(decltype(gather_group_plain<W>) group, IndexRange range,
                          const TriangleView& mesh, const GatherInput& input, IndexSet& spill,
                          TermWindow& window, const NormalWriter& writer) noexcept {
  NormalStats stats;
  auto fan = std::lower_bound(
      mesh.fans.begin(), mesh.fans.end(), range.begin,
      [](const FanStart& start, Index vertex) { return start.vertex.value < vertex; });
  Index i = range.begin;
  while (range.end - i >= kSmallGroup) {
    const Index size = range.end - i >= kLargeGroup ? kLargeGroup : kSmallGroup;
    const std::uint64_t wanted = with_one_fan(i, size, mesh.fans, fan);
    std::uint64_t left =
        group(i, size, wanted, mesh, input, window, writer) | (whole_group(size) & ~wanted);
    for (; left != 0; left &= left - 1) {
      gather_one<W>(VertexId(i + std::countr_zero(left)), mesh, input, spill, window, writer,
                    stats);
    }
    i += size;
  }
  return merge(stats, gather<W>({i, range.end}, mesh, input, spill, window, writer));
}

template <NormalWeight W, class View>
NormalStats gather_each(const Index* ids, Index count, const View& mesh, const GatherInput& input,
                        IndexSet& spill, const NormalWriter& writer) noexcept {
  NormalStats stats;
  TermWindow none;
  for (Index i = 0; i < count; ++i) {
    gather_one<W>(VertexId(ids[i]), mesh, input, spill, none, writer, stats);
  }
  return stats;
}

// Bit i: vertex ids[i] has one fan at the most.
std::uint64_t with_one_fan(const Index* ids, FanTable fans) noexcept {
  if (fans.empty()) return whole_group(kSmallGroup);
  std::uint64_t wanted = 0;
  for (int i = 0; i < static_cast<int>(kSmallGroup); ++i) {
    wanted |= std::uint64_t{extra_fans(fans, VertexId(ids[i])).empty()} << i;
  }
  return wanted;
}

template <NormalWeight W>
NormalStats gather_listed(decltype(gather_listed_avx2<W>) group, const Index* ids, Index count,
                          const TriangleView& mesh, const GatherInput& input, IndexSet& spill,
                          const NormalWriter& writer) noexcept {
  NormalStats stats;
  TermWindow none;
  for (; count >= kSmallGroup; ids += kSmallGroup, count -= kSmallGroup) {
    const std::uint64_t wanted = with_one_fan(ids, mesh.fans);
    std::uint64_t left =
        group(ids, wanted, mesh, input, writer) | (whole_group(kSmallGroup) & ~wanted);
    for (; left != 0; left &= left - 1) {
      const VertexId v(ids[std::countr_zero(left)]);
      gather_one<W>(v, mesh, input, spill, none, writer, stats);
    }
  }
  return merge(stats, gather_each<W>(ids, count, mesh, input, spill, writer));
}

}  // namespace

template <NormalWeight W>
Float3 add_triangle_corners_scalar(Float3 sum, const Index* ids, Index count,
                                   const GatherInput& input) noexcept {
  for (Index i = 0; i < count; ++i) {
    sum = sum + with_triangle(ids[i], input,
                              [](const auto&... corner) { return plain_corner<W>(corner...); });
  }
  return sum;
}

template Float3 add_triangle_corners_scalar<NormalWeight::uniform>(Float3, const Index*, Index,
                                                                   const GatherInput&) noexcept;
template Float3 add_triangle_corners_scalar<NormalWeight::area>(Float3, const Index*, Index,
                                                                const GatherInput&) noexcept;
template Float3 add_triangle_corners_scalar<NormalWeight::angle>(Float3, const Index*, Index,
                                                                 const GatherInput&) noexcept;
template Float3 add_triangle_corners_scalar<NormalWeight::max>(Float3, const Index*, Index,
                                                               const GatherInput&) noexcept;

void fill_face_vectors(IndexRange range, const FaceSource& faces, const Points& points,
                       NormalWeight weight, PolygonMethod method, Wide* out) noexcept {
  with_weight(weight, [&](auto w) {
    for (Index f = range.begin; f < range.end; ++f) {
      out[f] = face_vector<w()>(faces, f, points, method);
    }
  });
}

NormalStats gather_normals(IndexRange range, const TriangleView& mesh, const GatherInput& input,
                           IndexSet& spill, TermWindow& window,
                           const NormalWriter& writer) noexcept {
  return with_weight(input.weight, [&](auto w) {
    // The plain form reads half-edge 0 for vertices without any.
    if (mesh.opposite.empty()) return gather<w()>(range, mesh, input, spill, window, writer);
    const auto group = suits_avx512(input.points) ? gather_group_avx512<w()>
                       : suits_avx2(input.points) ? gather_group_avx2<w()>
                                                  : gather_group_plain<w()>;
    return gather_groups<w()>(group, range, mesh, input, spill, window, writer);
  });
}

NormalStats gather_normals(IndexRange range, const PolygonView& mesh, const GatherInput& input,
                           IndexSet& spill, TermWindow& window,
                           const NormalWriter& writer) noexcept {
  return with_weight(
      input.weight, [&](auto w) { return gather<w()>(range, mesh, input, spill, window, writer); });
}

NormalStats gather_normals(const Index* ids, Index count, const TriangleView& mesh,
                           const GatherInput& input, IndexSet& spill,
                           const NormalWriter& writer) noexcept {
  return with_weight(input.weight, [&](auto w) {
    if (!suits_avx2(input.points)) {
      return gather_each<w()>(ids, count, mesh, input, spill, writer);
    }
    const auto group =
        suits_avx512(input.points) ? gather_listed_avx512<w()> : gather_listed_avx2<w()>;
    return gather_listed<w()>(group, ids, count, mesh, input, spill, writer);
  });
}

NormalStats gather_normals(const Index* ids, Index count, const PolygonView& mesh,
                           const GatherInput& input, IndexSet& spill,
                           const NormalWriter& writer) noexcept {
  return with_weight(input.weight, [&](auto w) {
    return gather_each<w()>(ids, count, mesh, input, spill, writer);
  });
}

}  // namespace hedgerow::kernels
