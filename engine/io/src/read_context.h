#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "failure.h"
#include "hedgerow/io/read.h"

namespace hedgerow::io {

/// Calls the caller's callback now and then; costs one comparison where it is asked.
class Progress {
 public:
  Progress(const std::function<void(std::int64_t, std::int64_t)>& callback, std::size_t total)
      : callback_(callback),
        total_(total),
        step_(total / 100 + 1),
        next_(callback ? 0 : ~std::size_t{0}) {}

  void at(std::size_t done) {
    if (done >= next_) report(done);
  }

 private:
  void report(std::size_t done) {
    next_ = done + step_;
    callback_(static_cast<std::int64_t>(done), static_cast<std::int64_t>(total_));
  }

  const std::function<void(std::int64_t, std::int64_t)>& callback_;
  std::size_t total_;
  std::size_t step_;
  std::size_t next_;
};

/// What each reader is given.
struct ReadContext {
  std::span<const char> bytes;
  const ReadOptions& options;
  std::filesystem::path path;
  Progress progress;
  std::vector<ReadWarning> warnings;

  /// Counts a warning; only the first of its code keeps its place.
  void warn(const char* code, std::size_t offset, Place place, std::string message);
};

[[nodiscard]] Parsed<Soup> read_obj(ReadContext& context);
[[nodiscard]] Parsed<Soup> read_ply(ReadContext& context);
[[nodiscard]] Parsed<Soup> read_off(ReadContext& context);
[[nodiscard]] Parsed<Soup> read_stl(ReadContext& context);
[[nodiscard]] Parsed<Soup> read_gltf(ReadContext& context);
[[nodiscard]] Parsed<Soup> read_glb(ReadContext& context);
[[nodiscard]] Parsed<Soup> read_wet(ReadContext& context);

}  // namespace hedgerow::io
