#include <array>
#include <cmath>

#include "output.h"

namespace hedgerow::io {

namespace {

using Triangle = std::array<const float*, 3>;

// In double, so that small triangles far from the origin keep a direction.
std::array<float, 3> normal_of(const Triangle& triangle) noexcept {
  double u[3];
  double w[3];
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto origin = static_cast<double>(triangle[0][axis]);
    u[axis] = static_cast<double>(triangle[1][axis]) - origin;
    w[axis] = static_cast<double>(triangle[2][axis]) - origin;
  }
  const double n[3] = {u[1] * w[2] - u[2] * w[1], u[2] * w[0] - u[0] * w[2],
                       u[0] * w[1] - u[1] * w[0]};
  const double length = std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
  if (!(length > 0) || !std::isfinite(length)) return {0, 0, 0};
  return {static_cast<float>(n[0] / length), static_cast<float>(n[1] / length),
          static_cast<float>(n[2] / length)};
}

void write_ascii(Output& out, const Triangle& triangle) {
  const auto point = [&out](const float* xyz) {
    for (int axis = 0; axis < 3; ++axis) {
      out.character(' ');
      out.number(xyz[axis]);
    }
    out.character('\n');
  };
  out.text("  facet normal");
  point(normal_of(triangle).data());
  out.text("    outer loop\n");
  for (const float* xyz : triangle) {
    out.text("      vertex");
    point(xyz);
  }
  out.text("    endloop\n  endfacet\n");
}

void write_binary(Output& out, const Triangle& triangle) {
  for (const float value : normal_of(triangle)) out.little_endian(value);
  for (const float* xyz : triangle) {
    for (int axis = 0; axis < 3; ++axis) out.little_endian(xyz[axis]);
  }
  out.little_endian(std::uint16_t{0});
}

}  // namespace

void write_stl(WriteContext& context) {
  const WriteInput& input = context.input;
  Output& out = context.out;
  const bool is_ascii = context.options.stl == StlEncoding::ascii;
  std::int64_t triangle_count = 0;
  for (std::int64_t f = 0; f < input.faces.face_count; ++f) {
    const std::int64_t degree = input.faces.corner_range(f).size();
    triangle_count += std::max<std::int64_t>(degree - 2, 0);
    context.report.split_face_count += degree > 3 ? 1 : 0;
    context.report.dropped_face_count += degree < 3 ? 1 : 0;
  }
  if (is_ascii) {
    out.text("solid hedgerow\n");
  } else {
    // Readers that look only at the first word must not take it for text.
    constexpr std::string_view kName = "binary STL written by hedgerow";
    out.text(kName);
    for (std::size_t i = kName.size(); i < 80; ++i) out.character('\0');
    out.little_endian(static_cast<std::uint32_t>(triangle_count));
  }
  for (std::int64_t f = 0; f < input.faces.face_count; ++f) {
    context.progress(input.positions.count + f);
    const std::int64_t degree = input.faces.corner_range(f).size();
    const auto point = [&](std::int64_t k) {
      return input.positions[static_cast<Index>(vertex_at(input.faces, f, k))];
    };
    for (std::int64_t k = 2; k < degree; ++k) {
      const Triangle triangle = {point(0), point(k - 1), point(k)};
      is_ascii ? write_ascii(out, triangle) : write_binary(out, triangle);
    }
  }
  if (is_ascii) out.text("endsolid hedgerow\n");
}

}  // namespace hedgerow::io
