#pragma once

#include "hedgerow/normals.h"
#include "kernels/normals_lanes.h"

/// The one definition of what a corner adds to its vertex, from which every method is made.
namespace hedgerow::kernels {

template <class T>
struct Vec3 {
  T x, y, z;

  friend Vec3 operator+(Vec3 a, Vec3 b) noexcept { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Vec3 operator-(Vec3 a, Vec3 b) noexcept { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Vec3 operator*(Vec3 a, T s) noexcept { return {a.x * s, a.y * s, a.z * s}; }
};

using Float3 = Vec3<float>;

template <class T>
[[nodiscard]] inline T dot(Vec3<T> a, Vec3<T> b) noexcept {
  return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
template <class T>
[[nodiscard]] inline Vec3<T> cross(Vec3<T> a, Vec3<T> b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Squares outside these have lost digits to underflow or are near overflow; not a number is
/// outside. What depends on such a square is computed in double instead.
inline constexpr float kSmallSquare = 0x1p-120f;
inline constexpr float kLargeSquare = 0x1p120f;

template <class T>
[[nodiscard]] inline auto is_usual(T square) noexcept {
  return (square >= T(kSmallSquare)) & (square <= T(kLargeSquare));
}
/// The same for one of two squares that are multiplied.
template <class T>
[[nodiscard]] inline auto is_usual_factor(T square) noexcept {
  return (square >= T(0x1p-60f)) & (square <= T(0x1p60f));
}

inline constexpr float kPi = 3.14159265358979323846f;

/// Where the condition holds, a + b, a - b and whole - a; elsewhere a. \pre no lane of a is -0
template <class Condition, class T>
[[nodiscard, gnu::always_inline]] inline T more_where(Condition condition, T a, T b) noexcept {
  return a + kept(condition, b);
}
template <class Condition, class T>
[[nodiscard, gnu::always_inline]] inline T less_where(Condition condition, T a, T b) noexcept {
  return a - kept(condition, b);
}
template <class Condition, class T>
[[nodiscard, gnu::always_inline]] inline T rest_where(Condition condition, T a, T whole) noexcept {
  return kept(condition, whole) + negated(condition, a);
}

// The angle in [0, pi / 2] of which `adjacent`, not below 0, is the dot product. One of the
// two is not 0.
//
// atan(t) = t + t^3 P(t^2) for t <= tan(pi / 8), found by the exchange algorithm: off by 4.9e-9 at
// the most before rounding. Larger slopes are first turned by pi / 4, where
// atan(a / b) = pi / 4 - atan((b - a) / (b + a)).
template <class T>
[[nodiscard, gnu::always_inline]] inline T acute_angle_of(T cross_length, T adjacent) noexcept {
  const T low = smaller(cross_length, adjacent);
  const T high = larger(cross_length, adjacent);
  const auto is_steep = low > high * T(0.41421356f);
  const T numerator = less_where(is_steep, low, high);
  const T denominator = more_where(is_steep, high, low);
  const T t = numerator / denominator;
  const T s = t * t;
  T p = T(0x1.43ae18p-4f) * s + T(-0x1.1b1f8ap-3f);
  p = p * s + T(0x1.99062p-3f);
  p = p * s + T(-0x1.5553d2p-2f);
  const T small_angle = more_where(is_steep, t + t * (s * p), T(0.25f * kPi));
  return rest_where(cross_length > adjacent, small_angle, T(0.5f * kPi));
}

template <class T>
[[nodiscard, gnu::always_inline]] inline T angle_of(T cross_length, T dot_product) noexcept {
  // 0 / 0 is no angle.
  const T acute = acute_angle_of(cross_length, larger(magnitude(dot_product), T(0x1p-149f)));
  return rest_where(dot_product < T(0.0f), acute, T(kPi));
}

template <class Condition, class T>
[[nodiscard]] inline Vec3<T> select(Condition condition, Vec3<T> a, Vec3<T> b) noexcept {
  return {select(condition, a.x, b.x), select(condition, a.y, b.y), select(condition, a.z, b.z)};
}

/// What the corners of a triangle add by area. Its edges run towards the first corner, which suits
/// processors that take one side of a difference from memory.
///
/// There is no need to know its size. Where it is beyond float, so is the sum, which is then made
/// again; where products are too small, they are off by 2^-147, and no sum is used below 2^-60.
template <class T>
[[nodiscard]] inline Vec3<T> area_term(Vec3<T> p0, Vec3<T> p1, Vec3<T> p2) noexcept {
  return cross(p0 - p1, p0 - p2);
}

/// A comparison that holds in every lane.
template <class T>
[[nodiscard]] inline auto everywhere() noexcept {
  return T(0.0f) <= T(0.0f);
}

/// What the three corners of a triangle have in common, and what tells them apart.
template <class T>
struct TriangleTerms {
  Vec3<T> base;  ///< area and max: the area vector; uniform and angle: the unit normal
  T length;      ///< angle: length of the area vector
  T factor[3];   ///< angle: dot product at the corner; max: product of the squared lengths there;
                 ///< else nothing
};

/// The first step to `terms`: uniform and angle still have the area vector as base, and the square
/// of its length as length. Returns in which lanes the terms may be used. (Inlined by force, as is
/// what it hands over: a call passes all lanes through memory.)
template <NormalWeight W, class T>
[[nodiscard, gnu::always_inline]] inline auto begin_terms(Vec3<T> p0, Vec3<T> p1, Vec3<T> p2,
                                                          TriangleTerms<T>& terms) noexcept {
  static_assert(W != NormalWeight::area);
  const Vec3<T> u = p1 - p0;
  const Vec3<T> v = p2 - p0;
  const Vec3<T> area = cross(u, v);
  const T square = dot(area, area);
  terms.base = area;
  terms.length = square;
  if constexpr (W == NormalWeight::uniform) {
    return is_usual(square);
  } else if constexpr (W == NormalWeight::angle) {
    const Vec3<T> w = p2 - p1;
    terms.factor[0] = dot(u, v);
    terms.factor[1] = T(0.0f) - dot(u, w);
    terms.factor[2] = dot(v, w);
    // Half the sum of the squares of the edges: |u|^2 is the sum of the first two, and so on. Its
    // square is no less than that of the area vector.
    const T extent = (terms.factor[0] + terms.factor[1]) + terms.factor[2];
    return (square >= T(kSmallSquare)) & (extent <= T(0x1p60f));
  } else {
    const Vec3<T> w = p2 - p1;
    const T uu = dot(u, u);
    const T vv = dot(v, v);
    const T ww = dot(w, w);
    terms.factor[0] = uu * vv;
    terms.factor[1] = uu * ww;
    terms.factor[2] = vv * ww;
    // From the two shorter edges: rounding turns a cross product by about 2^-24 / sin(angle between
    // the two), and the sine is largest across the longest edge. `max` gives needles, where the
    // corners differ most, the most weight.
    const auto is_u_longest = (uu > vv) & (uu > ww);
    const auto is_w_longest = (ww > vv) & (ww > uu);
    terms.base = cross(select(is_u_longest, v, u), select(is_w_longest, v, w));
    return is_usual_factor(uu) & is_usual_factor(vv) & is_usual_factor(ww);
  }
}

/// The second step, a square root and a division that wait for each other.
template <NormalWeight W, class T>
[[gnu::always_inline]] inline void finish_terms(TriangleTerms<T>& terms) noexcept {
  if constexpr (W == NormalWeight::uniform || W == NormalWeight::angle) {
    terms.length = square_root(terms.length);
    terms.base = terms.base * (T(1.0f) / terms.length);
  }
}

/// Both. Fills `terms` and returns in which lanes it may be used.
template <NormalWeight W, class T>
[[nodiscard, gnu::always_inline]] inline auto triangle_terms(Vec3<T> p0, Vec3<T> p1, Vec3<T> p2,
                                                             TriangleTerms<T>& terms) noexcept {
  if constexpr (W == NormalWeight::area) {
    terms.base = area_term(p0, p1, p2);
    return everywhere<T>();
  } else {
    const auto usual = begin_terms<W>(p0, p1, p2, terms);
    finish_terms<W>(terms);
    return usual;
  }
}

/// The angles at the corners of a triangle, from the dot products there. That at the smallest one,
/// the largest angle, is what the two others, both acute, leave of half a turn: a division and a
/// polynomial less, and off by no more than these together, of 60 degrees or more.
template <class T>
[[gnu::always_inline]] inline void angles_of(T cross_length, const T (&dots)[3],
                                             T (&angles)[3]) noexcept {
  const auto is_first = (dots[0] <= dots[2]) & (dots[0] < dots[1]);
  const auto is_third = (dots[2] < dots[0]) & (dots[2] < dots[1]);
  // Rounding may leave the cosine of a right angle below 0.
  const T a = larger(select(is_first, dots[1], dots[0]), T(0.0f));
  const T b = larger(select(is_third, dots[1], dots[2]), T(0.0f));
  const T before = acute_angle_of(cross_length, a);
  const T after = acute_angle_of(cross_length, b);
  const T largest = (T(kPi) - before) - after;
  angles[0] = select(is_first, largest, before);
  angles[1] = select(is_first, before, select(is_third, after, largest));
  angles[2] = select(is_third, largest, after);
}

/// By what each corner multiplies the base, where they differ.
template <NormalWeight W, class T>
[[gnu::always_inline]] inline void corner_weights(const TriangleTerms<T>& terms,
                                                  T (&weights)[3]) noexcept {
  if constexpr (W == NormalWeight::angle) {
    angles_of(terms.length, terms.factor, weights);
  } else {
    for (int k = 0; k < 3; ++k) weights[k] = T(1.0f) / terms.factor[k];
  }
}

/// What one corner adds: the first one, the third one, or else the second.
template <NormalWeight W, class T, class Condition>
[[nodiscard, gnu::always_inline]] inline Vec3<T> corner_term(const TriangleTerms<T>& terms,
                                                             Condition is_first,
                                                             Condition is_third) noexcept {
  const auto chosen = [&](const T(&of)[3]) {
    return select(is_first, of[0], select(is_third, of[2], of[1]));
  };
  if constexpr (W == NormalWeight::angle) {
    T angles[3];
    angles_of(terms.length, terms.factor, angles);
    return terms.base * chosen(angles);
  } else if constexpr (W == NormalWeight::max) {
    return terms.base * (T(1.0f) / chosen(terms.factor));
  } else {
    return terms.base;
  }
}

/// A float vector times 2^exponent. Usual values have exponent 0; zero says "no direction".
struct Wide {
  Float3 v{0, 0, 0};
  int exponent = 0;
};

/// What corner k of a triangle adds, in full range. Points that are not finite add nothing.
template <NormalWeight W>
[[nodiscard]] Wide wide_corner(Float3 p0, Float3 p1, Float3 p2, int k) noexcept;

/// What a corner of a polygon of at least four corners adds. `face`: see `face_vector`.
template <NormalWeight W>
[[nodiscard]] Wide wide_corner(const Wide& face, Float3 before, Float3 here, Float3 after) noexcept;

/// The area vector of a triangle; where `unit`, divided by its length.
[[nodiscard]] Wide triangle_vector(Float3 p0, Float3 p1, Float3 p2, bool unit) noexcept;

/// The value as a plain float vector. Not a number where that would lose digits, so that the sum is
/// found out and done again in full range.
[[nodiscard]] Float3 narrow(const Wide& value) noexcept;

/// The exponent of the largest component, or kNoExponent for zero.
inline constexpr int kNoExponent = -2000;
[[nodiscard]] int exponent_of(const Wide& value) noexcept;
/// The value divided by 2^exponent, as a plain float vector.
[[nodiscard]] Float3 scaled(const Wide& value, int exponent) noexcept;

/// The unit vector of a sum scaled by `exponent_of` its largest term. False: the sum is zero.
[[nodiscard]] bool normalise_wide(Float3 sum, Float3& unit) noexcept;

/// Whether corner p0, p1, p2 of the float path may be used; if so, the sum's unit vector.
[[nodiscard]] inline bool normalise(Float3 sum, Float3& unit) noexcept {
  const float square = dot(sum, sum);
  if (!is_usual(square)) return false;
  unit = sum * (1.0f / square_root(square));
  return true;
}

}  // namespace hedgerow::kernels
