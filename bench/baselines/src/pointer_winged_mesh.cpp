#include "baselines/pointer_winged_mesh.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "baselines/src/at.h"
#include "baselines/src/edge_map.h"
#include "baselines/src/ring_algorithms.h"

namespace hedgerow::baselines {

namespace {

using Side = PointerWingedEdgeMesh::Side;

struct SideHash {
  std::size_t operator()(Side s) const noexcept {
    return std::hash<const void*>{}(s.edge) ^ static_cast<std::size_t>(s.is_ccw);
  }
};

/// The corner after c in its face.
std::vector<Index> next_corners(const FaceList& faces) {
  std::vector<Index> next(at(static_cast<Index>(faces.corner_count())));
  for (Index f = 0; f < faces.face_count; ++f) {
    const IndexRange range = faces.corner_range(f);
    for (Index c = range.begin; c < range.end; ++c) {
      next[at(c)] = c + 1 == range.end ? range.begin : c + 1;
    }
  }
  return next;
}

/// The half-edge across each half-edge that has exactly one, running the other way.
std::vector<Index> pair_corners(const Index* corners, const std::vector<Index>& next) {
  std::vector<Index> opposite(next.size(), kInvalidIndex);
  detail::EdgeMap<Index> edges;
  edges.reserve(next.size() / 2 + 1);
  for (Index c = 0; c < static_cast<Index>(next.size()); ++c) {
    const auto [smaller, larger] = std::minmax(corners[c], corners[next[at(c)]]);
    auto& edge = edges[{smaller, larger}];
    ++edge.count;
    if (edge.count == 1) {
      edge.first = c;
    } else if (edge.count == 2 && corners[edge.first] != corners[c]) {
      opposite[at(edge.first)] = c;
      opposite[at(c)] = edge.first;
    } else if (Index& across = opposite[at(edge.first)]; across != kInvalidIndex) {
      // A third half-edge: which two belong together would be a guess.
      opposite[at(across)] = kInvalidIndex;
      across = kInvalidIndex;
    }
  }
  return opposite;
}

}  // namespace

PointerWingedEdgeMesh::PointerWingedEdgeMesh(const FaceList& faces, Positions positions) {
  vertices_.reserve(static_cast<std::size_t>(faces.vertex_count));
  for (Index v = 0; v < faces.vertex_count; ++v) {
    vertices_.push_back(std::make_unique<Vertex>());
    std::copy_n(positions[v], 3, vertices_.back()->position);
    vertices_.back()->id = v;
  }
  faces_.reserve(static_cast<std::size_t>(faces.face_count));
  for (Index f = 0; f < faces.face_count; ++f) {
    faces_.push_back(std::make_unique<Face>());
    faces_.back()->id = f;
  }
  make_edges(faces, pair_corners(static_cast<const Index*>(faces.corners), next_corners(faces)));
  choose_edges_of_vertices();
}

void PointerWingedEdgeMesh::make_edges(const FaceList& faces, const std::vector<Index>& opposite) {
  const auto* corners = static_cast<const Index*>(faces.corners);
  const std::vector<Index> next = next_corners(faces);
  std::vector<Edge*> edge_of(opposite.size(), nullptr);
  for (Index c = 0; c < static_cast<Index>(opposite.size()); ++c) {
    const Index across = opposite[at(c)];
    if (across != kInvalidIndex && across < c) {
      edge_of[at(c)] = edge_of[at(across)];
      continue;
    }
    edges_.push_back(std::make_unique<Edge>());
    edges_.back()->start = vertices_[at(corners[c])].get();
    edges_.back()->end = vertices_[at(corners[next[at(c)]])].get();
    edge_of[at(c)] = edges_.back().get();
  }
  for (Index f = 0; f < faces.face_count; ++f) {
    const IndexRange range = faces.corner_range(f);
    faces_[at(f)]->edge = edge_of[at(range.begin)];
    for (Index c = range.begin; c < range.end; ++c) {
      Edge& edge = *edge_of[at(c)];
      Edge& following = *edge_of[at(next[at(c)])];
      const bool is_ccw = opposite[at(c)] != kInvalidIndex && opposite[at(c)] < c;
      const Index after = next[at(c)];
      const bool is_next_ccw = opposite[at(after)] != kInvalidIndex && opposite[at(after)] < after;
      (is_ccw ? edge.ccw_face : edge.cw_face) = faces_[at(f)].get();
      (is_ccw ? edge.next_ccw : edge.next_cw) = &following;
      (is_next_ccw ? following.prev_ccw : following.prev_cw) = &edge;
    }
  }
}

void PointerWingedEdgeMesh::choose_edges_of_vertices() {
  const auto is_start = [](Side s) {
    return !WingedWalk::is_valid(WingedWalk::opposite(WingedWalk::prev(s)));
  };
  for (const Side s : sides()) {
    Vertex& vertex = *vertices_[at(WingedWalk::origin(s))];
    const bool is_better =
        vertex.edge == nullptr || (is_start(s) && !is_start(WingedWalk::outgoing(vertex)));
    if (is_better) vertex.edge = const_cast<Edge*>(s.edge);
  }
}

void PointerWingedEdgeMesh::compute_face_normals() {
  for (const auto& face : faces_) {
    const detail::Vector area = detail::area_vector(WingedWalk{}, WingedWalk::first(*face));
    detail::store(detail::normalized(area), face->normal);
    face->double_area = detail::length(area);
  }
}

void PointerWingedEdgeMesh::compute_vertex_normals(NormalWeight weight) {
  for (const auto& vertex : vertices_) {
    detail::store(detail::vertex_normal(WingedWalk{}, WingedWalk::outgoing(*vertex), weight),
                  vertex->normal);
  }
}

void PointerWingedEdgeMesh::fill_one_ring_sums(std::span<std::uint32_t> sums) const {
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    sums[v] = detail::one_ring_sum(WingedWalk{}, WingedWalk::outgoing(*vertices_[v]));
  }
}

