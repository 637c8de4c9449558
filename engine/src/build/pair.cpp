// Vertex by vertex rather than edge by edge: with all corners of a vertex in one place, every edge
// at it is seen whole, so pairing, fans, `outgoing` and all defects fall out of one look, and a
// vertex writes nothing but its own half-edges. The price is that each edge is looked at from both
// ends. Bringing the corners together is what costs; see `BuildStrategy`.

#include "build/pair.h"

#include <algorithm>
#include <tuple>

#include "build/corner_source.h"
#include "kernels/link_irregular.h"
#include "parallel/parallel.h"

namespace hedgerow::detail {

namespace {

// Above this many scans a face it is cheaper to partition all corners first; PERF.md, "Decisions".
constexpr std::int64_t kMaxScanPerMille = 20'000;

// What one worker needs for one block at a time; grows and stays.
struct Scratch {
  Buffer<kernels::CornerSlot> slots;
  Buffer<Index> counts;
  Buffer<Index> irregular;
  Buffer<Index> large_ends;
  Buffer<kernels::LooseCorner> overflow;
  Buffer<kernels::Corner> large;
  std::vector<kernels::Spoke> spokes;
  std::vector<Index> links;
  std::vector<Defect> defects;
  std::vector<FanStart> fans;

  kernels::CornerSlots slots_for(kernels::VertexBlock block, Index corner_limit) {
    grow(slots, block.size);
    grow(counts, block.size);
    grow(irregular, block.size);
    grow(large_ends, block.size);
    grow(overflow, corner_limit);
    kernels::CornerSlots result{block, slots.data(), counts.data(), overflow.data()};
    kernels::clear_slots(result);
    return result;
  }

  [[nodiscard]] kernels::IrregularScratch scratch_for(std::size_t k) {
    spokes.resize(std::max(spokes.size(), 4 * k));
    links.resize(std::max(links.size(), 3 * k));
    defects.resize(std::max(defects.size(), 2 * k + 1));
    fans.resize(std::max(fans.size(), k));
    const std::span<Index> all(links);
    return {std::span(spokes).first(4 * k), all.first(k), all.subspan(k, k),
            all.subspan(2 * k, k),          defects,      fans};
  }

  template <class T>
  static void grow(Buffer<T>& buffer, Index needed) {
    const auto size = static_cast<std::size_t>(needed);
    if (buffer.size() < size) buffer = Buffer<T>(size);
  }
};

// What a block found that most blocks do not.
struct BlockFindings {
  kernels::LinkStats stats;
  std::vector<Defect> defects;
  std::vector<FanStart> fans;
};

class Pairing {
 public:
  Pairing(const kernels::FaceColumns& faces, const std::uint8_t* is_cut, PairOutput& output)
      : faces_(faces), is_cut_(is_cut), output_(output) {}

  template <class Source>
  void run(const Source& source, const Blocks& blocks, const Execution& execution) {
    const auto slots = static_cast<std::size_t>(par::slot_count(execution, blocks.count));
    std::vector<Scratch> scratch(slots);
    std::vector<BlockFindings> findings(static_cast<std::size_t>(blocks.count));
    par::for_each_task(execution, blocks.count, [&](Index b, Index s) {
      const Index begin = blocks.begin(b);
      const Index size = std::min(Index{1} << blocks.shift, faces_.vertex_count - begin);
      link_block(source, b, {begin, size}, scratch[static_cast<std::size_t>(s)],
                 findings[static_cast<std::size_t>(b)]);
    });
    for (const BlockFindings& f : findings) {
      output_.stats = output_.stats + f.stats;
      output_.defects.insert(output_.defects.end(), f.defects.begin(), f.defects.end());
      output_.fans.insert(output_.fans.end(), f.fans.begin(), f.fans.end());
    }
  }

 private:
  template <class Source>
  void link_block(const Source& source, Index b, kernels::VertexBlock block, Scratch& scratch,
                  BlockFindings& findings) {
    kernels::CornerSlots slots = scratch.slots_for(block, source.limit(b));
    source.place(b, slots);
    findings.stats = link_regular(slots, scratch);
    if (slots.overflow_count > 0) {
      Scratch::grow(scratch.large, kernels::count_large(slots));
      kernels::gather_large(slots, scratch.large.data(), scratch.large_ends.data());
      findings.stats.step_count += slots.overflow_count;
    }
    for (Index i = 0; i < findings.stats.irregular_count; ++i) {
      link_other(scratch.irregular[static_cast<std::size_t>(i)], slots, scratch, findings);
    }
  }

