#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

#include "edit/batch.h"
#include "kernels/flip_edges.h"

namespace hedgerow {
namespace {

/// The edges that the flips of a batch make: pairs of vertices, by open addressing.
class NewEdges {
 public:
  explicit NewEdges(std::size_t most) : slots_(std::bit_ceil(2 * most + 1)) {}

  /// Whether it was not there.
  bool insert(VertexId a, VertexId b) noexcept {
    const VertexId low = std::min(a, b);
    const VertexId high = std::max(a, b);
    const std::size_t mask = slots_.size() - 1;
    for (std::size_t i = place_of(low, high) & mask;; i = (i + 1) & mask) {
      Slot& slot = slots_[i];
      if (!slot.low.valid()) {
        slot = {low, high};
        return true;
      }
      if (slot.low == low && slot.high == high) return false;
    }
  }

 private:
  struct Slot {
    VertexId low;
    VertexId high;
  };
  static std::size_t place_of(VertexId low, VertexId high) noexcept {
    // Multiplication by odd numbers carries all bits upwards, so the upper half is taken.
    const auto mixed = static_cast<std::uint64_t>(low.value) * 0x9e3779b97f4a7c15U ^
                       static_cast<std::uint64_t>(high.value) * 0xc2b2ae3d27d4eb4fU;
    return static_cast<std::size_t>(mixed >> 32U ^ mixed >> 13U);
  }

  std::vector<Slot> slots_;
};

/// Flips do not meet if they have no face in common, and make no edge twice.
class FlipKind {
 public:
  using Plan = kernels::Flip;

  FlipKind(const EditMesh& mesh, std::size_t most)
      : mesh_(mesh),
        view_(mesh.view()),
        is_claimed_(static_cast<std::size_t>(view_.face_count())),
        edges_(most) {}

  [[nodiscard]] EditCheck check(HalfedgeId h) const { return mesh_.can_flip(h); }
  [[nodiscard]] Plan plan(HalfedgeId h) const noexcept {
    const HalfedgeId o = view_.opposite[h];
    return {h.value, view_.outgoing[view_.origin[h]] == h, view_.outgoing[view_.origin[o]] == o};
  }
  // Far away two flips may make the same edge.
  [[nodiscard]] bool claim(const Plan& plan) noexcept {
    const HalfedgeId h(plan.halfedge);
    const HalfedgeId o = view_.opposite[h];
    const auto left = static_cast<std::size_t>(view_.face(h).value);
    const auto right = static_cast<std::size_t>(view_.face(o).value);
    if (is_claimed_[left] || is_claimed_[right]) return false;
    if (!edges_.insert(view_.target(view_.next(o)), view_.target(view_.next(h)))) return false;
    is_claimed_[left] = is_claimed_[right] = true;
    ++count_;
    return true;
  }
  [[nodiscard]] BatchRoom room() const noexcept { return {.writes = kWrites * count_}; }
  static void record(Edit& edit, const Plan& plan) { edit.flip(HalfedgeId(plan.halfedge)); }
  static void scatter(IndexRange range, const Plan* plans,
                      const kernels::EditColumns& columns) noexcept {
    kernels::scatter_flips(range, plans, columns);
  }

 private:
  static constexpr std::size_t kWrites = 20;

  const EditMesh& mesh_;
  EditView view_;
  std::vector<bool> is_claimed_;  // by face
  NewEdges edges_;
  std::size_t count_ = 0;
};

}  // namespace

EditBatch EditMesh::flip_batch(std::span<const HalfedgeId> wanted, const Execution& execution) {
  return run_batch(*this, FlipKind(*this, wanted.size()), wanted, execution);
}

}  // namespace hedgerow
