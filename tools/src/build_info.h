#pragma once

#include <string>

namespace hedgerow::tool {

/// How this program was built.
struct BuildInfo {
  const char* version;
  const char*
      commit;  ///< "unknown" where there was no git; ends in "-changed" if the tree differed
  const char* compiler;
  const char* flags;
  const char* build_type;
  int index_bits;
  const char* simd;  ///< the widest vector instructions the engine was compiled for
};

[[nodiscard]] const BuildInfo& build_info() noexcept;

/// What --version prints.
[[nodiscard]] std::string version_text();

}  // namespace hedgerow::tool
