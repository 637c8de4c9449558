// Many edits at once: those that do not meet are done together.
#include <algorithm>
#include <tuple>
#include <utility>

#include "edit/edit.h"
#include "kernels/flip_edges.h"
#include "parallel/parallel.h"

namespace hedgerow {
namespace {

constexpr Index kGrain = 1 << 12;  // flips a task

/// The edge that a flip makes.
struct NewEdge {
  VertexId low;
  VertexId high;
  Index place;  // among those that were wanted

  [[nodiscard]] bool is_same(const NewEdge& other) const noexcept {
    return low == other.low && high == other.high;
  }
  friend bool operator<(const NewEdge& a, const NewEdge& b) noexcept {
    return std::tie(a.low, a.high, a.place) < std::tie(b.low, b.high, b.place);
  }
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
    drop_equal_edges();
    FlipBatch batch;
    for (const Index i : rest_) batch.rest.push_back(wanted_[at(i)]);
    for (const Index i : refused_) batch.refused.push_back(wanted_[at(i)]);
    for (const Index i : chosen_) batch.flipped.push_back(wanted_[at(i)]);
    batch.change = mesh_.is_recording_ ? flip_recorded() : flip_all();
    return batch;
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

  // In their order, each unless one before it has claimed a face of its two.
  void choose() {
    std::vector<bool> is_claimed(at(view_.face_count()));
    for (Index i = 0; i < count(); ++i) {
      if (is_possible_[at(i)] == 0) {
        refused_.push_back(i);
        continue;
      }
      const HalfedgeId h = wanted_[at(i)];
      const std::size_t left = at(view_.face(h).value);
      const std::size_t right = at(view_.face(view_.opposite[h]).value);
      if (is_claimed[left] || is_claimed[right]) {
        rest_.push_back(i);
      } else {
        is_claimed[left] = is_claimed[right] = true;
        chosen_.push_back(i);
      }
    }
  }

  // Two flips far apart may join the same two vertices: the first of them does.
  void drop_equal_edges() {
    std::vector<NewEdge> edges;
    edges.reserve(chosen_.size());
    for (const Index i : chosen_) {
      const HalfedgeId h = wanted_[at(i)];
      const VertexId c = view_.target(view_.next(view_.opposite[h]));
      const VertexId d = view_.target(view_.next(h));
      edges.push_back({std::min(c, d), std::max(c, d), i});
    }
    std::sort(edges.begin(), edges.end());
    std::vector<Index> dropped;
    for (std::size_t k = 1; k < edges.size(); ++k) {
      if (edges[k].is_same(edges[k - 1])) dropped.push_back(edges[k].place);
    }
    if (dropped.empty()) return;
    std::sort(dropped.begin(), dropped.end());
    std::erase_if(chosen_,
                  [&](Index i) { return std::binary_search(dropped.begin(), dropped.end(), i); });
    rest_.insert(rest_.end(), dropped.begin(), dropped.end());
    std::sort(rest_.begin(), rest_.end());
  }

  const Change* flip_recorded() {
    Edit edit(mesh_);
    for (const Index i : chosen_) edit.flip(wanted_[at(i)]);
    return *edit.done();
  }

  const Change* flip_all() {
    Edit edit(mesh_);  // an empty record that says so
    std::vector<kernels::Flip> flips;
    flips.reserve(chosen_.size());
    for (const Index i : chosen_) flips.push_back(flips_[at(i)]);
    const kernels::FlipColumns columns{
        mesh_.origin_.data(),   mesh_.next_.data(),  mesh_.prev_.data(),    mesh_.face_.data(),
        mesh_.outgoing_.data(), mesh_.first_.data(), mesh_.opposite_.data()};
    par::for_each_range(
        execution_, static_cast<Index>(flips.size()), kGrain,
        [&](IndexRange range) { kernels::scatter_flips(range, flips.data(), columns); });
    return *edit.done();
  }

  EditMesh& mesh_;
  EditView view_;
  std::span<const HalfedgeId> wanted_;
  const Execution& execution_;
  std::vector<kernels::Flip> flips_;
  std::vector<char> is_possible_;
  std::vector<Index> chosen_;
  std::vector<Index> rest_;
  std::vector<Index> refused_;
};

FlipBatch EditMesh::flip_batch(std::span<const HalfedgeId> wanted, const Execution& execution) {
  return FlipBatcher(*this, wanted, execution).run();
}

}  // namespace hedgerow
