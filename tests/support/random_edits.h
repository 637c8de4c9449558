#pragma once

#include <algorithm>
#include <vector>

#include "hedgerow/edit.h"
#include "support/random_faces.h"

namespace hedgerow::test {

enum class EditKind : int {
  flip,
  insert_vertex,
  split_edge,
  split_face,
  connect,
  join_faces,
  collapse,
  split_vertex,
  add_vertex,
  remove_vertex,
  add_face,
  remove_face,
  cut,
  zip,
};
inline constexpr int kEditKinds = 14;
inline constexpr const char* kEditNames[kEditKinds] = {
    "flip",       "insert_vertex", "split_edge",   "split_face", "connect",
    "join_faces", "collapse",      "split_vertex", "add_vertex", "remove_vertex",
    "add_face",   "remove_face",   "cut",          "zip"};

/// One edit with what it is asked of.
struct EditRequest {
  EditKind kind{};
  HalfedgeId h;
  HalfedgeId g;
  VertexId v;
  FaceId f;
  std::vector<VertexId> corners;
  std::vector<HalfedgeId> path;
};

inline EditResult do_edit(EditMesh& mesh, const EditRequest& request) {
  switch (request.kind) {
    case EditKind::flip:
      return mesh.flip(request.h);
    case EditKind::insert_vertex:
      return mesh.insert_vertex(request.h);
    case EditKind::split_edge:
      return mesh.split_edge(request.h);
    case EditKind::split_face:
      return mesh.split_face(request.f);
    case EditKind::connect:
      return mesh.connect(request.h, request.g);
    case EditKind::join_faces:
      return mesh.join_faces(request.h);
    case EditKind::collapse:
      return mesh.collapse(request.h);
    case EditKind::split_vertex:
      return mesh.split_vertex(request.h, request.g);
    case EditKind::add_vertex:
      return mesh.add_vertex();
    case EditKind::remove_vertex:
      return mesh.remove_vertex(request.v);
    case EditKind::add_face:
      return mesh.add_face(request.corners);
    case EditKind::remove_face:
      return mesh.remove_face(request.f);
    case EditKind::cut:
      return mesh.cut(request.path);
    case EditKind::zip:
      break;
  }
  return mesh.zip(request.h);
}

inline EditCheck can_edit(const EditMesh& mesh, const EditRequest& request) {
  switch (request.kind) {
    case EditKind::flip:
      return mesh.can_flip(request.h);
    case EditKind::insert_vertex:
      return mesh.can_insert_vertex(request.h);
    case EditKind::split_edge:
      return mesh.can_split_edge(request.h);
    case EditKind::split_face:
      return mesh.can_split_face(request.f);
    case EditKind::connect:
      return mesh.can_connect(request.h, request.g);
    case EditKind::join_faces:
      return mesh.can_join_faces(request.h);
    case EditKind::collapse:
      return mesh.can_collapse(request.h);
    case EditKind::split_vertex:
      return mesh.can_split_vertex(request.h, request.g);
    case EditKind::add_vertex:
      return mesh.can_add_vertex();
    case EditKind::remove_vertex:
      return mesh.can_remove_vertex(request.v);
    case EditKind::add_face:
      return mesh.can_add_face(request.corners);
    case EditKind::remove_face:
      return mesh.can_remove_face(request.f);
    case EditKind::cut:
      return mesh.can_cut(request.path);
    case EditKind::zip:
      break;
  }
  return mesh.can_zip(request.h);
}

/// Edges whose sides have no other face than these: those that go with them.
inline Index edges_of_only(const EditView& mesh, const std::vector<FaceId>& faces) {
  const auto goes = [&](HalfedgeId h) {
    const FaceId f = mesh.face(h);
    return !f.valid() || std::find(faces.begin(), faces.end(), f) != faces.end();
  };
  Index sides = 0;
  Index inner = 0;
  for (const FaceId f : faces) {
    for (const HalfedgeId h : halfedges(mesh, f)) {
      const HalfedgeId o = mesh.opposite[h];
      if (!goes(o)) continue;
      ++(mesh.face(o).valid() ? inner : sides);
    }
  }
  return sides + inner / 2;
}

/// By how much the edit will change vertices - edges + faces. \pre it will be done
inline Index euler_step(const EditMesh& edited, const EditRequest& request) {
  const EditView mesh = edited.view();
  const auto is_open = [&](VertexId v) {
    return std::ranges::any_of(outgoing_halfedges(mesh, v),
                               [&](HalfedgeId h) { return !mesh.face(h).valid(); });
  };
  switch (request.kind) {
    case EditKind::add_vertex:
      return 1;
    case EditKind::remove_face:
      return edges_of_only(mesh, {request.f}) - 1;
    case EditKind::remove_vertex: {
      std::vector<FaceId> faces;
      for (const HalfedgeId h : outgoing_halfedges(mesh, request.v)) {
        if (mesh.face(h).valid()) faces.push_back(mesh.face(h));
      }
      return edges_of_only(mesh, faces) - static_cast<Index>(faces.size()) - 1;
    }
    case EditKind::add_face: {
      Index step = 1;
      for (std::size_t i = 0; i < request.corners.size(); ++i) {
        const VertexId next = request.corners[(i + 1) % request.corners.size()];
        if (!edited.find(request.corners[i], next).valid()) --step;
      }
      return step;
    }
    case EditKind::cut: {
      // An edge each; a vertex each that is passed, of a ring all, and for each end that is open.
      const VertexId begin = mesh.origin[request.path.front()];
      const VertexId end = mesh.target(request.path.back());
      if (begin == end) return 0;
      return Index{-1} + (is_open(begin) ? 1 : 0) + (is_open(end) ? 1 : 0);
    }
    case EditKind::zip: {
      // An edge and a vertex go; of a hole of four edges, the other two become one as well, unless
      // they are the other sides of the two that are sewn.
      const HalfedgeId h = request.h;
      const HalfedgeId g = mesh.next(h);
      const bool is_path = mesh.opposite[h] == mesh.prev(h) && mesh.opposite[g] == mesh.next(g);
      return mesh.next(mesh.next(mesh.next(g))) == h && !is_path ? 1 : 0;
    }
    default:
      return 0;
  }
}

/// Thinks of edits at random, with elements that are there most of the time.
class EditPicker {
 public:
  EditPicker(const EditMesh& mesh, Random& random) : mesh_(mesh), random_(random) {}

