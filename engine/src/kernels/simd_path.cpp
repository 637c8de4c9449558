#include "kernels/simd_path.h"

#include <cstdlib>
#include <string_view>

#include "hedgerow/index.h"

namespace hedgerow::kernels {

namespace {

SimdPath choose() noexcept {
  const char* wanted = std::getenv("HEDGEROW_SIMD");
  if (wanted != nullptr && std::string_view(wanted) == "portable") return SimdPath::portable;
#if defined(__x86_64__) && defined(__GNUC__)
  if (sizeof(Index) == 4 && __builtin_cpu_supports("avx2") != 0) return SimdPath::avx2;
#endif
  return SimdPath::portable;
}

}  // namespace

SimdPath simd_path() noexcept {
  static const SimdPath path = choose();
  return path;
}

}  // namespace hedgerow::kernels
