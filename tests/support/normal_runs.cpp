#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "support/normal_meshes.h"

namespace hedgerow::test {

namespace {

using Vector = std::array<double, 3>;

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Vector times(const Vector& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }
Vector plus(const Vector& a, const Vector& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
double inner(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
double length(const Vector& a) { return std::sqrt(inner(a, a)); }
Vector outer(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector unit_of(const Vector& a) { return length(a) > 0 ? times(a, 1 / length(a)) : Vector{}; }

Index corner(const FaceList& faces, Index c) { return static_cast<const Index*>(faces.corners)[c]; }

std::vector<Vector> points_of(const FaceList& faces, Index f, Positions positions) {
  const IndexRange range = faces.corner_range(f);
  std::vector<Vector> points;
  for (Index c = range.begin; c < range.end; ++c) {
    const float* p = positions[corner(faces, c)];
    points.push_back({p[0], p[1], p[2]});
  }
  return points;
}

Vector area_vector(const std::vector<Vector>& p, PolygonMethod method) {
  Vector sum{};
  const std::size_t n = p.size();
  for (std::size_t k = 0; k < n; ++k) {
    const Vector& before = p[(k + n - 1) % n];
    const Vector& after = p[(k + 1) % n];
    sum = plus(sum, method == PolygonMethod::newell || n == 3
                        ? outer(minus(p[k], p[0]), minus(after, p[0]))
                        : times(outer(minus(after, p[k]), minus(before, p[k])),
                                1 / static_cast<double>(n)));
  }
  return sum;
}

Vector corner_vector(const std::vector<Vector>& p, std::size_t k, const Vector& area,
                     NormalWeight weight) {
  const std::size_t n = p.size();
  const Vector a = minus(p[(k + 1) % n], p[k]);
  const Vector b = minus(p[(k + n - 1) % n], p[k]);
  const Vector c = outer(a, b);
  switch (weight) {
    case NormalWeight::area:
      return area;
    case NormalWeight::uniform:
      return unit_of(area);
    case NormalWeight::max: {
      const double squares = inner(a, a) * inner(b, b);
      return squares > 0 ? times(c, 1 / squares) : Vector{};
    }
    default: {
      const double angle = std::atan2(length(c), inner(a, b));
      const bool is_reflex = n > 3 && inner(c, area) < 0;
      return times(unit_of(area), is_reflex ? 2 * 3.141592653589793 - angle : angle);
    }
  }
}

void run_backwards(void*, Index count, Index grain, void (*body)(void*, Index, Index), void* user) {
  for (Index end = count; end > 0;) {
    const Index begin = std::max<Index>(0, end - grain);
    body(user, begin, end);
    end = begin;
  }
}

}  // namespace

std::vector<double> oracle(const FaceList& faces, Positions positions,
                           const NormalOptions& options) {
  std::vector<Vector> sums(static_cast<std::size_t>(faces.vertex_count));
  for (Index f = 0; f < faces.face_count; ++f) {
    const std::vector<Vector> points = points_of(faces, f, positions);
    const Vector area = area_vector(points, options.polygon);
    const Index begin = faces.corner_range(f).begin;
    for (std::size_t k = 0; k < points.size(); ++k) {
      Vector& sum = sums[static_cast<std::size_t>(corner(faces, begin + static_cast<Index>(k)))];
      sum = plus(sum, corner_vector(points, k, area, options.weight));
    }
  }
  std::vector<double> normals;
  for (const Vector& sum : sums) {
    const Vector unit = unit_of(sum);
    normals.insert(normals.end(), unit.begin(), unit.end());
  }
  return normals;
}

std::vector<float> floats(const Answer& answer) {
  std::vector<float> values;
  for (const std::uint32_t bits : answer.bits) values.push_back(std::bit_cast<float>(bits));
  return values;
}

double worst_angle(const Answer& answer, const std::vector<double>& expected) {
  const std::vector<float> got = floats(answer);
  double worst = 0;
  for (std::size_t i = 0; i < got.size(); i += 3) {
    const Vector a = {got[i], got[i + 1], got[i + 2]};
    const Vector b = {expected[i], expected[i + 1], expected[i + 2]};
    if (length(b) == 0) continue;
    const double angle = std::atan2(length(outer(a, b)), inner(a, b));
    worst = std::isfinite(angle) && length(a) > 0 ? std::max(worst, angle) : 4;
  }
  return worst;
}

Answer run(Method method, const Connectivity& mesh, const FaceList& faces, Positions positions,
           const NormalOptions& options, const Execution& execution, std::size_t stride_bytes) {
  const std::size_t floats_each = stride_bytes / sizeof(float);
  const auto point_count = static_cast<std::size_t>(positions.count);
  std::vector<float> points(point_count * floats_each, 7.0f);
  for (std::size_t i = 0; i < point_count; ++i) {
    std::copy_n(positions[static_cast<Index>(i)], 3, points.data() + i * floats_each);
  }
  const std::int64_t count = method == Method::face ? faces.face_count : faces.vertex_count;
  std::vector<float> out(static_cast<std::size_t>(count) * floats_each, -9.0f);
  const Positions in{points.data(), positions.count, stride_bytes};
  const NormalsOut to{out.data(), count, stride_bytes};
  Workspace workspace;
  const auto result = method == Method::face ? face_normals(faces, in, to, options, execution)
                      : method == Method::gather
                          ? gather_vertex_normals(mesh, in, to, options, execution, workspace)
                          : scatter_vertex_normals(faces, in, to, options, execution, workspace);
  Answer answer;
  if (!result) {
    ADD_FAILURE() << name(result.error().code);
    return answer;
  }
  answer.stats = *result;
  for (std::size_t i = 0; i < out.size(); ++i) {
    if (i % floats_each < 3) {
      answer.bits.push_back(std::bit_cast<std::uint32_t>(out[i]));
    } else {
      EXPECT_EQ(out[i], -9.0f) << "written between the outputs";
    }
  }
  return answer;
}

struct Executions::Threads {
  tbb::global_control limit{tbb::global_control::max_allowed_parallelism, 16};
  tbb::task_arena arenas[5] = {tbb::task_arena(1), tbb::task_arena(2), tbb::task_arena(3),
                               tbb::task_arena(8), tbb::task_arena(16)};
};

Executions::Executions() : threads_(std::make_unique<Threads>()) {
  for (const Index grain : {0, 1, 7, 1000}) {
    all_.push_back(Execution::serial().with_grain(grain));
    all_.push_back(Execution::current_arena().with_grain(grain));
    for (auto& arena : threads_->arenas) {
      arena.initialize();
      all_.push_back(Execution::in(arena).with_grain(grain));
    }
    all_.push_back(Execution::callback(run_backwards, nullptr, 5).with_grain(grain));
  }
}
Executions::~Executions() = default;

}  // namespace hedgerow::test
