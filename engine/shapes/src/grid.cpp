#include "counts.h"
#include "hedgerow/shapes.h"
#include "turns.h"

namespace hedgerow::shapes {

namespace {

Result<void> check_sides(std::int64_t columns, std::int64_t rows) {
  return at_least(1, columns).and_then([&] { return at_least(1, rows); });
}

// One wave is 128 squares long, so that neighbouring normals differ but no face is steep.
void fill_waves(std::int64_t columns, std::int64_t rows, Soup& soup) {
  PointWriter points(soup);
  for (std::int64_t y = 0; y <= rows; ++y) {
    const double across = cosine_of_turns(static_cast<double>(y) / 192);
    for (std::int64_t x = 0; x <= columns; ++x) {
      points.add(static_cast<double>(x), static_cast<double>(y),
                 4 * across * sine_of_turns(static_cast<double>(x) / 128));
    }
  }
}

// The product that cannot overflow once `columns` and `rows` are known to be far below 2^63.
std::int64_t points_of(std::int64_t columns, std::int64_t rows) {
  return columns > kMaxCount || rows > kMaxCount ? saturating_product(columns, rows)
                                                 : saturating_product(columns + 1, rows + 1);
}

}  // namespace

Result<Soup> grid(std::int64_t columns, std::int64_t rows) {
  if (auto ok = check_sides(columns, rows); !ok) return fail(ok.error());
  const std::int64_t squares = saturating_product(columns, rows);
  Result<Soup> soup = make_triangles(points_of(columns, rows), saturating_product(squares, 2));
  if (!soup) return soup;
  fill_waves(columns, rows, *soup);
  TriangleWriter triangles(*soup);
  for (std::int64_t y = 0; y < rows; ++y) {
    for (std::int64_t x = 0; x < columns; ++x) {
      const std::int64_t v = y * (columns + 1) + x;
      triangles.add_square(v, v + 1, v + columns + 2, v + columns + 1);
    }
  }
  return soup;
}

Result<Soup> quad_grid(std::int64_t columns, std::int64_t rows) {
  if (auto ok = check_sides(columns, rows); !ok) return fail(ok.error());
  const std::int64_t squares = saturating_product(columns, rows);
  Result<Soup> soup = make_soup(points_of(columns, rows), squares, 4, true);
  if (!soup) return soup;
  fill_waves(columns, rows, *soup);
  Index* corner = soup->corners.data();
  Index* offset = soup->offsets.data();
  *offset = 0;
  for (std::int64_t y = 0; y < rows; ++y) {
    for (std::int64_t x = 0; x < columns; ++x) {
      const std::int64_t v = y * (columns + 1) + x;
      for (const std::int64_t i : {v, v + 1, v + columns + 2, v + columns + 1}) {
        *corner++ = static_cast<Index>(i);
      }
      offset[1] = offset[0] + 4;
      ++offset;
    }
  }
  return soup;
}

}  // namespace hedgerow::shapes
