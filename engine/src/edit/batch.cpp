// Many edits at once: those that do not meet are done together.
#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

#include "edit/edit.h"
#include "kernels/flip_edges.h"
#include "parallel/parallel.h"

namespace hedgerow {
namespace {

constexpr Index kGrain = 1 << 12;  // flips a task

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

}  // namespace

/// One batch of flips: asks, chooses, flips.
class FlipBatcher {
 public:
  FlipBatcher(EditMesh& mesh, std::span<const HalfedgeId> wanted, const Execution& execution)
      : mesh_(mesh),
        view_(mesh.view()),
        wanted_(wanted),
        execution_(execution),
        flips_(wanted.size()),
        is_possible_(wanted.size()) {}

  FlipBatch run() {
    ask();
    choose();
    batch_.change = mesh_.is_recording_ ? flip_recorded() : flip_all();
    return std::move(batch_);
  }

 private:
  static std::size_t at(Index i) noexcept { return static_cast<std::size_t>(i); }
  [[nodiscard]] Index count() const noexcept { return static_cast<Index>(wanted_.size()); }

  void ask() {
    par::for_each_range(execution_, count(), kGrain, [&](IndexRange range) {
      for (Index i = range.begin; i < range.end; ++i) {
        const HalfedgeId h = wanted_[at(i)];
        is_possible_[at(i)] = mesh_.can_flip(h) ? 1 : 0;
        if (is_possible_[at(i)] == 0) continue;
        const HalfedgeId o = view_.opposite[h];
        flips_[at(i)] = {h.value, view_.outgoing[view_.origin[h]] == h,
                         view_.outgoing[view_.origin[o]] == o};
      }
    });
  }

  // In their order, each unless one before it has claimed a face of its two, or, far away, makes
  // the same edge.
  void choose() {
    std::vector<bool> is_claimed(at(view_.face_count()));
    NewEdges edges(wanted_.size());
    for (Index i = 0; i < count(); ++i) {
      const HalfedgeId h = wanted_[at(i)];
      if (is_possible_[at(i)] == 0) {
        batch_.refused.push_back(h);
        continue;
      }
      const HalfedgeId o = view_.opposite[h];
      const std::size_t left = at(view_.face(h).value);
      const std::size_t right = at(view_.face(o).value);
      const bool is_free = !is_claimed[left] && !is_claimed[right] &&
                           edges.insert(view_.target(view_.next(o)), view_.target(view_.next(h)));
      if (!is_free) {
        batch_.rest.push_back(h);
        continue;
      }
      is_claimed[left] = is_claimed[right] = true;
      flips_[batch_.flipped.size()] = flips_[at(i)];
      batch_.flipped.push_back(h);
    }
    flips_.resize(batch_.flipped.size());
  }

  const Change* flip_recorded() {
    Edit edit(mesh_);
    for (const HalfedgeId h : batch_.flipped) edit.flip(h);
    return *edit.done();
  }

  const Change* flip_all() {
    Edit edit(mesh_);  // an empty record that says so
    const kernels::FlipColumns columns = edit.flip_columns();
    par::for_each_range(
        execution_, static_cast<Index>(flips_.size()), kGrain,
        [&](IndexRange range) { kernels::scatter_flips(range, flips_.data(), columns); });
    return *edit.done();
  }

  EditMesh& mesh_;
  EditView view_;
  std::span<const HalfedgeId> wanted_;
  const Execution& execution_;
  std::vector<kernels::Flip> flips_;
  std::vector<char> is_possible_;
  FlipBatch batch_;
};

FlipBatch EditMesh::flip_batch(std::span<const HalfedgeId> wanted, const Execution& execution) {
  return FlipBatcher(*this, wanted, execution).run();
}

}  // namespace hedgerow
