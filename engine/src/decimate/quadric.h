#pragma once

#include <cmath>

#include "kernels/normals_math.h"

/// Quadrics: a weighted sum of squared distances to planes and points, as a function of one point.
namespace hedgerow::decimation {

using Double3 = kernels::Vec3<double>;

[[nodiscard]] inline Double3 widen(const float* p) noexcept {
  return {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2])};
}

/// x A x + 2 b x + c, where A is symmetric.
struct Quadric {
  double xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  Double3 b{0, 0, 0};
  double c = 0;

  /// `weight` times the squared distance to the plane through `p` with this unit normal.
  [[nodiscard]] static Quadric of_plane(Double3 normal, Double3 p, double weight) noexcept {
    const double d = -dot(normal, p);
    const Double3 n = normal * weight;
    return {n.x * normal.x, n.x * normal.y, n.x * normal.z, n.y * normal.y,
            n.y * normal.z, n.z * normal.z, n * d,          weight * d * d};
  }
  /// `weight` times the squared distance to `p`.
  [[nodiscard]] static Quadric of_point(Double3 p, double weight) noexcept {
    return {weight, 0, 0, weight, 0, weight, p * -weight, weight * dot(p, p)};
  }

  friend Quadric operator+(const Quadric& q, const Quadric& r) noexcept {
    return {q.xx + r.xx, q.xy + r.xy, q.xz + r.xz, q.yy + r.yy,
            q.yz + r.yz, q.zz + r.zz, q.b + r.b,   q.c + r.c};
  }

  [[nodiscard]] double at(Double3 p) const noexcept {
    const Double3 ap = {xx * p.x + xy * p.y + xz * p.z, xy * p.x + yy * p.y + yz * p.z,
                        xz * p.x + yz * p.y + zz * p.z};
    return dot(p, ap) + 2 * dot(b, p) + c;
  }

  /// Where it is least: Cramer's rule. Not a number where that is not one point.
  [[nodiscard]] Double3 lowest() const noexcept {
    const double m_xx = yy * zz - yz * yz;
    const double m_xy = yz * xz - xy * zz;
    const double m_xz = xy * yz - yy * xz;
    const double scale = -1 / (xx * m_xx + xy * m_xy + xz * m_xz);
    const double m_yy = xx * zz - xz * xz;
    const double m_yz = xy * xz - xx * yz;
    const double m_zz = xx * yy - xy * xy;
    return {(m_xx * b.x + m_xy * b.y + m_xz * b.z) * scale,
            (m_xy * b.x + m_yy * b.y + m_yz * b.z) * scale,
            (m_xz * b.x + m_yz * b.y + m_zz * b.z) * scale};
  }
};

}  // namespace hedgerow::decimation
