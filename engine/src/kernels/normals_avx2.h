#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "kernels/index_lanes.h"
#include "kernels/normals_source.h"
#include "kernels/point_rows.h"

#if defined(__AVX2__)

/// Moving float3 values in and out of eight lanes; for sources compiled for AVX2.
///
/// All of it is local to the source: what a compiler does not inline must not become the copy that
/// the linker picks for sources without AVX2.
namespace hedgerow::kernels {
namespace {

[[nodiscard]] inline __m256i load_indices(const Index* p) noexcept {
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(p));
}

/// Rows 0 .. 3 in the low halves, rows 4 .. 7 in the high ones, as x, y and z of eight lanes.
[[nodiscard]] inline Vec3<Float8> to_lanes(__m256 row04, __m256 row15, __m256 row26,
                                           __m256 row37) noexcept {
  const __m256 xy_low = _mm256_unpacklo_ps(row04, row15);
  const __m256 z_low = _mm256_unpackhi_ps(row04, row15);
  const __m256 xy_high = _mm256_unpacklo_ps(row26, row37);
  const __m256 z_high = _mm256_unpackhi_ps(row26, row37);
  return {_mm256_shuffle_ps(xy_low, xy_high, 0x44), _mm256_shuffle_ps(xy_low, xy_high, 0xee),
          _mm256_shuffle_ps(z_low, z_high, 0x44)};
}

/// Eight vectors as rows x, y, z, w: row[j] has those of lanes j and j + 4.
struct PairedRows {
  __m256 row[4];
};
[[nodiscard, gnu::always_inline]] inline PairedRows to_paired_rows(const Vec3<Float8>& v,
                                                                   float w) noexcept {
  const __m256 last = _mm256_set1_ps(w);
  const __m256 xy_low = _mm256_unpacklo_ps(v.x.bits, v.y.bits);
  const __m256 xy_high = _mm256_unpackhi_ps(v.x.bits, v.y.bits);
  const __m256 zw_low = _mm256_unpacklo_ps(v.z.bits, last);
  const __m256 zw_high = _mm256_unpackhi_ps(v.z.bits, last);
  return {{_mm256_shuffle_ps(xy_low, zw_low, 0x44), _mm256_shuffle_ps(xy_low, zw_low, 0xee),
           _mm256_shuffle_ps(xy_high, zw_high, 0x44), _mm256_shuffle_ps(xy_high, zw_high, 0xee)}};
}

/// The same one by one, in the order of the lanes.
struct Rows8 {
  __m128 row[8];
};
[[nodiscard, gnu::always_inline]] inline Rows8 to_rows(const Vec3<Float8>& v, float w) noexcept {
  const PairedRows pairs = to_paired_rows(v, w);
  Rows8 rows;
  for (int i = 0; i < 4; ++i) {
    rows.row[i] = _mm256_castps256_ps128(pairs.row[i]);
    rows.row[i + 4] = _mm256_extractf128_ps(pairs.row[i], 1);
  }
  return rows;
}

/// Loads the positions of the corners of eight triangles into lanes. `kFloats` is the stride of the
/// positions, or 0 for "what they say", which takes a multiplication a corner.
///
/// A position is loaded as 16 bytes, one load where gathering coordinates takes three. Nothing is
/// read beyond the three floats of the last position: a group that has it among its corners is
/// loaded float by float.
/// \pre `suits_avx2(points)`
template <std::size_t kFloats>
class TriangleLoader {
 public:
  using Float = Float8;
  static constexpr Index kLanes = 8;

  explicit TriangleLoader(const Points& points) noexcept
      : rows_(points), last_(_mm256_set1_epi32(static_cast<int>(rows_.last()))) {}

  /// As `PointRows` does.
  template <Index kTriangles = kLanes>
  [[gnu::always_inline]] void prefetch(const Index* corners, std::ptrdiff_t left) const noexcept {
    rows_.template prefetch<kTriangles>(corners, left);
  }
  [[nodiscard, gnu::always_inline]] const float* at(Index v) const noexcept { return rows_.at(v); }

