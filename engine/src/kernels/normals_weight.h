#pragma once

#include <type_traits>
#include <utility>

#include "kernels/normals_source.h"

namespace hedgerow::kernels {

template <NormalWeight W>
using WeightTag = std::integral_constant<NormalWeight, W>;

/// Calls `function(WeightTag<weight>)`, so that a loop is compiled once for each weight.
template <class Function>
inline decltype(auto) with_weight(NormalWeight weight, Function&& function) noexcept {
  switch (weight) {
    case NormalWeight::uniform:
      return std::forward<Function>(function)(WeightTag<NormalWeight::uniform>());
    case NormalWeight::angle:
      return std::forward<Function>(function)(WeightTag<NormalWeight::angle>());
    case NormalWeight::max:
      return std::forward<Function>(function)(WeightTag<NormalWeight::max>());
    default:
      return std::forward<Function>(function)(WeightTag<NormalWeight::area>());
  }
}

/// What corner k of a triangle adds, as a plain float vector.
template <NormalWeight W>
[[nodiscard]] inline Float3 plain_corner(Float3 p0, Float3 p1, Float3 p2, int k) noexcept {
  if constexpr (W == NormalWeight::area) return area_term(p0, p1, p2);
  return narrow(wide_corner<W>(p0, p1, p2, k));
}

/// What all of them add.
template <NormalWeight W>
inline void triangle_corners(Float3 p0, Float3 p1, Float3 p2, Float3* out) noexcept {
  TriangleTerms<float> terms;
  if (triangle_terms<W>(p0, p1, p2, terms)) [[likely]] {
    float weights[3] = {1, 1, 1};
    if constexpr (W == NormalWeight::angle || W == NormalWeight::max) {
      corner_weights<W>(terms, weights);
    }
    for (int k = 0; k < 3; ++k) out[k] = terms.base * weights[k];
  } else {
    for (int k = 0; k < 3; ++k) out[k] = plain_corner<W>(p0, p1, p2, k);
  }
}

/// The vector that the corners of face f of any degree share, as each adds it: nothing for `max`.
template <NormalWeight W>
[[nodiscard]] inline Wide face_vector(const FaceSource& faces, Index f, const Points& points,
                                      PolygonMethod method) noexcept {
  if constexpr (W == NormalWeight::max) return {};
  const Index begin = faces.begin(f);
  if (W == NormalWeight::area && faces.begin(f + 1) - begin == 3) {
    const auto point = [&](Index k) { return points[faces.corner(begin + k)]; };
    return {area_term(point(0), point(1), point(2)), 0};
  }
  return polygon_vector(faces, f, points, method, W != NormalWeight::area);
}

/// What corner k of a face of `degree` corners adds, in full range. `face`: see `face_vector`;
/// `point(k)` is its k-th position.
template <NormalWeight W, class Point>
[[nodiscard]] inline Wide face_corner(const Wide& face, Index degree, Index k,
                                      const Point& point) noexcept {
  if (degree < 3) return {};
  if (degree == 3) return wide_corner<W>(point(0), point(1), point(2), static_cast<int>(k));
  return wide_corner<W>(face, point(k == 0 ? degree - 1 : k - 1), point(k),
                        point(k + 1 == degree ? 0 : k + 1));
}

/// The same as a plain float vector.
template <NormalWeight W, class Point>
[[nodiscard]] inline Float3 plain_face_corner(const Wide& face, Index degree, Index k,
                                              const Point& point) noexcept {
  if constexpr (W == NormalWeight::area || W == NormalWeight::uniform) return narrow(face);
  return narrow(face_corner<W>(face, degree, k, point));
}

}  // namespace hedgerow::kernels
