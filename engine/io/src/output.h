#pragma once

#include <bit>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <vector>

#include "binary_value.h"
#include "hedgerow/io/atomic_file.h"
#include "hedgerow/io/write.h"

namespace hedgerow::io {

/// Gathers bytes into blocks for an `AtomicFile`. After a failed write the rest is dropped, and
/// `finish` reports the failure: writers need not check each value.
class Output {
 public:
  explicit Output(AtomicFile& file) : file_(file), block_(kBlockBytes) {}

  void text(std::string_view characters) {
    make_room(characters.size());
    std::memcpy(block_.data() + used_, characters.data(), characters.size());
    used_ += characters.size();
  }
  void character(char c) {
    make_room(1);
    block_[used_++] = c;
  }
  /// The fewest digits that read back to the same float; no locale.
  void number(float value) { digits(value); }
  void number(std::int64_t value) { digits(value); }
  template <class T>
  void little_endian(T value) {
    raw<T, std::endian::native == std::endian::big>(value);
  }
  template <class T>
  void big_endian(T value) {
    raw<T, std::endian::native == std::endian::little>(value);
  }
  /// Writes what is left and puts the file in its place.
  [[nodiscard]] IoResult<void> finish() {
    flush();
    if (!result_) return result_;
    return file_.commit();
  }

 private:
  static constexpr std::size_t kBlockBytes = std::size_t{1} << 18;
  static constexpr std::size_t kLongestNumber = 64;

  template <class T>
  void digits(T value) {
    make_room(kLongestNumber);
    char* start = block_.data() + used_;
    const auto result = std::to_chars(start, start + kLongestNumber, value);
    used_ += static_cast<std::size_t>(result.ptr - start);
  }
  template <class T, bool kSwap>
  void raw(T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    const T ordered = load<T, kSwap>(bytes);
    make_room(sizeof(T));
    std::memcpy(block_.data() + used_, &ordered, sizeof(T));
    used_ += sizeof(T);
  }
  void make_room(std::size_t bytes) {
    if (block_.size() - used_ >= bytes) return;
    flush();
    if (bytes > block_.size()) block_.resize(bytes);
  }
  void flush() {
    if (result_ && used_ != 0) result_ = file_.write({block_.data(), used_});
    used_ = 0;
  }

  AtomicFile& file_;
  std::vector<char> block_;
  std::size_t used_ = 0;
  IoResult<void> result_;
};

/// What each writer is given. The input was checked.
struct WriteContext {
  const WriteInput& input;
  const WriteOptions& options;
  Output& out;
  WriteOutput report;

  [[nodiscard]] bool has_normals() const noexcept { return input.normals.count != 0; }
  /// Tells the caller how far the work is, now and then.
  void progress(std::int64_t done) {
    if (done % kProgressStep == 0 && options.progress) {
      options.progress(done, input.positions.count + input.faces.face_count);
    }
  }

 private:
  static constexpr std::int64_t kProgressStep = 65536;
};

/// The vertex of corner k of face f, whatever the width and the stride of the indices are.
[[nodiscard]] inline std::int64_t vertex_at(const FaceList& faces, std::int64_t f,
                                            std::int64_t k) noexcept {
  const auto* start = static_cast<const char*>(faces.corners);
  const std::size_t width = size_bytes(faces.format);
  const auto at = static_cast<std::size_t>(faces.is_triangles() ? f : faces.offsets[f] + k) *
                      faces.stride_bytes +
                  (faces.is_triangles() ? static_cast<std::size_t>(k) * width : 0);
  switch (faces.format) {
    case IndexFormat::int32:
      return load<std::int32_t, false>(start + at);
    case IndexFormat::uint32:
      return load<std::uint32_t, false>(start + at);
    case IndexFormat::uint16:
      return load<std::uint16_t, false>(start + at);
    case IndexFormat::int64:
      return load<std::int64_t, false>(start + at);
  }
  return kInvalidIndex;
}

void write_obj(WriteContext& context);
void write_off(WriteContext& context);
void write_ply(WriteContext& context);
void write_stl(WriteContext& context);

}  // namespace hedgerow::io
