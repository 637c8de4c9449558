// Bands of squares whose ends are glued: straight, or with one side turned over.

#include "counts.h"
#include "hedgerow/shapes.h"
#include "turns.h"

namespace hedgerow::shapes {

namespace {

struct Band {
  std::int64_t around;
  std::int64_t across;
  std::int64_t lines;  ///< vertices of one ring across: `across`, or one more if the sides are free
  bool is_turned;      ///< the last column joins the first one upside down

  [[nodiscard]] std::int64_t vertex(std::int64_t x, std::int64_t y) const {
    if (x == around) {
      x = 0;
      if (is_turned) y = (lines - 1 - y % lines) % lines;
    }
    return x * lines + y % lines;
  }
};

Result<Soup> make_band(const Band& band, std::int64_t smallest_across) {
  if (auto ok = at_least(3, band.around); !ok) return fail(ok.error());
  if (auto ok = at_least(smallest_across, band.across); !ok) return fail(ok.error());
  const std::int64_t squares = saturating_product(band.around, band.across);
  Result<Soup> soup =
      make_triangles(saturating_product(band.around, band.lines), saturating_product(squares, 2));
  if (!soup) return soup;
  TriangleWriter triangles(*soup);
  for (std::int64_t x = 0; x < band.around; ++x) {
    for (std::int64_t y = 0; y < band.across; ++y) {
      triangles.add_square(band.vertex(x, y), band.vertex(x + 1, y), band.vertex(x + 1, y + 1),
                           band.vertex(x, y + 1));
    }
  }
  return soup;
}

// Calls point(u, y) for every vertex in order, u being turns round the ring.
template <class Point>
void fill_points(const Band& band, Soup& soup, const Point& point) {
  PointWriter points(soup);
  for (std::int64_t x = 0; x < band.around; ++x) {
    const double u = static_cast<double>(x) / static_cast<double>(band.around);
    const double cosine = cosine_of_turns(u);
    const double sine = sine_of_turns(u);
    for (std::int64_t y = 0; y < band.lines; ++y) {
      const auto [radius, height] = point(u, static_cast<double>(y));
      points.add(radius * cosine, radius * sine, height);
    }
  }
}

struct RingPoint {
  double radius;
  double height;
};

}  // namespace

Result<Soup> torus(std::int64_t around, std::int64_t across) {
  const Band band{around, across, across, false};
  Result<Soup> soup = make_band(band, 3);
  if (!soup) return soup;
  fill_points(band, *soup, [&](double, double y) {
    const double v = y / static_cast<double>(across);
    return RingPoint{1 + 0.4 * cosine_of_turns(v), 0.4 * sine_of_turns(v)};
  });
  return soup;
}

Result<Soup> mobius(std::int64_t around, std::int64_t across) {
  const Band band{around, across, across < kMaxCount ? across + 1 : across, true};
  Result<Soup> soup = make_band(band, 1);
  if (!soup) return soup;
  fill_points(band, *soup, [&](double u, double y) {
    const double s = 0.8 * (y / static_cast<double>(across) - 0.5);
    return RingPoint{1 + s * cosine_of_turns(u / 2), s * sine_of_turns(u / 2)};
  });
  return soup;
}

// Half a step away from v = 0, where the surface crosses itself, no two vertices meet.
Result<Soup> klein(std::int64_t around, std::int64_t across) {
  const Band band{around, across, across, true};
  Result<Soup> soup = make_band(band, 3);
  if (!soup) return soup;
  fill_points(band, *soup, [&](double u, double y) {
    const double v = (y + 0.5) / static_cast<double>(across);
    const double cosine = 0.5 * cosine_of_turns(u / 2);
    const double sine = 0.5 * sine_of_turns(u / 2);
    const double once = sine_of_turns(v);
    const double twice = sine_of_turns(2 * v);
    return RingPoint{1.2 + cosine * once - sine * twice, sine * once + cosine * twice};
  });
  return soup;
}

}  // namespace hedgerow::shapes