  // With half-edges cut, the vertices at them are irregular in ways that only the general path
  // knows: all go there.
  kernels::LinkStats link_regular(const kernels::CornerSlots& slots, Scratch& scratch) {
    if (is_cut_ == nullptr) {
      return kernels::link_vertices(slots, output_.opposite.data(), output_.outgoing.data(),
                                    scratch.irregular.data());
    }
    kernels::LinkStats stats;
    stats.irregular_count = slots.block.size;
    for (Index i = 0; i < slots.block.size; ++i) {
      stats.step_count += slots.count[i];
      scratch.irregular[static_cast<std::size_t>(i)] = slots.block.begin + i;
    }
    return stats;
  }

  // A vertex that is not one small closed fan, as almost all others are.
  void link_other(Index v, const kernels::CornerSlots& slots, Scratch& scratch,
                  BlockFindings& findings) {
    const Index i = v - slots.block.begin;
    const Index k = slots.count[i];
    Index& outgoing = output_.outgoing[static_cast<std::size_t>(v)];
    if (k == 0) {
      outgoing = kInvalidIndex;
      findings.defects.push_back(
          {DefectKind::isolated_vertex, FaceId(), HalfedgeId(), VertexId(v), VertexId(), 0});
      return;
    }
    kernels::Corner in_slot[kernels::CornerSlot::kCapacity];
    std::span<const kernels::Corner> corners(in_slot, static_cast<std::size_t>(k));
    if (k <= kernels::CornerSlot::kCapacity) {
      for (Index n = 0; n < k; ++n) in_slot[n] = slots.slot[i].corner(n);
    } else {
      const Index end = scratch.large_ends[static_cast<std::size_t>(i)];
      corners = scratch.large.span().subspan(static_cast<std::size_t>(end - k),
                                             static_cast<std::size_t>(k));
    }
    if (is_cut_ == nullptr && k <= kernels::kSmallValence &&
        kernels::link_fan(corners, output_.opposite.data(), outgoing, findings.stats)) {
      return;
    }
    link_irregular(VertexId(v), corners, outgoing, scratch, findings);
  }

  void link_irregular(VertexId v, std::span<const kernels::Corner> corners, Index& outgoing,
                      Scratch& scratch, BlockFindings& findings) {
    const auto result =
        kernels::link_irregular(v, corners, faces_.is_triangles(), is_cut_, output_.opposite.data(),
                                outgoing, scratch.scratch_for(corners.size()));
    findings.stats = findings.stats + result.stats;
    findings.defects.insert(findings.defects.end(), scratch.defects.begin(),
                            scratch.defects.begin() + result.defect_count);
    findings.fans.insert(findings.fans.end(), scratch.fans.begin() + 1,
                         scratch.fans.begin() + result.fan_count);
  }

  const kernels::FaceColumns& faces_;
  const std::uint8_t* is_cut_;
  PairOutput& output_;
};

}  // namespace

void sort_defects(std::vector<Defect>& defects) {
  std::sort(defects.begin(), defects.end(), [](const Defect& a, const Defect& b) {
    const auto key = [](const Defect& d) {
      const bool is_edge = d.halfedge.valid();
      return std::tuple(d.kind, is_edge ? d.halfedge.value : d.face.value, d.vertex.value);
    };
    return key(a) < key(b);
  });
}

PairOutput pair_halfedges(const kernels::FaceColumns& faces, const Survey& survey,
                          const std::uint8_t* is_cut, BuildStrategy strategy,
                          const Execution& execution) {
  PairOutput output;
  output.opposite = Buffer<Index>(static_cast<std::size_t>(faces.halfedge_count()));
  output.outgoing = Buffer<Index>(static_cast<std::size_t>(faces.vertex_count));
  if (strategy == BuildStrategy::automatic) {
    strategy = survey.scan_per_mille <= kMaxScanPerMille ? BuildStrategy::window
                                                         : BuildStrategy::partition;
  }
  output.strategy = strategy;
  Pairing pairing(faces, is_cut, output);
  if (strategy == BuildStrategy::window) {
    pairing.run(WindowSource(faces, survey), survey.blocks, execution);
  } else {
    pairing.run(PartitionSource(faces, survey.blocks, execution), survey.blocks, execution);
  }
  for (Defect& defect : output.defects) {
    if (!defect.halfedge.valid()) continue;
    defect.face = face_of(faces, defect.halfedge);
  }
  sort_defects(output.defects);
  return output;
}

}  // namespace hedgerow::detail
