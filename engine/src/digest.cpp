// Blocks of a fixed number of elements, each hashed on its own and then chained in their order: the
// schedule decides who hashes a block, never what a block is.

#include "hedgerow/digest.h"

#include <algorithm>
#include <cstring>

#include "hedgerow/buffer.h"
#include "kernels/hash_columns.h"
#include "parallel/parallel.h"

namespace hedgerow {

namespace {

constexpr Index kBlock = 1 << 14;  // part of what a digest is: D12 in engine/DESIGN.md

template <class Kernel>
std::uint64_t chain_blocks(const Execution& execution, Index count, std::uint64_t state,
                           const Kernel& kernel) {
  state = kernels::hash_step(state, count);
  const Index block_count = count == 0 ? 0 : (count - 1) / kBlock + 1;
  Buffer<std::uint64_t> block(static_cast<std::size_t>(block_count));
  par::for_each_task(execution, block_count, [&](Index b, Index) {
    const Index begin = b * kBlock;
    block[static_cast<std::size_t>(b)] =
        kernel(IndexRange{begin, begin + std::min(kBlock, count - begin)});
  });
  for (const std::uint64_t hash : block) state = kernels::hash_step(state, hash);
  return state;
}

template <Topology Mesh>
std::uint64_t digest_of(const Mesh& mesh, const Execution& execution) {
  std::uint64_t state = kernels::kHashSeeds[0];
  state = chain_blocks(execution, mesh.halfedge_count(), state,
                       [&](IndexRange range) { return kernels::hash_halfedges(range, mesh); });
  state = chain_blocks(execution, mesh.vertex_count(), state,
                       [&](IndexRange range) { return kernels::hash_vertices(range, mesh); });
  state = chain_blocks(execution, mesh.face_count(), state,
                       [&](IndexRange range) { return kernels::hash_faces(range, mesh); });
  state = kernels::hash_step(state, static_cast<std::uint64_t>(mesh.fans.size()));
  for (const FanStart& fan : mesh.fans) {
    state = kernels::hash_step(kernels::hash_step(state, fan.vertex.value), fan.start.value);
  }
  return state;
}

}  // namespace

std::uint64_t digest(const Connectivity& mesh, const Execution& execution) {
  return mesh.visit([&](const auto& view) { return digest_of(view, execution); });
}

std::uint64_t digest(std::span<const std::byte> bytes) noexcept {
  constexpr std::size_t kWord = sizeof(std::uint64_t);
  std::uint64_t state =
      kernels::hash_step(kernels::kHashSeeds[3], static_cast<std::uint64_t>(bytes.size()));
  while (!bytes.empty()) {
    std::uint64_t word = 0;
    const std::size_t size = std::min(kWord, bytes.size());
    std::memcpy(&word, bytes.data(), size);
    state = kernels::hash_step(state, word);
    bytes = bytes.subspan(size);
  }
  return state;
}

}  // namespace hedgerow
