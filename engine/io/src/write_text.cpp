#include "output.h"

namespace hedgerow::io {

namespace {

void write_point(Output& out, const float* xyz) {
  out.number(xyz[0]);
  out.character(' ');
  out.number(xyz[1]);
  out.character(' ');
  out.number(xyz[2]);
}

}  // namespace

void write_obj(WriteContext& context) {
  const WriteInput& input = context.input;
  Output& out = context.out;
  for (std::int64_t v = 0; v < input.positions.count; ++v) {
    context.progress(v);
    out.text("v ");
    write_point(out, input.positions[static_cast<Index>(v)]);
    out.character('\n');
  }
  for (std::int64_t v = 0; v < input.normals.count; ++v) {
    out.text("vn ");
    write_point(out, input.normals[static_cast<Index>(v)]);
    out.character('\n');
  }
  for (std::int64_t f = 0; f < input.faces.face_count; ++f) {
    context.progress(input.positions.count + f);
    out.character('f');
    const std::int64_t degree = input.faces.corner_range(f).size();
    for (std::int64_t k = 0; k < degree; ++k) {
      const std::int64_t number = vertex_at(input.faces, f, k) + 1;
      out.character(' ');
      out.number(number);
      if (context.has_normals()) {
        out.text("//");
        out.number(number);
      }
    }
    out.character('\n');
  }
}

void write_off(WriteContext& context) {
  const WriteInput& input = context.input;
  Output& out = context.out;
  out.text(context.has_normals() ? "NOFF\n" : "OFF\n");
  out.number(input.positions.count);
  out.character(' ');
  out.number(input.faces.face_count);
  out.text(" 0\n");
  for (std::int64_t v = 0; v < input.positions.count; ++v) {
    context.progress(v);
    write_point(out, input.positions[static_cast<Index>(v)]);
    if (context.has_normals()) {
      out.character(' ');
      write_point(out, input.normals[static_cast<Index>(v)]);
    }
    out.character('\n');
  }
  for (std::int64_t f = 0; f < input.faces.face_count; ++f) {
    context.progress(input.positions.count + f);
    const std::int64_t degree = input.faces.corner_range(f).size();
    out.number(degree);
    for (std::int64_t k = 0; k < degree; ++k) {
      out.character(' ');
      out.number(vertex_at(input.faces, f, k));
    }
    out.character('\n');
  }
}

}  // namespace hedgerow::io