  /// The corners of eight triangles, lane by lane as `store_turned` wants them: lane i has triangle
  /// 2 (i mod 4) + i / 4, so that the two halves of a row are triangles in a row.
  [[gnu::always_inline]] void load_turned(const Index* corners,
                                          Vec3<Float8> (&p)[3]) const noexcept {
    const auto corner = [corners](int i, int k) -> Index {
      return corners[3 * (2 * (i % 4) + i / 4) + k];
    };
    load(corner, largest_of(corners), p);
  }
  /// Such lanes and `w` as rows, in the order of the triangles.
  [[gnu::always_inline]] static void store_turned(const Vec3<Float8>& v, float w,
                                                  __m128* rows) noexcept {
    const PairedRows pairs = to_paired_rows(v, w);
    auto* to = reinterpret_cast<float*>(rows);
    for (int j = 0; j < 4; ++j) _mm256_store_ps(to + 8 * j, pairs.row[j]);
  }

  /// Whether the last vertex is among the corners of eight triangles.
  [[nodiscard]] bool has_last(const Index* corners) const noexcept {
    return is_any_last(largest_of(corners));
  }
  /// The positions of two vertices, as rows of x, y, z and what lies behind them. \pre neither is
  /// the last vertex
  [[nodiscard]] __m256 load_two(Index low, Index high) const noexcept {
    return _mm256_insertf128_ps(_mm256_castps128_ps256(rows_[low]), rows_[high], 1);
  }

  /// Lane i of p[k] is at corners[3 i + k].
  [[gnu::always_inline]] void load(const Index* corners, Vec3<Float8> (&p)[3]) const noexcept {
    const auto corner = [corners](int i, int k) -> Index { return corners[3 * i + k]; };
    load(corner, largest_of(corners), p);
  }
  /// Lane i of p[k] is at corners[first + k], where `first` is lane i of `firsts`. All but the last
  /// triangle of `corners` may be named; behind the last there is nothing to read.
  [[gnu::always_inline]] void load(const Index* corners, Int8 firsts,
                                   Vec3<Float8> (&p)[3]) const noexcept {
    alignas(32) int first[8];
    _mm256_store_si256(reinterpret_cast<__m256i*>(first), firsts.bits);
    // Keeps the compiler from taking the lanes out of the vector one by one, at twice the work.
    asm volatile("" : "+m"(first));
    const auto quad = [&](int i) {
      return _mm_loadu_si128(reinterpret_cast<const __m128i*>(corners + first[i]));
    };
    __m128i largest = quad(0);
    for (int i = 1; i < 8; ++i) largest = _mm_max_epi32(largest, quad(i));
    const auto corner = [&](int i, int k) -> Index { return corners[first[i] + k]; };
    load(corner, _mm256_castsi128_si256(largest), p);
  }

 private:
  // One lane has the largest of 24.
  [[nodiscard]] static __m256i largest_of(const Index* corners) noexcept {
    const __m256i some = _mm256_max_epi32(load_indices(corners), load_indices(corners + 8));
    return _mm256_max_epi32(some, load_indices(corners + 16));
  }
  [[nodiscard]] bool is_any_last(__m256i largest) const noexcept {
    return _mm256_movemask_epi8(_mm256_cmpeq_epi32(largest, last_)) != 0;
  }

  // Corner k of triangle i is corner(i, k); `largest` has the largest of them in one of its lanes,
  // and nothing larger than the last vertex.
  template <class Corner>
  [[gnu::always_inline]] void load(const Corner& corner, __m256i largest,
                                   Vec3<Float8> (&p)[3]) const noexcept {
    // Each by its own name: an array filled in a loop stays in memory, and what is computed of it
    // waits for the way there and back.
    if (is_any_last(largest)) [[unlikely]] {
      p[0] = one_by_one(corner, 0);
      p[1] = one_by_one(corner, 1);
      p[2] = one_by_one(corner, 2);
    } else {
      p[0] = as_rows(corner, 0);
      p[1] = as_rows(corner, 1);
      p[2] = as_rows(corner, 2);
    }
  }

  template <class Corner>
  [[nodiscard, gnu::always_inline]] Vec3<Float8> as_rows(const Corner& corner,
                                                         int k) const noexcept {
    return to_lanes(load_two(corner(0, k), corner(4, k)), load_two(corner(1, k), corner(5, k)),
                    load_two(corner(2, k), corner(6, k)), load_two(corner(3, k), corner(7, k)));
  }

