#include <iterator>

#include "hedgerow/defect.h"
#include "hedgerow/result.h"

namespace hedgerow {

namespace {
constexpr const char* kErrorNames[] = {"index-out-of-range",
                                       "too-few-corners",
                                       "repeated-vertex",
                                       "duplicate-face",
                                       "nonmanifold-edge",
                                       "inconsistent-edge",
                                       "nonmanifold-vertex",
                                       "isolated-vertex",
                                       "too-many-elements",
                                       "bad-face-offsets",
                                       "null-pointer",
                                       "bad-stride",
                                       "count-mismatch",
                                       "unsupported-policy",
                                       "scratch-too-small",
                                       "already-closed",
                                       "already-open",
                                       "not-canonical",
                                       "inconsistent-table",
                                       "not-triangles",
                                       "needs-padding",
                                       "ray-library",
                                       "coordinate-out-of-range",
                                       "crossing-edges",
                                       "site-outside-box"};
static_assert(std::size(kErrorNames) == static_cast<std::size_t>(ErrorCode::site_outside_box) + 1);

constexpr const char* kDefectNames[] = {
    "out-of-range",     "too-few-corners",   "repeated-vertex",    "duplicate-face",
    "nonmanifold-edge", "inconsistent-edge", "nonmanifold-vertex", "isolated-vertex"};
static_assert(std::size(kDefectNames) == kDefectKindCount);

constexpr const char* kActionNames[] = {"fail", "skip", "cut", "split", "keep"};

template <class Enum, std::size_t N>
std::optional<Enum> find_word(const char* const (&names)[N], std::string_view word) noexcept {
  for (std::size_t i = 0; i < N; ++i) {
    if (word == names[i]) return static_cast<Enum>(i);
  }
  return std::nullopt;
}
}  // namespace

const char* name(ErrorCode code) noexcept { return kErrorNames[static_cast<std::size_t>(code)]; }
const char* name(DefectKind kind) noexcept { return kDefectNames[static_cast<std::size_t>(kind)]; }
const char* name(Action action) noexcept { return kActionNames[static_cast<std::size_t>(action)]; }

std::optional<DefectKind> defect_kind_named(std::string_view word) noexcept {
  return find_word<DefectKind>(kDefectNames, word);
}
std::optional<Action> action_named(std::string_view word) noexcept {
  return find_word<Action>(kActionNames, word);
}

}  // namespace hedgerow
