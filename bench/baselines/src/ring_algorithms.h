#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "hedgerow/index.h"
#include "hedgerow/normals.h"

/// The operations of both baseline meshes, written once over handles: a pointer or an index. Every
/// call below inlines to the loads that hand-written code for that mesh would make.
namespace hedgerow::baselines::detail {

struct Vector {
  float x = 0;
  float y = 0;
  float z = 0;
};

inline Vector load(const float* p) noexcept { return {p[0], p[1], p[2]}; }
inline Vector operator-(Vector a, Vector b) noexcept { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector operator+(Vector a, Vector b) noexcept { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vector operator*(float s, Vector a) noexcept { return {s * a.x, s * a.y, s * a.z}; }
inline float dot(Vector a, Vector b) noexcept { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline float length(Vector a) noexcept { return std::sqrt(dot(a, a)); }
inline Vector cross(Vector a, Vector b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// The unit vector, or (0, 0, 0) where there is none.
inline Vector normalized(Vector a) noexcept {
  const float l = length(a);
  return l > 0 && std::isfinite(l) ? (1 / l) * a : Vector{};
}
inline void store(Vector a, float* out) noexcept {
  out[0] = a.x;
  out[1] = a.y;
  out[2] = a.z;
}

/// Calls visit(h) for every outgoing half-edge of the fan that `start` begins.
template <class Mesh, class Visit>
void for_each_outgoing(const Mesh& mesh, typename Mesh::Handle start, const Visit& visit) {
  if (!mesh.is_valid(start)) return;
  typename Mesh::Handle h = start;
  do {
    visit(h);
    const typename Mesh::Handle h_opposite = mesh.opposite(h);
    if (!mesh.is_valid(h_opposite)) return;
    h = mesh.next(h_opposite);
  } while (h != start);
}

/// Twice the area vector of the face that h is in, by Newell's sum about the origin of h.
template <class Mesh>
Vector area_vector(const Mesh& mesh, typename Mesh::Handle h) {
  const Vector anchor = load(mesh.position(h));
  typename Mesh::Handle side = mesh.next(h);
  Vector from = load(mesh.position(side)) - anchor;
  Vector sum;
  for (side = mesh.next(side); side != h; side = mesh.next(side)) {
    const Vector to = load(mesh.position(side)) - anchor;
    sum = sum + cross(from, to);
    from = to;
  }
  return sum;
}

/// The mean of the corners of the face that h is in.
template <class Mesh>
std::array<float, 3> center(const Mesh& mesh, typename Mesh::Handle h) {
  Vector sum;
  float count = 0;
  typename Mesh::Handle side = h;
  do {
    sum = sum + load(mesh.position(side));
    count += 1;
    side = mesh.next(side);
  } while (side != h);
  return {sum.x / count, sum.y / count, sum.z / count};
}

/// How much the corner where h leaves adds to its vertex.
template <class Mesh>
Vector corner_normal(const Mesh& mesh, typename Mesh::Handle h, NormalWeight weight) {
  const auto& face = mesh.face(h);
  const Vector normal = load(face.normal);
  if (weight == NormalWeight::uniform) return normal;
  if (weight == NormalWeight::area) return face.double_area * normal;
  const Vector corner = load(mesh.position(h));
  const Vector a = load(mesh.position(mesh.next(h))) - corner;
  const Vector b = load(mesh.position(mesh.prev(h))) - corner;
  const Vector n = cross(a, b);
  if (weight == NormalWeight::angle) {
    const float angle = std::atan2(length(n), dot(a, b));
    const bool is_reflex = dot(n, normal) < 0;
    return (is_reflex ? 6.2831853F - angle : angle) * normal;
  }
  const float squares = dot(a, a) * dot(b, b);
  return squares > 0 ? (1 / squares) * n : Vector{};
}

template <class Mesh>
Vector vertex_normal(const Mesh& mesh, typename Mesh::Handle start, NormalWeight weight) {
  Vector sum;
  for_each_outgoing(mesh, start,
                    [&](typename Mesh::Handle h) { sum = sum + corner_normal(mesh, h, weight); });
  return normalized(sum);
}

/// Sum of the neighbours' ids: the targets of the outgoing half-edges and, in an open fan, the
/// origin of the half-edge before the first.
template <class Mesh>
std::uint32_t one_ring_sum(const Mesh& mesh, typename Mesh::Handle start) {
  std::uint32_t sum = 0;
  for_each_outgoing(mesh, start, [&](typename Mesh::Handle h) {
    sum += static_cast<std::uint32_t>(mesh.origin(mesh.next(h)));
  });
  if (mesh.is_valid(start)) {
    const typename Mesh::Handle before = mesh.prev(start);
    if (!mesh.is_valid(mesh.opposite(before))) {
      sum += static_cast<std::uint32_t>(mesh.origin(before));
    }
  }
  return sum;
}

/// The boundary half-edge that leaves the target of boundary half-edge h.
template <class Mesh>
typename Mesh::Handle next_boundary(const Mesh& mesh, typename Mesh::Handle h) {
  typename Mesh::Handle g = mesh.next(h);
  while (mesh.is_valid(mesh.opposite(g))) g = mesh.next(mesh.opposite(g));
  return g;
}

/// Union-find with path halving; the root of a set is its smallest member.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), Index{0});
  }
  Index find(Index v) noexcept {
    while (parent(v) != v) {
      parent(v) = parent(parent(v));
      v = parent(v);
    }
    return v;
  }
  void unite(Index a, Index b) noexcept {
    a = find(a);
    b = find(b);
    if (a < b) parent(b) = a;
    if (b < a) parent(a) = b;
  }

 private:
  Index& parent(Index v) noexcept { return parent_[static_cast<std::size_t>(v)]; }

  std::vector<Index> parent_;
};

}  // namespace hedgerow::baselines::detail
