#include "planar_picture.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

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

struct EdgeStyle {
  const char* name;
  const char* colour;
  double width;  // in radii of a dot
};
constexpr EdgeStyle kStyles[] = {
    {"edges", "#3a6ea5", 0.35}, {"constrained", "#d07000", 0.8}, {"boundary", "#222222", 0.6}};

// The place of an edge's style, by half-edge.
std::vector<unsigned char> find_styles(const PlanarDrawing& drawing) {
  std::vector<unsigned char> styles(drawing.mesh.opposite().size(), 0);
  for (std::size_t h = 0; h < styles.size(); ++h) {
    if (drawing.mesh.opposite()[h] == kInvalidIndex) styles[h] = 2;
  }
  for (const Index h : drawing.constrained) styles[static_cast<std::size_t>(h)] = 1;
  return styles;
}

template <class Mesh>
std::string edge_path(const Mesh& mesh, std::span<const Point2> vertices, const Frame& frame,
                      const std::vector<unsigned char>& styles, unsigned style) {
  std::string path;
  for (HalfedgeId h(0); h.value < mesh.halfedge_count(); ++h.value) {
    const HalfedgeId o = mesh.opposite[h];
    if (styles[static_cast<std::size_t>(h.value)] != style || (o.valid() && o < h)) continue;
    const Point2& a = vertices[static_cast<std::size_t>(mesh.origin[h].value)];
    const Point2& b = vertices[static_cast<std::size_t>(mesh.target(h).value)];
    fmt::format_to(std::back_inserter(path), "M{:.6g} {:.6g}L{:.6g} {:.6g}\n", frame.x(a),
                   frame.y(a), frame.x(b), frame.y(b));
  }
  return path;
}

}  // namespace

std::string planar_svg(const PlanarDrawing& drawing) {
  const Frame frame(drawing.vertices, drawing.dots);
  // Dots that do not run together.
  const double radius =
      std::clamp(0.15 * kSize / std::sqrt(static_cast<double>(drawing.dots.size()) + 1), 0.2, 4.0);
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.6g} {:.6g}\" width=\"{:.6g}\" "
      "height=\"{:.6g}\">\n<title>{}</title>\n<rect width=\"100%\" height=\"100%\" "
      "fill=\"white\"/>\n",
      frame.width(), frame.height(), frame.width(), frame.height(), drawing.title);
  const std::vector<unsigned char> styles = find_styles(drawing);
  drawing.mesh.visit([&](const auto& mesh) {
    for (unsigned style = 0; style < std::size(kStyles); ++style) {
      svg += fmt::format(
          "<path class=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"{:.3g}\" "
          "stroke-linecap=\"round\" d=\"\n{}\"/>\n",
          kStyles[style].name, kStyles[style].colour, kStyles[style].width * radius,
          edge_path(mesh, drawing.vertices, frame, styles, style));
    }
  });
  svg += "<g fill=\"#c0392b\">\n";
  for (const Point2& p : drawing.dots) {
    fmt::format_to(std::back_inserter(svg), "<circle cx=\"{:.6g}\" cy=\"{:.6g}\" r=\"{:.3g}\"/>\n",
                   frame.x(p), frame.y(p), radius);
  }
  svg += "</g>\n</svg>\n";
  return svg;
}

}  // namespace hedgerow::tool
