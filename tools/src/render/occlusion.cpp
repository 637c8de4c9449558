#include "render/occlusion.h"

#include <algorithm>
#include <cmath>

namespace hedgerow::tool {
namespace {

// Mixing that leaves no pattern between neighbouring pixels: the finaliser of MurmurHash3.
float fraction_of(std::uint32_t value) {
  value ^= value >> 16U;
  value *= 0x85EBCA6BU;
  value ^= value >> 13U;
  value *= 0xC2B2AE35U;
  value ^= value >> 16U;
  return static_cast<float>(value >> 8U) / 16777216.0F;
}
float wrapped(float x) { return x - std::floor(x); }

constexpr float kTwoPi = 6.28318530718F;
constexpr float kGoldenRatio = 0.61803398875F;  // multiples of it spread over a circle evenly
constexpr float kLift = 2e-4F;                  // of the reach: off the surface itself

}  // namespace

float Occlusion::open_share(const Vec3& point, const Vec3& normal, std::uint32_t seed) const {
  const Vec3 helper = std::abs(normal[0]) < 0.6F ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
  const Vec3 tangent = unit(cross(normal, helper));
  const Vec3 other = cross(normal, tangent);
  const float turn = fraction_of(2 * seed);
  const float shift = fraction_of(2 * seed + 1);
  int open = 0;
  for (int begin = 0; begin < rays_; begin += 8) {
    ray::RayPacket packet;
    packet.count = std::min(8, rays_ - begin);
    for (int i = 0; i < packet.count; ++i) {
      const auto number = static_cast<float>(begin + i);
      const float squared = wrapped((number + 0.5F) / static_cast<float>(rays_) + shift);
      const float angle = kTwoPi * wrapped(number * kGoldenRatio + turn);
      const float radius = std::sqrt(squared);
      const Vec3 way = tangent * (radius * std::cos(angle)) + other * (radius * std::sin(angle)) +
                       normal * std::sqrt(1 - squared);
      packet.set(static_cast<std::size_t>(i), {point + normal * (kLift * reach_), way, 0, reach_});
    }
    const auto is_occluded = scene_->is_occluded(packet, ray::Coherence::incoherent);
    for (int i = 0; i < packet.count; ++i) open += is_occluded[static_cast<std::size_t>(i)] ? 0 : 1;
  }
  return static_cast<float>(open) / static_cast<float>(rays_);
}

}  // namespace hedgerow::tool
