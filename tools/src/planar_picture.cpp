#include "planar_picture.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include <fmt/format.h>

namespace hedgerow::tool {
namespace {

constexpr double kSize = 1000;  // of the longer side, in units of the picture
constexpr double kEdge = 20;    // empty all round

/// From the plane to the picture.
class Frame {
 public:
  Frame(std::span<const Point2> vertices, std::span<const Point2> dots) {
    bool is_first = true;
    for (const std::span<const Point2> points : {vertices, dots}) {
      for (const Point2& p : points) {
        for (std::size_t axis = 0; axis < 2; ++axis) {
          low_[axis] = is_first ? p[axis] : std::min(low_[axis], p[axis]);
          high_[axis] = is_first ? p[axis] : std::max(high_[axis], p[axis]);
        }
        is_first = false;
      }
    }
    const double length = std::max(high_[0] - low_[0], high_[1] - low_[1]);
    scale_ = length > 0 ? kSize / length : 1;
  }
  [[nodiscard]] double width() const noexcept { return 2 * kEdge + extent(0); }
  [[nodiscard]] double height() const noexcept { return 2 * kEdge + extent(1); }
  [[nodiscard]] double x(const Point2& p) const noexcept {
    return kEdge + (p[0] - low_[0]) * scale_;
  }
  [[nodiscard]] double y(const Point2& p) const noexcept {
    return kEdge + (high_[1] - p[1]) * scale_;
  }

 private:
  [[nodiscard]] double extent(std::size_t axis) const noexcept {
    return (high_[axis] - low_[axis]) * scale_;
  }

  Point2 low_{};
  Point2 high_{};
  double scale_ = 1;
};

template <class Mesh>
std::string edge_path(const Mesh& mesh, std::span<const Point2> vertices, const Frame& frame,
                      bool is_boundary) {
  std::string path;
  for (HalfedgeId h(0); h.value < mesh.halfedge_count(); ++h.value) {
    const HalfedgeId o = mesh.opposite[h];
    if (o.valid() == is_boundary || (o.valid() && o < h)) continue;
    const Point2& a = vertices[static_cast<std::size_t>(mesh.origin[h].value)];
    const Point2& b = vertices[static_cast<std::size_t>(mesh.target(h).value)];
    fmt::format_to(std::back_inserter(path), "M{:.6g} {:.6g}L{:.6g} {:.6g}\n", frame.x(a),
                   frame.y(a), frame.x(b), frame.y(b));
  }
  return path;
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else {
      // Other bytes might be no UTF-8, or a control character, which XML does not allow.
      out += c >= ' ' && c <= '~' ? c : '?';
    }
  }
  return out;
}

}  // namespace

std::string planar_svg(const Connectivity& mesh, std::span<const Point2> vertices,
                       std::span<const Point2> dots, const std::string& title) {
  const Frame frame(vertices, dots);
  // Dots that do not run together.
  const double radius =
      std::clamp(0.15 * kSize / std::sqrt(static_cast<double>(dots.size()) + 1), 0.2, 4.0);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.6g} {:.6g}\" width=\"{:.6g}\" "
      "height=\"{:.6g}\">\n<title>{}</title>\n<rect width=\"100%\" height=\"100%\" "
      "fill=\"white\"/>\n",
      frame.width(), frame.height(), frame.width(), frame.height(), escaped(title));
  mesh.visit([&](const auto& view) {
    for (const bool is_boundary : {false, true}) {
      svg += fmt::format(
          "<path class=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:.3g}\" "
          "stroke-linecap=\"round\" d=\"\n{}\"/>\n",
          is_boundary ? "boundary" : "edges", is_boundary ? "#222222" : "#3a6ea5",
          (is_boundary ? 0.6 : 0.35) * radius, edge_path(view, vertices, frame, is_boundary));
    }
  });
  svg += fmt::format("<g fill=\"#c0392b\">\n");
  for (const Point2& p : dots) {
    fmt::format_to(std::back_inserter(svg), "<circle cx=\"{:.6g}\" cy=\"{:.6g}\" r=\"{:.3g}\"/>\n",
                   frame.x(p), frame.y(p), radius);
  }
  svg += "</g>\n</svg>\n";
  return svg;
}

}  // namespace hedgerow::tool
