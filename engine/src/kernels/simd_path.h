#pragma once

namespace hedgerow::kernels {

/// Which form of a kernel runs, where it has more than one. All give the same bits.
enum class SimdPath {
  portable,  ///< what every processor of the architecture can
  avx2,      ///< eight lanes; chosen where the processor has them
};

/// The widest path of this processor and build, or a narrower one that the environment variable
/// HEDGEROW_SIMD ("portable", "avx2") asks for. Chosen at the first call.
[[nodiscard]] SimdPath simd_path() noexcept;

}  // namespace hedgerow::kernels
