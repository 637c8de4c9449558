#include <array>
#include <cstdlib>

#include "hedgerow/reorder.h"

namespace hedgerow {

namespace {

constexpr std::int64_t kLineBytes = 64;
constexpr std::int64_t kPositionBytes = 3 * sizeof(float);

// Each line of memory has one place in the cache, as in the simplest hardware: no schedule and no
// machine has a say in what is counted.
class Cache {
 public:
  Cache() { held_.fill(-1); }
  void touch(std::int64_t line) {
    std::int64_t& held = held_[static_cast<std::size_t>(line) % held_.size()];
    fetched_count_ += held != line;
    held = line;
  }
  [[nodiscard]] std::int64_t fetched_count() const { return fetched_count_; }

 private:
  std::array<std::int64_t, 512> held_{};
  std::int64_t fetched_count_ = 0;
};

}  // namespace

Locality locality(const Connectivity& mesh) {
  if (mesh.halfedge_count() == 0) return {};
  return mesh.visit([](const auto& view) {
    Cache cache;
    std::int64_t gaps = 0;
    for (Index i = 0; i < view.halfedge_count(); ++i) {
      const HalfedgeId h(i);
      const std::int64_t v = view.origin[h].value;
      gaps += std::abs(v - static_cast<std::int64_t>(view.target(h).value));
      if (!view.face(h).valid()) continue;
      // A position may lie across two lines.
      cache.touch(v * kPositionBytes / kLineBytes);
      cache.touch((v * kPositionBytes + kPositionBytes - 1) / kLineBytes);
    }
    return Locality{
        static_cast<double>(gaps) / static_cast<double>(view.halfedge_count()),
        static_cast<double>(cache.fetched_count()) / static_cast<double>(view.face_count())};
  });
}

}  // namespace hedgerow
