#pragma once

#include <cstdint>
#include <vector>

#include "frames/subject.h"
#include "hedgerow/ray/scene.h"

namespace hedgerow::bench {

using Packets = std::vector<ray::RayPacket>;

/// All rays come from fixed seeds before any clock runs.
///
/// Primary rays go through the pixels of a picture of the mesh from the front and above, in tiles
/// of 8 x 8; their number is the largest picture of 16 : 9 with at most `count` rays.
[[nodiscard]] Packets primary_rays(const Subject& subject, std::int64_t count);

/// From each hit, `per_hit` rays spread by the cosine round the face's normal, as far as `reach`
/// diagonals. Rays of one hit share a packet where they fill it.
[[nodiscard]] Packets scattered_rays(const Subject& subject, const ray::Scene& scene,
                                     const Packets& packets,
                                     const std::vector<ray::HitPacket>& hits, int per_hit,
                                     float reach);

/// Points in the box of the mesh, a little larger.
[[nodiscard]] std::vector<ray::Vec3> random_points(const Subject& subject, std::int64_t count);

[[nodiscard]] ray::Ray ray_of(const ray::RayPacket& packet, std::size_t lane);

[[nodiscard]] std::int64_t count_rays(const Packets& packets);
[[nodiscard]] std::int64_t count_hits(const std::vector<ray::HitPacket>& hits);

/// Compares hits with trying every triangle, in double, for `sample` rays spread over the packets.
/// Returns how many answers are wrong: further off than rounding explains, away from edges.
[[nodiscard]] std::int64_t wrong_hits(const Subject& subject, const Buffer<float>& xyz,
                                      const Packets& packets,
                                      const std::vector<ray::HitPacket>& hits, std::int64_t sample);
/// How many rays may be tried against every triangle in about ten seconds; at most 10,000.
[[nodiscard]] std::int64_t affordable_sample(const Subject& subject);

}  // namespace hedgerow::bench
