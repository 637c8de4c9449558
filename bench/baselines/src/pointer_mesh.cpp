#include "baselines/pointer_mesh.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "baselines/src/edge_map.h"
#include "baselines/src/ring_algorithms.h"

namespace hedgerow::baselines {

namespace {

using Halfedge = PointerHalfedgeMesh::Halfedge;

}  // namespace

PointerHalfedgeMesh::PointerHalfedgeMesh(const FaceList& faces, Positions positions) {
  make_vertices(positions, faces.vertex_count);
  make_faces(faces);
  pair_opposites();
  choose_outgoing();
}

void PointerHalfedgeMesh::make_vertices(Positions positions, std::int64_t count) {
  vertices_.reserve(static_cast<std::size_t>(count));
  for (Index v = 0; v < count; ++v) {
    auto vertex = std::make_unique<Vertex>();
    std::copy_n(positions[v], 3, vertex->position);
    vertex->id = v;
    vertices_.push_back(std::move(vertex));
  }
}

void PointerHalfedgeMesh::make_faces(const FaceList& faces) {
  const auto* corners = static_cast<const Index*>(faces.corners);
  faces_.reserve(static_cast<std::size_t>(faces.face_count));
  halfedges_.reserve(static_cast<std::size_t>(faces.corner_count()));
  for (Index f = 0; f < faces.face_count; ++f) {
    auto face = std::make_unique<Face>();
    face->id = f;
    const IndexRange range = faces.corner_range(f);
    Halfedge* prev = nullptr;
    for (Index i = range.begin; i < range.end; ++i) {
      auto h = std::make_unique<Halfedge>();
      h->vertex = vertices_[static_cast<std::size_t>(corners[i])].get();
      h->face = face.get();
      h->prev = prev;
      if (prev != nullptr) prev->next = h.get();
      if (face->halfedge == nullptr) face->halfedge = h.get();
      prev = h.get();
      halfedges_.push_back(std::move(h));
    }
    prev->next = face->halfedge;
    face->halfedge->prev = prev;
    faces_.push_back(std::move(face));
  }
}

void PointerHalfedgeMesh::pair_opposites() {
  detail::EdgeMap<Halfedge*> edges;
  edges.reserve(halfedges_.size() / 2 + 1);
  for (const auto& h : halfedges_) {
    const auto [smaller, larger] = std::minmax(h->vertex->id, h->next->vertex->id);
    auto& edge = edges[{smaller, larger}];
    ++edge.count;
    if (edge.count == 1) {
      edge.first = h.get();
    } else if (edge.count == 2 && edge.first->vertex != h->vertex) {
      edge.first->opposite = h.get();
      h->opposite = edge.first;
    } else if (edge.first->opposite != nullptr) {
      // A third half-edge: which two belong together would be a guess.
      edge.first->opposite->opposite = nullptr;
      edge.first->opposite = nullptr;
    }
  }
}

void PointerHalfedgeMesh::choose_outgoing() {
  for (const auto& h : halfedges_) {
    Vertex& vertex = *h->vertex;
    const bool is_start = h->prev->opposite == nullptr;
    if (vertex.halfedge == nullptr) {
      vertex.halfedge = h.get();
    } else if (is_start && vertex.halfedge->prev->opposite != nullptr) {
      vertex.halfedge = h.get();
    }
  }
}

void PointerHalfedgeMesh::compute_face_normals() {
  for (const auto& face : faces_) {
    const detail::Vector area = detail::area_vector(HalfedgeWalk{}, face->halfedge);
    detail::store(detail::normalized(area), face->normal);
    face->double_area = detail::length(area);
  }
}

void PointerHalfedgeMesh::compute_vertex_normals(NormalWeight weight) {
  for (const auto& vertex : vertices_) {
    detail::store(detail::vertex_normal(HalfedgeWalk{}, vertex->halfedge, weight), vertex->normal);
  }
}

void PointerHalfedgeMesh::fill_one_ring_sums(std::span<std::uint32_t> sums) const {
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    sums[v] = detail::one_ring_sum(HalfedgeWalk{}, vertices_[v]->halfedge);
  }
}

Index PointerHalfedgeMesh::boundary_loop_count() const {
  std::unordered_set<const Halfedge*> seen;
  Index loops = 0;
  for (const auto& h : halfedges_) {
    if (h->opposite != nullptr || seen.contains(h.get())) continue;
    ++loops;
    const Halfedge* g = h.get();
    do {
      seen.insert(g);
      g = detail::next_boundary(HalfedgeWalk{}, g);
    } while (g != h.get());
  }
  return loops;
}

Index PointerHalfedgeMesh::component_count() const {
  detail::Sets sets(vertices_.size());
  for (const auto& h : halfedges_) sets.unite(h->vertex->id, h->next->vertex->id);
  return static_cast<Index>(std::ranges::count_if(vertices_, [&](const auto& vertex) {
    return vertex->halfedge != nullptr && sets.find(vertex->id) == vertex->id;
  }));
}

std::vector<Index> PointerHalfedgeMesh::origin() const {
  std::vector<Index> origin;
  origin.reserve(halfedges_.size());
  for (const auto& h : halfedges_) origin.push_back(h->vertex->id);
  return origin;
}

namespace {

using HalfedgeNumbers = std::unordered_map<const Halfedge*, Index>;

HalfedgeNumbers number(const std::vector<std::unique_ptr<Halfedge>>& halfedges) {
  HalfedgeNumbers numbers;
  numbers.reserve(halfedges.size() + 1);
  for (const auto& h : halfedges) numbers.emplace(h.get(), static_cast<Index>(numbers.size()));
  numbers.emplace(nullptr, kInvalidIndex);
  return numbers;
}

}  // namespace

std::vector<Index> PointerHalfedgeMesh::opposite() const {
  const HalfedgeNumbers numbers = number(halfedges_);
  std::vector<Index> opposite;
  opposite.reserve(halfedges_.size());
  for (const auto& h : halfedges_) opposite.push_back(numbers.at(h->opposite));
  return opposite;
}

std::vector<Index> PointerHalfedgeMesh::outgoing() const {
  const HalfedgeNumbers numbers = number(halfedges_);
  std::vector<Index> outgoing;
  outgoing.reserve(vertices_.size());
  for (const auto& vertex : vertices_) outgoing.push_back(numbers.at(vertex->halfedge));
  return outgoing;
}

std::vector<float> PointerHalfedgeMesh::face_normals() const {
  std::vector<float> normals;
  for (const auto& face : faces_) {
    normals.insert(normals.end(), std::begin(face->normal), std::end(face->normal));
  }
  return normals;
}

std::vector<float> PointerHalfedgeMesh::vertex_normals() const {
  std::vector<float> normals;
  for (const auto& vertex : vertices_) {
    normals.insert(normals.end(), std::begin(vertex->normal), std::end(vertex->normal));
  }
  return normals;
}

std::size_t PointerHalfedgeMesh::bytes() const noexcept {
  return vertices_.size() * (sizeof(Vertex) + sizeof(Vertex*)) +
         halfedges_.size() * (sizeof(Halfedge) + sizeof(Halfedge*)) +
         faces_.size() * (sizeof(Face) + sizeof(Face*));
}

}  // namespace hedgerow::baselines
