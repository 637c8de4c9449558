#pragma once

#include <concepts>
#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "hedgerow/corner_table.h"
#include "hedgerow/directed_edge.h"
#include "hedgerow/positions.h"
#include "hedgerow/topology.h"
#include "representations/walked_mesh.h"

namespace hedgerow::bench {

/// Steps on any `Topology`, by number; on a `FaceTopology`, those that need no vertex.
template <FaceTopology View, bool is_closed>
class TopologyWalk {
 public:
  using Handle = HalfedgeId;
  static constexpr bool kIsClosed = is_closed;
  static constexpr bool kIsInRows =
      std::same_as<View, TriangleView> || std::same_as<View, PolygonView> ||
      std::same_as<View, DirectedEdgeView> || std::same_as<View, CornerTableView>;

  TopologyWalk(const View& view, Positions positions) : view_(view), positions_(positions) {}

  static bool is_valid(Handle h) noexcept { return h.valid(); }
  [[nodiscard]] Handle next(Handle h) const noexcept { return view_.next(h); }
  [[nodiscard]] Handle prev(Handle h) const noexcept { return view_.prev(h); }
  [[nodiscard]] Handle opposite(Handle h) const noexcept { return view_.opposite[h]; }
  [[nodiscard]] Index origin(Handle h) const noexcept { return view_.origin[h].value; }
  [[nodiscard]] Index target(Handle h) const noexcept { return view_.target(h).value; }
  [[nodiscard]] Index face(Handle h) const noexcept { return view_.face(h).value; }
  [[nodiscard]] Index degree(Handle h) const noexcept { return view_.degree(view_.face(h)); }
  [[nodiscard]] const float* position(Handle h) const noexcept {
    return positions_[view_.origin[h].value];
  }
  [[nodiscard]] Index vertex_count() const noexcept { return view_.vertex_count(); }
  [[nodiscard]] Index face_count() const noexcept { return view_.face_count(); }
  [[nodiscard]] Handle outgoing(Index v) const noexcept { return view_.outgoing[VertexId(v)]; }

  // Where the half-edges of a face are in a row, nobody would ask for the next one.
  template <class Visit>
  void for_each_side(Index f, const Visit& visit) const {
    const Handle start = view_.first(FaceId(f));
    if constexpr (kIsInRows) {
      const Index end = start.value + view_.degree(FaceId(f));
      for (Handle h = start; h.value < end; ++h.value) visit(h);
    } else {
      Handle h = start;
      do {
        visit(h);
        h = view_.next(h);
      } while (h != start);
    }
  }
  template <class Visit>
  void for_each_halfedge(const Visit& visit) const {
    for (Index h = 0; h < view_.halfedge_count(); ++h) {
      if (exists(HalfedgeId(h))) visit(HalfedgeId(h));
    }
  }
  template <class Visit>
  void for_each_edge(const Visit& visit) const {
    for_each_halfedge([&](Handle h) {
      const Handle across = view_.opposite[h];
      if (!across.valid() || h < across) visit(h);
    });
  }

  class Marks {
   public:
    explicit Marks(const TopologyWalk& walk)
        : is_in_(static_cast<std::size_t>(walk.view_.halfedge_count()), false) {}
    bool insert(Handle h) {
      const bool was_in = is_in_[static_cast<std::size_t>(h.value)];
      is_in_[static_cast<std::size_t>(h.value)] = true;
      return !was_in;
    }

   private:
    std::vector<bool> is_in_;
  };

 private:
  [[nodiscard]] bool exists(Handle h) const noexcept {
    if constexpr (requires {
                    { view_.has(h) } -> std::same_as<bool>;
                  })
      return view_.has(h);
    return true;
  }

  View view_;
  Positions positions_;
};

/// A representation that owns records and is walked through a view of them.
template <class Records, Topology View, bool is_closed>
class ViewedMesh final : public Representation {
 public:
  /// \pre view_of(records) is a `View` of them
  template <class ViewOf>
  ViewedMesh(Records&& records, std::size_t bytes, Positions positions, const ViewOf& view_of)
      : records_(std::make_unique<Records>(std::move(records))),
        bytes_(bytes),
        walk_(view_of(*records_), positions),
        normals_(3 * static_cast<std::size_t>(positions.count)) {}

  [[nodiscard]] std::size_t bytes() const override { return bytes_; }
  [[nodiscard]] std::optional<std::uint64_t> answer(Question question) const override {
    return Walked(walk_).answer(question);
  }
  void compute_vertex_normals() override {
    Walked(walk_).fill_vertex_normals([&](Index v, baselines::detail::Vector normal) {
      baselines::detail::store(normal, normals_.data() + 3 * v);
    });
  }
  [[nodiscard]] std::vector<float> vertex_normals() const override { return normals_; }

 private:
  std::unique_ptr<Records> records_;  // the view keeps its address
  std::size_t bytes_;
  TopologyWalk<View, is_closed> walk_;
  std::vector<float> normals_;
};

template <Topology View, bool is_closed, class Records>
std::unique_ptr<Representation> viewed(Records&& records, std::size_t bytes, Positions positions) {
  using Mesh = ViewedMesh<std::remove_cvref_t<Records>, View, is_closed>;
  return std::make_unique<Mesh>(std::forward<Records>(records), bytes, positions,
                                [](const auto& owned) { return View(owned); });
}

}  // namespace hedgerow::bench