Index PointerWingedEdgeMesh::boundary_loop_count() const {
  std::unordered_set<Side, SideHash> seen;
  Index loops = 0;
  for (const auto& edge : edges_) {
    const Side start{edge.get(), false};
    if (WingedWalk::is_valid(WingedWalk::opposite(start)) || seen.contains(start)) continue;
    ++loops;
    Side s = start;
    do {
      seen.insert(s);
      s = detail::next_boundary(WingedWalk{}, s);
    } while (!(s == start));
  }
  return loops;
}

Index PointerWingedEdgeMesh::component_count() const {
  detail::Sets sets(vertices_.size());
  for (const auto& edge : edges_) sets.unite(edge->start->id, edge->end->id);
  return static_cast<Index>(std::ranges::count_if(vertices_, [&](const auto& vertex) {
    return vertex->edge != nullptr && sets.find(vertex->id) == vertex->id;
  }));
}

/// All sides with a face, face by face.
std::vector<Side> PointerWingedEdgeMesh::sides() const {
  std::vector<Side> sides;
  sides.reserve(2 * edges_.size());
  for (const auto& face : faces_) {
    const Side start = WingedWalk::first(*face);
    Side s = start;
    do {
      sides.push_back(s);
      s = WingedWalk::next(s);
    } while (!(s == start));
  }
  return sides;
}

std::vector<Index> PointerWingedEdgeMesh::origin() const {
  std::vector<Index> origin;
  for (const Side s : sides()) origin.push_back(WingedWalk::origin(s));
  return origin;
}

namespace {

using SideNumbers = std::unordered_map<Side, Index, SideHash>;

SideNumbers number(const std::vector<Side>& sides) {
  SideNumbers numbers;
  numbers.reserve(sides.size() + 1);
  for (const Side s : sides) numbers.emplace(s, static_cast<Index>(numbers.size()));
  numbers.emplace(Side{}, kInvalidIndex);
  return numbers;
}

}  // namespace

std::vector<Index> PointerWingedEdgeMesh::opposite() const {
  const std::vector<Side> all = sides();
  const SideNumbers numbers = number(all);
  std::vector<Index> opposite;
  for (const Side s : all) opposite.push_back(numbers.at(WingedWalk::opposite(s)));
  return opposite;
}

std::vector<Index> PointerWingedEdgeMesh::outgoing() const {
  const SideNumbers numbers = number(sides());
  std::vector<Index> outgoing;
  for (const auto& vertex : vertices_)
    outgoing.push_back(numbers.at(WingedWalk::outgoing(*vertex)));
  return outgoing;
}

std::vector<float> PointerWingedEdgeMesh::face_normals() const {
  std::vector<float> normals;
  for (const auto& face : faces_) {
    normals.insert(normals.end(), std::begin(face->normal), std::end(face->normal));
  }
  return normals;
}

std::vector<float> PointerWingedEdgeMesh::vertex_normals() const {
  std::vector<float> normals;
  for (const auto& vertex : vertices_) {
    normals.insert(normals.end(), std::begin(vertex->normal), std::end(vertex->normal));
  }
  return normals;
}

std::size_t PointerWingedEdgeMesh::bytes() const noexcept {
  return vertices_.size() * (sizeof(Vertex) + sizeof(Vertex*)) +
         edges_.size() * (sizeof(Edge) + sizeof(Edge*)) +
         faces_.size() * (sizeof(Face) + sizeof(Face*));
}

}  // namespace hedgerow::baselines
