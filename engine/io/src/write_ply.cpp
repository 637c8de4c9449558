#include "output.h"

namespace hedgerow::io {

namespace {

constexpr std::int64_t kLargestByteCount = 255;

bool has_large_face(const FaceList& faces) noexcept {
  if (faces.is_triangles()) return false;
  for (std::int64_t f = 0; f < faces.face_count; ++f) {
    if (faces.corner_range(f).size() > kLargestByteCount) return true;
  }
  return false;
}

struct AsciiValues {
  Output& out;
  bool is_first = true;

  void separate() {
    if (!is_first) out.character(' ');
    is_first = false;
  }
  void real(float value) {
    separate();
    out.number(value);
  }
  void small(std::int64_t value) { index(value); }
  void index(std::int64_t value) {
    separate();
    out.number(value);
  }
  void end_record() {
    out.character('\n');
    is_first = true;
  }
};

template <bool kIsBig>
struct BinaryValues {
  Output& out;

  template <class T>
  void put(T value) {
    if constexpr (kIsBig) {
      out.big_endian(value);
    } else {
      out.little_endian(value);
    }
  }
  void real(float value) { put(value); }
  void small(std::int64_t value) { put(static_cast<std::uint8_t>(value)); }
  void index(std::int64_t value) { put(static_cast<std::int32_t>(value)); }
  void end_record() {}
};

void write_header(WriteContext& context, bool has_large) {
  Output& out = context.out;
  constexpr std::string_view kFormats[] = {"binary_little_endian", "binary_big_endian", "ascii"};
  out.text("ply\nformat ");
  out.text(kFormats[static_cast<std::size_t>(context.options.ply)]);
  out.text(" 1.0\nelement vertex ");
  out.number(context.input.positions.count);
  out.text("\nproperty float x\nproperty float y\nproperty float z\n");
  if (context.has_normals()) {
    out.text("property float nx\nproperty float ny\nproperty float nz\n");
  }
  out.text("element face ");
  out.number(context.input.faces.face_count);
  out.text(has_large ? "\nproperty list int int vertex_indices\n"
                     : "\nproperty list uchar int vertex_indices\n");
  out.text("end_header\n");
}

template <class Values>
void write_body(WriteContext& context, Values values, bool has_large) {
  const WriteInput& input = context.input;
  for (std::int64_t v = 0; v < input.positions.count; ++v) {
    context.progress(v);
    const float* xyz = input.positions[static_cast<Index>(v)];
    for (int axis = 0; axis < 3; ++axis) values.real(xyz[axis]);
    if (context.has_normals()) {
      const float* normal = input.normals[static_cast<Index>(v)];
      for (int axis = 0; axis < 3; ++axis) values.real(normal[axis]);
    }
    values.end_record();
  }
  for (std::int64_t f = 0; f < input.faces.face_count; ++f) {
    context.progress(input.positions.count + f);
    const std::int64_t degree = input.faces.corner_range(f).size();
    if (has_large) {
      values.index(degree);
    } else {
      values.small(degree);
    }
    for (std::int64_t k = 0; k < degree; ++k) values.index(vertex_at(input.faces, f, k));
    values.end_record();
  }
}

}  // namespace

void write_ply(WriteContext& context) {
  const bool has_large = has_large_face(context.input.faces);
  write_header(context, has_large);
  switch (context.options.ply) {
    case PlyEncoding::ascii:
      return write_body(context, AsciiValues{context.out}, has_large);
    case PlyEncoding::binary_little_endian:
      return write_body(context, BinaryValues<false>{context.out}, has_large);
    case PlyEncoding::binary_big_endian:
      return write_body(context, BinaryValues<true>{context.out}, has_large);
  }
}

}  // namespace hedgerow::io