  template <class Corner>
  [[nodiscard, gnu::noinline]] Vec3<Float8> one_by_one(const Corner& corner, int k) const noexcept {
    alignas(32) float xyz[3][8];
    for (int i = 0; i < 8; ++i) {
      const float* p = at(corner(i, k));
      for (int c = 0; c < 3; ++c) xyz[c][i] = p[c];
    }
    return {_mm256_load_ps(xyz[0]), _mm256_load_ps(xyz[1]), _mm256_load_ps(xyz[2])};
  }

  PointRows<kFloats> rows_;
  __m256i last_;
};

/// Calls `function(loader)` with the one for the stride of the positions.
template <class Function>
inline decltype(auto) with_loader(const Points& points, const Function& function) noexcept {
  return points.positions.stride_bytes == sizeof(float[3]) ? function(TriangleLoader<3>(points))
                                                           : function(TriangleLoader<0>(points));
}

/// Eight float3 in a row are three vectors exactly: `load_triangles` the other way round. `Store`
/// is how to store one of them.
template <class Store>
inline void store_packed(float* out, const Vec3<Float8>& v, const Store& store) noexcept {
  const __m256 x = _mm256_permutevar8x32_ps(v.x.bits, _mm256_setr_epi32(0, 3, 6, 1, 4, 7, 2, 5));
  const __m256 y = _mm256_permutevar8x32_ps(v.y.bits, _mm256_setr_epi32(5, 0, 3, 6, 1, 4, 7, 2));
  const __m256 z = _mm256_permutevar8x32_ps(v.z.bits, _mm256_setr_epi32(2, 5, 0, 3, 6, 1, 4, 7));
  const auto blend = [](__m256 p, __m256 q, __m256 r) {
    return _mm256_blend_ps(_mm256_blend_ps(p, q, 0x92), r, 0x24);
  };
  store(out, blend(x, y, z));
  store(out + 8, blend(z, x, y));
  store(out + 16, blend(y, z, x));
}

/// Writes unit vectors, eight at a time, the way that suits their place.
class Writer8 {
 public:
  /// For elements from `first` on, in steps of eight.
  Writer8(const NormalWriter& writer, Index first) noexcept : writer_(writer) {
    const bool is_packed = writer.out.stride_bytes == sizeof(float[3]);
    const bool is_aligned = steps_to_alignment(writer.out[first]) == 0;
    way_ = !is_packed                         ? Way::strided
           : writer.is_streamed && is_aligned ? Way::streamed
                                              : Way::packed;
  }
  Writer8(const Writer8&) = delete;
  Writer8& operator=(const Writer8&) = delete;
  /// What was streamed is seen by whoever this thread tells that it is done.
  ~Writer8() {
    if (way_ == Way::streamed) _mm_sfence();
  }

  /// How many elements from `first` on are to be written otherwise, so that the rest can be
  /// streamed: 0 to 7.
  [[nodiscard]] static Index head(const NormalWriter& writer, Index first) noexcept {
    return writer.is_streamed ? steps_to_alignment(writer.out[first]) : 0;
  }

  void write(Index first, const Vec3<Float8>& v) const noexcept {
    float* p = writer_.out[first];
    if (way_ == Way::streamed) {
      store_packed(p, v, [](float* to, __m256 part) { _mm256_stream_ps(to, part); });
    } else if (way_ == Way::packed) {
      store_packed(p, v, [](float* to, __m256 part) { _mm256_storeu_ps(to, part); });
    } else {
      const Rows8 rows = to_rows(v, 0);
      for (Index i = 0; i < 8; ++i) {
        alignas(16) float xyz[4];
        _mm_store_ps(xyz, rows.row[i]);
        writer_.write(first + i, {xyz[0], xyz[1], xyz[2]});
      }
    }
  }

 private:
  enum class Way { strided, packed, streamed };

  // Steps of three floats until the address is a multiple of eight: with word w, w + 3 n = 0 modulo
  // 8 has the solution n = -3 w, as 3 times 3 is 1.
  static Index steps_to_alignment(const float* p) noexcept {
    const std::uintptr_t word = reinterpret_cast<std::uintptr_t>(p) / sizeof(float);
    return static_cast<Index>((0 - 3 * word) & 7U);
  }

  const NormalWriter& writer_;
  Way way_;
};

inline void write(const Writer8& writer8, Index first, const Vec3<Float8>& units) noexcept {
  writer8.write(first, units);
}

}  // namespace
}  // namespace hedgerow::kernels

#endif
