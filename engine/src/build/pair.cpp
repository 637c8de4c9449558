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

// Above this many scans a face it is cheaper to partition all corners first; PERF.md, "build".
constexpr std::int64_t kMaxScanPerMille = 3000;

// What one worker needs for one block at a time; grows and stays.
struct Slot {
  std::vector<Index> ends;
  Buffer<kernels::Corner> corners;
  std::vector<Index> irregular;
  std::vector<kernels::Spoke> spokes;
  std::vector<Index> links;
  std::vector<Defect> defects;
  std::vector<FanStart> fans;

  void reserve_corners(Index count) {
    const auto needed = static_cast<std::size_t>(count + kernels::kCornerPadding);
    if (corners.size() < needed) corners = Buffer<kernels::Corner>(needed + needed / 4);
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
    std::vector<Slot> slot(slots);
    std::vector<BlockFindings> findings(static_cast<std::size_t>(blocks.count));
    par::for_each_task(execution, blocks.count, [&](Index b, Index s) {
      const Index begin = blocks.begin(b);
      const Index size = std::min(Index{1} << blocks.shift, faces_.vertex_count - begin);
      link_block(source, b, {begin, size}, slot[static_cast<std::size_t>(s)],
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
  void link_block(const Source& source, Index b, kernels::VertexBlock block, Slot& slot,
                  BlockFindings& findings) {
    slot.ends.assign(static_cast<std::size_t>(block.size), 0);
    slot.irregular.resize(static_cast<std::size_t>(block.size));
    source.count(b, block, slot.ends.data());
    const Index corner_count = kernels::exclusive_scan(slot.ends.data(), block.size);
    slot.reserve_corners(corner_count);
    source.place(b, block, slot.ends.data(), slot.corners.data());

    findings.stats = link_regular(block, slot);
    findings.stats.step_count += corner_count;
    for (Index i = 0; i < findings.stats.irregular_count; ++i) {
      link_irregular(VertexId(slot.irregular[static_cast<std::size_t>(i)]), block, slot, findings);
    }
  }

  kernels::LinkStats link_regular(kernels::VertexBlock block, Slot& slot) {
    if (is_cut_ == nullptr) {
      return kernels::link_vertices(block, slot.ends.data(), slot.corners.data(),
                                    output_.opposite.data(), output_.outgoing.data(),
                                    slot.irregular.data());
    }
    kernels::LinkStats stats;
    for (Index i = 0; i < block.size; ++i) {
      slot.irregular[static_cast<std::size_t>(i)] = block.begin + i;
    }
    stats.irregular_count = block.size;
    return stats;
  }

  void link_irregular(VertexId v, kernels::VertexBlock block, Slot& slot, BlockFindings& findings) {
    const auto i = static_cast<std::size_t>(v.value - block.begin);
    const Index begin = i == 0 ? 0 : slot.ends[i - 1];
    const auto k = static_cast<std::size_t>(slot.ends[i] - begin);
    Index& outgoing = output_.outgoing[static_cast<std::size_t>(v.value)];
    if (k == 0) {
      outgoing = kInvalidIndex;
      findings.defects.push_back(
          {DefectKind::isolated_vertex, FaceId(), HalfedgeId(), v, VertexId(), 0});
      return;
    }
    const std::span<const kernels::Corner> corners(slot.corners.data() + begin, k);
    const auto result =
        kernels::link_irregular(v, corners, faces_.is_triangles(), is_cut_, output_.opposite.data(),
                                outgoing, slot.scratch_for(k));
    findings.stats = findings.stats + result.stats;
    findings.defects.insert(findings.defects.end(), slot.defects.begin(),
                            slot.defects.begin() + result.defect_count);
    findings.fans.insert(findings.fans.end(), slot.fans.begin() + 1,
                         slot.fans.begin() + result.fan_count);
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
