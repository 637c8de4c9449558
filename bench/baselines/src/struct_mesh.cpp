#include "baselines/struct_mesh.h"

#include <algorithm>
#include <compare>

#include "baselines/src/ring_algorithms.h"

namespace hedgerow::baselines {

namespace {

/// A half-edge under the smaller and larger vertex of its edge.
struct EdgeRecord {
  Index smaller;
  Index larger;
  Index h;

  friend auto operator<=>(const EdgeRecord&, const EdgeRecord&) noexcept = default;
};

}  // namespace

StructHalfedgeMesh::StructHalfedgeMesh(const FaceList& faces, Positions positions) {
  vertices_.resize(static_cast<std::size_t>(faces.vertex_count));
  for (Index v = 0; v < faces.vertex_count; ++v) {
    Vertex& vertex = vertices_[static_cast<std::size_t>(v)];
    std::copy_n(positions[v], 3, vertex.position);
    vertex.halfedge = kInvalidIndex;
  }
  make_faces(faces);
  pair_opposites();
  choose_outgoing();
}

void StructHalfedgeMesh::make_faces(const FaceList& faces) {
  const auto* corners = static_cast<const Index*>(faces.corners);
  faces_.resize(static_cast<std::size_t>(faces.face_count));
  halfedges_.resize(static_cast<std::size_t>(faces.corner_count()));
  for (Index f = 0; f < faces.face_count; ++f) {
    const IndexRange range = faces.corner_range(f);
    faces_[static_cast<std::size_t>(f)].halfedge = range.begin;
    for (Index h = range.begin; h < range.end; ++h) {
      halfedges_[static_cast<std::size_t>(h)] = {corners[h], kInvalidIndex,
                                                 h + 1 == range.end ? range.begin : h + 1, f};
    }
  }
}

void StructHalfedgeMesh::pair_opposites() {
  const auto at = [this](Index h) -> Halfedge& { return halfedges_[static_cast<std::size_t>(h)]; };
  std::vector<EdgeRecord> records(halfedges_.size());
  for (Index h = 0; h < halfedge_count(); ++h) {
    const auto [smaller, larger] = std::minmax(at(h).origin, at(at(h).next).origin);
    records[static_cast<std::size_t>(h)] = {smaller, larger, h};
  }
  std::ranges::sort(records);
  for (std::size_t i = 0; i < records.size();) {
    std::size_t end = i + 1;
    while (end < records.size() && records[end].smaller == records[i].smaller &&
           records[end].larger == records[i].larger) {
      ++end;
    }
    const Index h = records[i].h;
    const Index g = records[end - 1].h;
    if (end - i == 2 && at(h).origin != at(g).origin) {
      at(h).opposite = g;
      at(g).opposite = h;
    }
    i = end;
  }
}

void StructHalfedgeMesh::choose_outgoing() {
  const StructWalk walk(*this);
  const auto is_start = [&](Index h) { return !StructWalk::is_valid(walk.opposite(walk.prev(h))); };
  for (Index h = 0; h < halfedge_count(); ++h) {
    Index& outgoing = vertices_[static_cast<std::size_t>(walk.origin(h))].halfedge;
    if (outgoing == kInvalidIndex || (is_start(h) && !is_start(outgoing))) outgoing = h;
  }
}

void StructHalfedgeMesh::compute_face_normals() {
  const StructWalk walk(*this);
  for (Face& face : faces_) {
    const detail::Vector area = detail::area_vector(walk, face.halfedge);
    detail::store(detail::normalized(area), face.normal);
    face.double_area = detail::length(area);
  }
}

void StructHalfedgeMesh::compute_vertex_normals(NormalWeight weight) {
  const StructWalk walk(*this);
  for (Vertex& vertex : vertices_) {
    detail::store(detail::vertex_normal(walk, vertex.halfedge, weight), vertex.normal);
  }
}

void StructHalfedgeMesh::fill_one_ring_sums(std::span<std::uint32_t> sums) const {
  const StructWalk walk(*this);
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    sums[v] = detail::one_ring_sum(walk, vertices_[v].halfedge);
  }
}

Index StructHalfedgeMesh::boundary_loop_count() const {
  const StructWalk walk(*this);
  std::vector<bool> is_seen(halfedges_.size(), false);
  Index loops = 0;
  for (Index h = 0; h < halfedge_count(); ++h) {
    if (StructWalk::is_valid(walk.opposite(h)) || is_seen[static_cast<std::size_t>(h)]) continue;
    ++loops;
    Index g = h;
    do {
      is_seen[static_cast<std::size_t>(g)] = true;
      g = detail::next_boundary(walk, g);
    } while (g != h);
  }
  return loops;
}

Index StructHalfedgeMesh::component_count() const {
  const StructWalk walk(*this);
  detail::Sets sets(vertices_.size());
  for (Index h = 0; h < halfedge_count(); ++h) {
    sets.unite(walk.origin(h), walk.origin(walk.next(h)));
  }
  Index components = 0;
  for (Index v = 0; v < vertex_count(); ++v) {
    const bool is_isolated = vertices_[static_cast<std::size_t>(v)].halfedge == kInvalidIndex;
    if (!is_isolated && sets.find(v) == v) ++components;
  }
  return components;
}

std::vector<Index> StructHalfedgeMesh::origin() const {
  std::vector<Index> origin;
  origin.reserve(halfedges_.size());
  for (const Halfedge& h : halfedges_) origin.push_back(h.origin);
  return origin;
}

std::vector<Index> StructHalfedgeMesh::opposite() const {
  std::vector<Index> opposite;
  opposite.reserve(halfedges_.size());
  for (const Halfedge& h : halfedges_) opposite.push_back(h.opposite);
  return opposite;
}

std::vector<Index> StructHalfedgeMesh::outgoing() const {
  std::vector<Index> outgoing;
  outgoing.reserve(vertices_.size());
  for (const Vertex& vertex : vertices_) outgoing.push_back(vertex.halfedge);
  return outgoing;
}

std::vector<float> StructHalfedgeMesh::face_normals() const {
  std::vector<float> normals;
  for (const Face& face : faces_) {
    normals.insert(normals.end(), std::begin(face.normal), std::end(face.normal));
  }
  return normals;
}

std::vector<float> StructHalfedgeMesh::vertex_normals() const {
  std::vector<float> normals;
  for (const Vertex& vertex : vertices_) {
    normals.insert(normals.end(), std::begin(vertex.normal), std::end(vertex.normal));
  }
  return normals;
}

std::size_t StructHalfedgeMesh::bytes() const noexcept {
  return vertices_.size() * sizeof(Vertex) + halfedges_.size() * sizeof(Halfedge) +
         faces_.size() * sizeof(Face);
}

}  // namespace hedgerow::baselines
