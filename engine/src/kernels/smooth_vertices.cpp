#include "kernels/smooth_vertices.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <type_traits>

#include "hedgerow/circulate.h"
#include "hedgerow/query.h"
#include "kernels/simd_path.h"

namespace hedgerow::kernels {

namespace {

// The cotangent of the angle at `p` between the ways to `a` and `b`; nothing of a negative one,
// nor where there is no angle.
double cotangent(Vec3<double> p, Vec3<double> a, Vec3<double> b) noexcept {
  const Vec3<double> u = a - p;
  const Vec3<double> v = b - p;
  const Vec3<double> c = cross(u, v);
  const double sine = std::sqrt(dot(c, c));
  const double cosine = dot(u, v);
  return sine > 0 && cosine > 0 ? cosine / sine : 0;
}

// The cotangent weight of the half-edge that leaves the vertex to be moved.
template <class Mesh>
double weight_of(const Mesh& mesh, const SmoothStep& step, HalfedgeId h) noexcept {
  const HalfedgeId o = mesh.opposite[h];
  const Vec3<double> here = step[mesh.origin[h]];
  const Vec3<double> there = step[mesh.target(h)];
  return cotangent(step[mesh.origin[mesh.prev(h)]], here, there) +
         cotangent(step[mesh.origin[mesh.prev(o)]], here, there);
}

template <class Mesh>
bool is_movable(const Mesh& mesh, VertexId v) noexcept {
  return mesh.outgoing[v].valid() && !is_boundary(mesh, v) && extra_fans(mesh.fans, v).empty();
}

bool write_finite(Float3 place, float* to) noexcept {
  if (!std::isfinite(place.x) || !std::isfinite(place.y) || !std::isfinite(place.z)) return false;
  to[0] = place.x;
  to[1] = place.y;
  to[2] = place.z;
  return true;
}

Float3 load(const float* p) noexcept { return {p[0], p[1], p[2]}; }

// Sums in double. A vertex without neighbours stays: 0 / 0 is not finite.
template <SmoothWeights W, class Mesh>
bool move_in_double(const Mesh& mesh, const SmoothStep& step, VertexId v) noexcept {
  Vec3<double> sum{0, 0, 0};
  double weights = 0;
  for (const HalfedgeId h : outgoing_halfedges(mesh, v)) {
    const double weight = W == SmoothWeights::umbrella ? 1 : weight_of(mesh, step, h);
    sum = sum + step[mesh.target(h)] * weight;
    weights += weight;
  }
  const Vec3<double> way = sum * (1 / weights) - step[v];
  const Vec3<double> place = step[v] + way * static_cast<double>(step.step);
  return write_finite(
      {static_cast<float>(place.x), static_cast<float>(place.y), static_cast<float>(place.z)},
      step.to[v.value]);
}

// \pre v lies within one closed fan
template <class Mesh>
bool move_in_float(const Mesh& mesh, const SmoothStep& step, VertexId v) noexcept {
  const HalfedgeId start = mesh.outgoing[v];
  const VertexId newest(v.value - 1);
  const VertexId last = mesh.origin[mesh.prev(start)];
  Float3 sum{0, 0, 0};
  Index valence = 0;
  bool is_newest_behind = false;
  HalfedgeId h = start;
  do {
    // The neighbour is where the walk goes on from, so to find it costs nothing more.
    const HalfedgeId o = mesh.opposite[h];
    VertexId u = mesh.origin[o];
    h = mesh.next(o);
    if (u == newest) {
      is_newest_behind = true;
      u = last;
    } else if (h == start && is_newest_behind) {
      u = newest;
    }
    const Float3 p = load(step.from[u.value]);
    sum = valence == 0 ? p : sum + p;
    ++valence;
  } while (h != start);
  const Float3 place =
      sum * umbrella_share(step, valence) + load(step.from[v.value]) * (1 - step.step);
  return write_finite(place, step.to[v.value]);
}

template <SmoothWeights W, class Mesh>
void smooth_one(const Mesh& mesh, const SmoothStep& step, VertexId v) noexcept {
  if (is_movable(mesh, v)) {
    if (W == SmoothWeights::umbrella && move_in_float(mesh, step, v)) return;
    if (move_in_double<W>(mesh, step, v)) return;
  }
  const Float3 here = load(step.from[v.value]);
  float* to = step.to[v.value];
  to[0] = here.x;
  to[1] = here.y;
  to[2] = here.z;
}

template <SmoothWeights W, class Mesh>
void smooth_each(IndexRange range, const Mesh& mesh, const SmoothStep& step) noexcept {
  for (VertexId v(range.begin); v.value < range.end; ++v.value) smooth_one<W>(mesh, step, v);
}

// Whether one of these vertices has several fans.
bool has_fan(FanTable fans, Index first, Index end) noexcept {
  const auto fan = std::lower_bound(
      fans.begin(), fans.end(), first,
      [](const FanStart& start, Index vertex) { return start.vertex.value < vertex; });
  return fan != fans.end() && fan->vertex.value < end;
}

// Finds the rings of many vertices at a time, for these do not depend on positions, and then moves
// one after the other.
void smooth_groups(IndexRange range, const TriangleView& mesh, const SmoothStep& step) noexcept {
  constexpr SmoothWeights kUmbrella = SmoothWeights::umbrella;
  RingTable table;
  Index first = range.begin;
  for (; first + RingTable::kVertices <= range.end; first += RingTable::kVertices) {
    const std::uint32_t listed = has_fan(mesh.fans, first, first + RingTable::kVertices)
                                     ? 0
                                     : find_rings_avx2(first, mesh, table);
    for (int i = 0; i < RingTable::kVertices;) {
      const int end = i + std::countr_one(listed >> i);
      i = smooth_listed_avx2(first, i, end, table, step);
      if (i == RingTable::kVertices) break;
      smooth_one<kUmbrella>(mesh, step, VertexId(first + i));
      ++i;
    }
  }
  smooth_each<kUmbrella>({first, range.end}, mesh, step);
}

template <class Mesh>
void smooth(IndexRange range, const Mesh& mesh, const SmoothStep& step,
            SmoothWeights weights) noexcept {
  if (weights == SmoothWeights::cotangent) {
    smooth_each<SmoothWeights::cotangent>(range, mesh, step);
    return;
  }
  if constexpr (std::is_same_v<Mesh, TriangleView>) {
    if (has_avx2()) return smooth_groups(range, mesh, step);
  }
  smooth_each<SmoothWeights::umbrella>(range, mesh, step);
}

}  // namespace

void smooth_vertices(IndexRange range, const TriangleView& mesh, const SmoothStep& step,
                     SmoothWeights weights) noexcept {
  smooth(range, mesh, step, weights);
}
void smooth_vertices(IndexRange range, const PolygonView& mesh, const SmoothStep& step,
                     SmoothWeights weights) noexcept {
  smooth(range, mesh, step, weights);
}

}  // namespace hedgerow::kernels
