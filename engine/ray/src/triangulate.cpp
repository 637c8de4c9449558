#include "triangulate.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace hedgerow::ray {
namespace {

// Reflex corners looked at for one polygon before the rest of it becomes a fan: a second or less.
constexpr std::int64_t kMaxWork = 200'000'000;

std::array<double, 3> area_vector(std::span<const Index> vertices, Positions positions) {
  std::array<double, 3> sum{};
  const float* origin = positions[vertices[0]];
  const auto offset = [&](Index v, std::size_t axis) {
    return static_cast<double>(positions[v][axis]) - static_cast<double>(origin[axis]);
  };
  for (std::size_t i = 1; i + 1 < vertices.size(); ++i) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t next = (axis + 1) % 3;
      const std::size_t last = (axis + 2) % 3;
      sum[axis] += offset(vertices[i], next) * offset(vertices[i + 1], last) -
                   offset(vertices[i], last) * offset(vertices[i + 1], next);
    }
  }
  return sum;
}

}  // namespace

void Triangulator::project(std::span<const Index> vertices, Positions positions) {
  const std::array<double, 3> area = area_vector(vertices, positions);
  std::size_t axis = 0;
  for (std::size_t other = 1; other < 3; ++other) {
    if (std::abs(area[other]) > std::abs(area[axis])) axis = other;
  }
  // Dropping the longest axis keeps the shape; the order of the others keeps it counter-clockwise.
  const std::size_t first = area[axis] < 0 ? (axis + 2) % 3 : (axis + 1) % 3;
  const std::size_t second = area[axis] < 0 ? (axis + 1) % 3 : (axis + 2) % 3;
  points_.clear();
  for (const Index v : vertices) points_.push_back({positions[v][first], positions[v][second]});
}

double Triangulator::turn(Index a, Index b, Index c) const noexcept {
  const auto at = [&](Index i) -> const Point& { return points_[static_cast<std::size_t>(i)]; };
  return (at(b)[0] - at(a)[0]) * (at(c)[1] - at(a)[1]) -
         (at(b)[1] - at(a)[1]) * (at(c)[0] - at(a)[0]);
}

bool Triangulator::is_convex() const noexcept {
  const auto count = static_cast<Index>(points_.size());
  int falls = 0;  // times that the walk round turns from rising to falling: once round is once
  const auto rises = [&](Index i) {
    const Point& a = points_[static_cast<std::size_t>(i)];
    const Point& b = points_[static_cast<std::size_t>((i + 1) % count)];
    return b[1] > a[1] || (b[1] == a[1] && b[0] > a[0]);
  };
  for (Index i = 0; i < count; ++i) {
    if (!(turn(i, (i + 1) % count, (i + 2) % count) >= 0)) return false;
    if (rises(i) && !rises((i + 1) % count)) ++falls;
  }
  return falls == 1;
}

bool Triangulator::is_reflex(Index i) const noexcept {
  const auto at = static_cast<std::size_t>(i);
  return !(turn(prev_[at], i, next_[at]) > 0);
}

bool Triangulator::is_ear(Index i, std::int64_t& work) const noexcept {
  if (is_reflex(i)) return false;
  const Index before = prev_[static_cast<std::size_t>(i)];
  const Index behind = next_[static_cast<std::size_t>(i)];
  for (const Index j : reflex_) {
    if (j == before || j == i || j == behind || next_[static_cast<std::size_t>(j)] < 0) continue;
    ++work;
    if (turn(before, i, j) >= 0 && turn(i, behind, j) >= 0 && turn(behind, before, j) >= 0) {
      return false;
    }
  }
  return true;
}

void Triangulator::fan(Index first) {
  Index b = next_[static_cast<std::size_t>(first)];
  for (Index c = next_[static_cast<std::size_t>(b)]; c != first;
       b = c, c = next_[static_cast<std::size_t>(c)]) {
    triangles_.push_back({first, b, c});
  }
}

void Triangulator::clip_ears() {
  const auto count = static_cast<Index>(points_.size());
  reflex_.clear();
  for (Index i = 0; i < count; ++i) {
    if (is_reflex(i)) reflex_.push_back(i);
  }
  std::int64_t work = 0;
  Index left = count;
  Index i = 0;
  Index misses = 0;
  while (left > 3 && misses < left && work < kMaxWork) {
    const Index before = prev_[static_cast<std::size_t>(i)];
    const Index behind = next_[static_cast<std::size_t>(i)];
    if (!is_ear(i, work)) {
      ++misses;
      i = behind;
      continue;
    }
    triangles_.push_back({before, i, behind});
    next_[static_cast<std::size_t>(before)] = behind;
    prev_[static_cast<std::size_t>(behind)] = before;
    next_[static_cast<std::size_t>(i)] = kInvalidIndex;
    --left;
    misses = 0;
    i = next_[static_cast<std::size_t>(behind)];  // every other corner: no slivers round one
  }
  fan(i);
}

std::span<const std::array<Index, 3>> Triangulator::cut(std::span<const Index> vertices,
                                                        Positions positions) {
  triangles_.clear();
  project(vertices, positions);
  const auto count = static_cast<Index>(vertices.size());
  next_.resize(vertices.size());
  prev_.resize(vertices.size());
  for (Index i = 0; i < count; ++i) {
    next_[static_cast<std::size_t>(i)] = (i + 1) % count;
    prev_[static_cast<std::size_t>(i)] = (i + count - 1) % count;
  }
  if (count == 3 || is_convex()) {
    fan(0);
  } else {
    clip_ears();
  }
  return triangles_;
}

}  // namespace hedgerow::ray
