#pragma once

namespace hedgerow::kernels {

/// Which form of a kernel runs, where it has more than one. All give the same bits.
/// A wider one has what the narrower ones have.
enum class SimdPath {
  portable,  ///< what every processor of the architecture can
  avx2,      ///< eight lanes, and BMI2
  avx512,    ///< sixteen, for the few kernels that gain from them; from Ice Lake and Zen 4 on,
             ///< which do not slow down for it
};

/// The widest path of this processor and build, or a narrower one that the environment variable
/// HEDGEROW_SIMD ("portable", "avx2", "avx512") asks for. Chosen at the first call.
[[nodiscard]] SimdPath simd_path() noexcept;

[[nodiscard]] inline bool has_avx2() noexcept { return simd_path() >= SimdPath::avx2; }
[[nodiscard]] inline bool has_avx512() noexcept { return simd_path() >= SimdPath::avx512; }

}  // namespace hedgerow::kernels
