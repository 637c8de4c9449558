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
constexpr std::int64_t kMaxScanPerMille = 45'000;

class Pairing {
 public:
  Pairing(const kernels::FaceColumns& faces, const std::uint8_t* is_cut, PairOutput& output)
      : faces_(faces), is_cut_(is_cut), output_(output) {}

  template <class Source>
  void run(const Source& source, const Blocks& blocks, BuildScratch& scratch,
           const Execution& execution) {
    const auto workers = static_cast<std::size_t>(par::slot_count(execution, blocks.count));
    if (scratch.workers.size() < workers) scratch.workers.resize(workers);
    const auto block_count = static_cast<std::size_t>(blocks.count);
    if (scratch.findings.size() < block_count) scratch.findings.resize(block_count);
    const std::span<BlockFindings> findings = std::span(scratch.findings).first(block_count);
    par::for_each_task(execution, blocks.count, [&](Index b, Index s) {
      const Index begin = blocks.begin(b);
      const Index size = std::min(Index{1} << blocks.shift, faces_.vertex_count - begin);
      link_block(source, b, {begin, size}, scratch.workers[static_cast<std::size_t>(s)],
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
  void link_block(const Source& source, Index b, kernels::VertexBlock block, WorkerScratch& scratch,
                  BlockFindings& findings) {
    findings.clear();
    kernels::CornerSlots slots = scratch.slots_for(block, source.limit(b));
    source.place(b, slots);
    findings.stats = link_regular(slots, scratch);
    if (slots.overflow_count > 0) {
      const std::span<kernels::Corner> large = grown(scratch.large, kernels::count_large(slots));
      kernels::gather_large(slots, large.data(), scratch.large_ends.data());
      findings.stats.step_count += slots.overflow_count;
    }
    for (Index i = 0; i < findings.stats.irregular_count; ++i) {
      link_other(scratch.irregular[static_cast<std::size_t>(i)], slots, scratch, findings);
    }
  }

  // With half-edges cut, the vertices at them are irregular in ways that only the general path
  // knows: all go there.
  kernels::LinkStats link_regular(const kernels::CornerSlots& slots, WorkerScratch& scratch) {
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
  void link_other(Index v, const kernels::CornerSlots& slots, WorkerScratch& scratch,
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
                      WorkerScratch& scratch, BlockFindings& findings) {
    const auto result =
        kernels::link_irregular(v, corners, faces_.is_triangles(), is_cut_, output_.opposite.data(),
                                outgoing, scratch.irregular_for(corners.size()));
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
                          const std::uint8_t* is_cut, BuildStrategy strategy, BuildScratch& scratch,
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
    const WindowSource source(faces, survey, scratch);
    pairing.run(source, survey.blocks, scratch, execution);
  } else if (faces.is_triangles()) {
    const std::span memory = grown(scratch.loose_triangles, faces.halfedge_count());
    const PartitionSource source(faces, survey.blocks, memory, scratch, execution);
    pairing.run(source, survey.blocks, scratch, execution);
  } else {
    const std::span memory = grown(scratch.loose, faces.halfedge_count());
    const PartitionSource source(faces, survey.blocks, memory, scratch, execution);
    pairing.run(source, survey.blocks, scratch, execution);
  }
  for (Defect& defect : output.defects) {
    if (!defect.halfedge.valid()) continue;
    defect.face = face_of(faces, defect.halfedge);
  }
  sort_defects(output.defects);
  return output;
}

}  // namespace hedgerow::detail