  EditRequest pick() {
    EditRequest request;
    request.kind = static_cast<EditKind>(random_.below(kEditKinds));
    request.h = halfedge();
    switch (request.kind) {
      case EditKind::connect:
        request.g = along_face(request.h);
        break;
      case EditKind::split_vertex:
        request.g = round_vertex(request.h);
        break;
      case EditKind::remove_vertex:
        request.v = vertex();
        break;
      case EditKind::split_face:
      case EditKind::remove_face:
        request.f = face();
        break;
      case EditKind::add_face:
        request.corners = corners();
        break;
      case EditKind::cut:
        request.path = path(request.h);
        break;
      case EditKind::zip:
        request.h = boundary(request.h);
        break;
      default:
        break;
    }
    return request;
  }

 private:
  template <class Id>
  Id any(Index count) {
    for (int tries = 0; tries < 20 && count > 0; ++tries) {
      const Id id(random_.below(count));
      if (mesh_.has(id) || random_.one_in(50)) return id;
    }
    return Id(random_.one_in(2) ? Index{-1} : count);
  }
  HalfedgeId halfedge() { return any<HalfedgeId>(mesh_.halfedge_count()); }
  VertexId vertex() { return any<VertexId>(mesh_.vertex_count()); }
  FaceId face() { return any<FaceId>(mesh_.face_count()); }
  HalfedgeId along_face(HalfedgeId h) {
    if (!mesh_.has(h) || random_.one_in(20)) return halfedge();
    for (int steps = random_.below(6); steps > 0; --steps) h = mesh_.view().next(h);
    return h;
  }
  HalfedgeId round_vertex(HalfedgeId h) {
    if (!mesh_.has(h) || random_.one_in(20)) return halfedge();
    const EditView view = mesh_.view();
    for (int steps = random_.below(6); steps > 0; --steps) h = view.next(view.opposite[h]);
    return h;
  }
  HalfedgeId boundary(HalfedgeId h) {
    for (int tries = 0; tries < 30; ++tries) {
      if (mesh_.has(h) && !mesh_.view().face(h).valid()) return h;
      h = halfedge();
    }
    return h;
  }
  std::vector<HalfedgeId> path(HalfedgeId h) {
    std::vector<HalfedgeId> path;
    if (!mesh_.has(h)) return {h};
    for (int steps = 1 + random_.below(4); steps > 0; --steps) {
      path.push_back(h);
      if (!mesh_.has(h)) break;
      h = round_vertex(mesh_.view().next(h));
    }
    return path;
  }
  // Most often along a hole, where a face fits.
  std::vector<VertexId> corners() {
    const HalfedgeId start = boundary(halfedge());
    std::vector<VertexId> corners;
    if (mesh_.has(start) && !random_.one_in(3)) {
      HalfedgeId h = start;
      for (int n = 2 + random_.below(3); n > 0; --n, h = mesh_.view().next(h)) {
        corners.push_back(mesh_.view().origin[h]);
      }
      if (random_.one_in(2)) corners.push_back(vertex());
      return corners;
    }
    for (int n = 2 + random_.below(4); n > 0; --n) corners.push_back(vertex());
    return corners;
  }

  const EditMesh& mesh_;
  Random& random_;
};

}  // namespace hedgerow::test
