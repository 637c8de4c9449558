#include "build_info.h"

#include <fmt/format.h>

#include "commit.h"         // written by cmake at build time
#include "configuration.h"  // written by cmake at configure time
#include "hedgerow/index.h"

namespace hedgerow::tool {

const BuildInfo& build_info() noexcept {
  static constexpr BuildInfo kInfo {
    .version = kVersion, .commit = kCommit, .compiler = kCompiler, .flags = kFlags,
    .build_type = kBuildType, .index_bits = 8 * static_cast<int>(sizeof(Index)),
#if defined(__AVX2__)
    .simd = "avx2",
#elif defined(__SSE4_1__)
    .simd = "sse4.1",
#elif defined(__SSE2__)
    .simd = "sse2",
#elif defined(__ARM_NEON)
    .simd = "neon",
#else
    .simd = "scalar",
#endif
  };
  return kInfo;
}

std::string version_text() {
  const BuildInfo& info = build_info();
  return fmt::format(
      "hedgerow {}\ncommit    {}\ncompiler  {} ({})\nindices   {} bits\nSIMD      {}", info.version,
      info.commit, info.compiler, info.build_type, info.index_bits, info.simd);
}

}  // namespace hedgerow::tool
