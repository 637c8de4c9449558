#include "kernels/simd_path.h"

#include <algorithm>
#include <cstdlib>
#include <string_view>

#include "hedgerow/index.h"

namespace hedgerow::kernels {

namespace {

SimdPath widest() noexcept {
#if defined(__x86_64__) && defined(__GNUC__)
  if (sizeof(Index) != 4) return SimdPath::portable;
  if (__builtin_cpu_supports("avx2") == 0 || __builtin_cpu_supports("bmi2") == 0) {
    return SimdPath::portable;
  }
  // Processors before the one that brought VBMI2 lower their clock for 512 bits.
  const bool is_wide = __builtin_cpu_supports("avx512vbmi2") != 0 &&
                       __builtin_cpu_supports("avx512vl") != 0 &&
                       __builtin_cpu_supports("avx512dq") != 0;
  return is_wide ? SimdPath::avx512 : SimdPath::avx2;
#else
  return SimdPath::portable;
#endif
}

SimdPath choose() noexcept {
  const char* wanted = std::getenv("HEDGEROW_SIMD");
  if (wanted == nullptr) return widest();
  if (std::string_view(wanted) == "portable") return SimdPath::portable;
  if (std::string_view(wanted) == "avx2") return std::min(SimdPath::avx2, widest());
  return widest();
}

}  // namespace

SimdPath simd_path() noexcept {
  static const SimdPath path = choose();
  return path;
}

}  // namespace hedgerow::kernels
