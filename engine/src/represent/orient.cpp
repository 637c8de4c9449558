// A breadth-first walk over the faces of each patch gives every face a side, 0 or 1, from the face
// it was reached from. An edge whose faces contradict each other closes a cycle with the two ways
// back to where these meet.

#include "hedgerow/orient.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "at.h"

namespace hedgerow {

namespace {

template <Topology Mesh>
class Walk {
 public:
  Walk(const Mesh& mesh, const RadialCycles& cycles)
      : mesh_(mesh),
        cycles_(cycles),
        side_(at(mesh.face_count()), kUnseen),
        from_(at(mesh.face_count()), kInvalidIndex),
        depth_(at(mesh.face_count()), 0) {}

  Orientation run() {
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      if (side_[at(f)] == kUnseen) walk_patch(FaceId(f));
    }
    std::sort(flipped_.begin(), flipped_.end());
    result_.flipped = Buffer<Index>::copy_of(flipped_);
    result_.proof_first = Buffer<Index>::copy_of(proof_first_);
    result_.proof_faces = Buffer<Index>::copy_of(proof_faces_);
    return std::move(result_);
  }

 private:
  static constexpr std::int8_t kUnseen = -1;

  void walk_patch(FaceId start) {
    queue_.assign(1, start);
    side_[at(start.value)] = 0;
    bool is_orientable = true;
    for (std::size_t i = 0; i < queue_.size(); ++i) {
      const FaceId f = queue_[i];
      for (const HalfedgeId h : halfedges(mesh_, f)) {
        const HalfedgeId other = cycles_.next(h);
        if (other == h || cycles_.next(other) != h) continue;
        const bool is_contradiction = !reach(f, mesh_.face(other), runs_the_same_way(h, other));
        if (is_contradiction && is_orientable) {
          add_proof(f.value, mesh_.face(other).value);
          is_orientable = false;
        }
      }
    }
    ++result_.patch_count;
    result_.nonorientable_count += static_cast<Index>(!is_orientable);
    if (!is_orientable) return;
    for (const FaceId f : queue_) {
      if (side_[at(f.value)] == 1) flipped_.push_back(f.value);
    }
  }

  [[nodiscard]] bool runs_the_same_way(HalfedgeId h, HalfedgeId other) const noexcept {
    return mesh_.origin[h] == mesh_.origin[other];
  }

  // False if `to` has a side already, and it is not the one that follows from `from`.
  [[nodiscard]] bool reach(FaceId from, FaceId to, bool is_turned) {
    const auto side = static_cast<std::int8_t>(side_[at(from.value)] ^ static_cast<int>(is_turned));
    std::int8_t& found = side_[at(to.value)];
    if (found != kUnseen) return found == side;
    found = side;
    from_[at(to.value)] = from.value;
    depth_[at(to.value)] = depth_[at(from.value)] + 1;
    queue_.push_back(to);
    return true;
  }

  // From a up to where the ways back of a and b meet, and down to b.
  void add_proof(Index a, Index b) {
    std::vector<Index> down;
    while (a != b) {
      if (depth_[at(a)] >= depth_[at(b)]) {
        proof_faces_.push_back(a);
        a = from_[at(a)];
      } else {
        down.push_back(b);
        b = from_[at(b)];
      }
    }
    proof_faces_.push_back(a);
    proof_faces_.insert(proof_faces_.end(), down.rbegin(), down.rend());
    proof_first_.push_back(static_cast<Index>(proof_faces_.size()));
  }

  const Mesh& mesh_;
  const RadialCycles& cycles_;
  std::vector<std::int8_t> side_;
  std::vector<Index> from_;
  std::vector<Index> depth_;
  std::vector<FaceId> queue_;
  std::vector<Index> flipped_;
  std::vector<Index> proof_first_ = {0};
  std::vector<Index> proof_faces_;
  Orientation result_;
};

}  // namespace

Orientation find_orientation(const Connectivity& mesh, const RadialCycles& cycles) {
  return mesh.visit([&](const auto& view) { return Walk(view, cycles).run(); });
}

}  // namespace hedgerow
