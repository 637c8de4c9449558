#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "hedgerow/shapes.h"
#include "random.h"

namespace hedgerow::shapes {

namespace {

std::vector<Index> random_permutation(Index count, SplitMix& random) {
  std::vector<Index> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), Index{0});
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  return order;
}

}  // namespace

Soup shuffled(const Soup& soup, std::uint64_t seed) {
  SplitMix random(seed);
  const std::vector<Index> vertices_old_to_new = random_permutation(soup.vertex_count(), random);
  const std::vector<Index> faces_new_to_old = random_permutation(soup.face_count(), random);

  Soup out;
  out.xyz = Buffer<float>(soup.xyz.size());
  out.corners = Buffer<Index>(soup.corners.size());
  out.offsets = Buffer<Index>(soup.offsets.size());
  for (std::size_t v = 0; v < vertices_old_to_new.size(); ++v) {
    const auto to = static_cast<std::size_t>(vertices_old_to_new[v]);
    std::copy_n(soup.xyz.data() + 3 * v, 3, out.xyz.data() + 3 * to);
  }
  Index* corner = out.corners.data();
  for (std::size_t i = 0; i < faces_new_to_old.size(); ++i) {
    const auto f = static_cast<std::size_t>(faces_new_to_old[i]);
    const auto begin = soup.offsets.empty() ? 3 * f : static_cast<std::size_t>(soup.offsets[f]);
    const auto end =
        soup.offsets.empty() ? begin + 3 : static_cast<std::size_t>(soup.offsets[f + 1]);
    if (!out.offsets.empty()) out.offsets[i] = static_cast<Index>(corner - out.corners.data());
    for (std::size_t c = begin; c < end; ++c) {
      *corner++ = vertices_old_to_new[static_cast<std::size_t>(soup.corners[c])];
    }
  }
  if (!out.offsets.empty()) {
    out.offsets[faces_new_to_old.size()] = static_cast<Index>(out.corners.size());
  }
  return out;
}

}  // namespace hedgerow::shapes
