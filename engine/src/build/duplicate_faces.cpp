#include "build/duplicate_faces.h"

#include <algorithm>
#include <cstdint>

#include "hedgerow/buffer.h"
#include "kernels/corner_blocks.h"
#include "parallel/parallel.h"

namespace hedgerow::detail {

namespace {

constexpr Index kSignatureGrain = 1 << 14;
constexpr Index kVertexGrain = 1 << 14;

struct Signature {
  Index smallest = 0;
  std::uint64_t sum = 0;  ///< of a mixed value per vertex: the same in any order
};

// The finaliser of the 64-bit mixers: every input bit reaches every output bit.
std::uint64_t mix(std::uint64_t x) noexcept {
  x ^= x >> 32;
  x *= 0xd6e8feb86659fd93ULL;
  x ^= x >> 32;
  x *= 0xd6e8feb86659fd93ULL;
  return x ^ (x >> 32);
}

Signature signature_of(const kernels::FaceColumns& faces, Index f) noexcept {
  const Index begin = faces.begin(f);
  const Index end = begin + faces.degree(f);
  Signature s{faces.corners[begin], 0};
  for (Index h = begin; h < end; ++h) {
    s.smallest = std::min(s.smallest, faces.corners[h]);
    s.sum += mix(static_cast<std::uint64_t>(faces.corners[h]) + 1);
  }
  return s;
}

bool have_same_vertices(const kernels::FaceColumns& faces, Index a, Index b) {
  if (faces.degree(a) != faces.degree(b)) return false;
  const auto sorted = [&](Index f) {
    const Index* begin = faces.corners + faces.begin(f);
    std::vector<Index> vertices(begin, begin + faces.degree(f));
    std::sort(vertices.begin(), vertices.end());
    return vertices;
  };
  return sorted(a) == sorted(b);
}

// Faces of one smallest vertex, ascending. Equal signatures are next to each other after sorting;
// different sets with one signature are told apart by comparing with each first face of the run.
void find_in_group(const kernels::FaceColumns& faces, std::vector<Index>& group,
                   const Buffer<Signature>& signatures, std::vector<Defect>& found) {
  const auto sum = [&](Index f) { return signatures[static_cast<std::size_t>(f)].sum; };
  std::sort(group.begin(), group.end(),
            [&](Index a, Index b) { return sum(a) != sum(b) ? sum(a) < sum(b) : a < b; });
  std::vector<Index> firsts;
  for (std::size_t i = 0; i < group.size(); ++i) {
    if (i == 0 || sum(group[i]) != sum(group[i - 1])) firsts.clear();
    const auto same = std::find_if(firsts.begin(), firsts.end(), [&](Index first) {
      return have_same_vertices(faces, first, group[i]);
    });
    if (same == firsts.end()) {
      firsts.push_back(group[i]);
    } else {
      found.push_back({DefectKind::duplicate_face, FaceId(group[i]), HalfedgeId(), VertexId(),
                       VertexId(), *same});
    }
  }
}

}  // namespace

std::vector<Defect> find_duplicate_faces(const kernels::FaceColumns& faces,
                                         const Execution& execution) {
  const auto face_count = static_cast<std::size_t>(faces.face_count);
  Buffer<Signature> signatures(face_count);
  par::for_each_range(execution, faces.face_count, kSignatureGrain, [&](IndexRange range) {
    for (Index f = range.begin; f < range.end; ++f) {
      signatures.data()[f] = signature_of(faces, f);
    }
  });

  Buffer<Index> ends(static_cast<std::size_t>(faces.vertex_count) + 1, Index{0});
  for (const Signature& s : signatures) ++ends[static_cast<std::size_t>(s.smallest)];
  kernels::exclusive_scan(ends.data(), faces.vertex_count + 1);
  Buffer<Index> order(face_count);
  for (std::size_t f = 0; f < face_count; ++f) {
    const auto smallest = static_cast<std::size_t>(signatures[f].smallest);
    order[static_cast<std::size_t>(ends[smallest]++)] = static_cast<Index>(f);
  }

  const Index chunk_count = (faces.vertex_count + kVertexGrain - 1) / kVertexGrain;
  std::vector<std::vector<Defect>> found(static_cast<std::size_t>(chunk_count));
  par::for_each_task(execution, chunk_count, [&](Index chunk, Index) {
    std::vector<Index> group;
    const Index last = std::min(faces.vertex_count, (chunk + 1) * kVertexGrain);
    for (Index v = chunk * kVertexGrain; v < last; ++v) {
      const Index begin = v == 0 ? 0 : ends[static_cast<std::size_t>(v - 1)];
      const Index end = ends[static_cast<std::size_t>(v)];
      if (end - begin < 2) continue;
      group.assign(order.data() + begin, order.data() + end);
      find_in_group(faces, group, signatures, found[static_cast<std::size_t>(chunk)]);
    }
  });
  std::vector<Defect> all;
  for (const auto& part : found) all.insert(all.end(), part.begin(), part.end());
  std::sort(all.begin(), all.end(),
            [](const Defect& a, const Defect& b) { return a.face < b.face; });
  return all;
}

}  // namespace hedgerow::detail
