#include "counts.h"
#include "hedgerow/shapes.h"
#include "turns.h"

namespace hedgerow::shapes {

Result<Soup> fan(std::int64_t triangles, FanEnds ends) {
  const bool is_closed = ends == FanEnds::closed;
  if (auto ok = at_least(is_closed ? 3 : 1, triangles); !ok) return fail(ok.error());
  const std::int64_t rim = is_closed || triangles > kMaxCount ? triangles : triangles + 1;
  Result<Soup> soup = make_triangles(rim > kMaxCount ? rim : rim + 1, triangles);
  if (!soup) return soup;
  PointWriter points(*soup);
  points.add(0, 0, 1);
  const double turn = (is_closed ? 1.0 : 0.75) / static_cast<double>(triangles);
  for (std::int64_t i = 0; i < rim; ++i) {
    const double t = turn * static_cast<double>(i);
    points.add(cosine_of_turns(t), sine_of_turns(t), 0);
  }
  TriangleWriter out(*soup);
  for (std::int64_t i = 0; i < triangles; ++i) {
    out.add(0, i + 1, i + 1 < rim ? i + 2 : 1);
  }
  return soup;
}

Result<Soup> strip(std::int64_t triangles) {
  if (auto ok = at_least(1, triangles); !ok) return fail(ok.error());
  const std::int64_t vertices = triangles > kMaxCount ? triangles : triangles + 2;
  Result<Soup> soup = make_triangles(vertices, triangles);
  if (!soup) return soup;
  PointWriter points(*soup);
  for (std::int64_t i = 0; i < vertices; ++i) {
    const double x = 0.5 * static_cast<double>(i);
    points.add(x, i % 2 == 0 ? 0 : 1, 2 * sine_of_turns(x / 64));
  }
  TriangleWriter out(*soup);
  for (std::int64_t i = 0; i < triangles; ++i) {
    // Every second triangle of a zigzag lies the other way round.
    if (i % 2 == 0) out.add(i, i + 2, i + 1);
    if (i % 2 == 1) out.add(i, i + 1, i + 2);
  }
  return soup;
}

}  // namespace hedgerow::shapes
