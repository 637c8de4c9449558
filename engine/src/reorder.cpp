// The columns are permuted, not built again: a build would pair anew what the policies of the first
// build have cut, and is no faster. See D11 in engine/DESIGN.md.

#include "hedgerow/reorder.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>
#include <vector>

#include "float3_check.h"
#include "kernels/gather_reordered.h"
#include "kernels/materialise.h"
#include "parallel/parallel.h"
#include "reorder/orders.h"

namespace hedgerow {

namespace {

constexpr Index kReorderGrain = 1 << 14;  // elements a task
// Half-edges that are worth a thread's array of all vertices.
constexpr Index kOutgoingShare = 1 << 18;

bool needs_positions(ReorderMethod method) {
  return method == ReorderMethod::hilbert || method == ReorderMethod::morton ||
         method == ReorderMethod::fronts;
}

Buffer<Index> inverse_of(const Buffer<Index>& permutation, const Execution& execution) {
  Buffer<Index> inverse(permutation.size());
  par::for_each_range(execution, static_cast<Index>(permutation.size()), kReorderGrain,
                      [&](IndexRange range) {
                        kernels::scatter_inverse(range, permutation.data(), inverse.data());
                      });
  return inverse;
}

Reordering choose_order(const Connectivity& mesh, const Positions& positions, ReorderMethod method,
                        const Execution& execution) {
  Reordering order;
  switch (method) {
    case ReorderMethod::hilbert:
      order.vertices_new_to_old =
          detail::hilbert_vertices(positions, mesh.vertex_count(), execution);
      break;
    case ReorderMethod::morton:
      order.vertices_new_to_old =
          detail::morton_vertices(positions, mesh.vertex_count(), execution);
      break;
    case ReorderMethod::breadth_first:
      order.vertices_new_to_old = detail::breadth_first_vertices(mesh);
      break;
    case ReorderMethod::vertex_cache:
      order.faces_new_to_old = detail::vertex_cache_faces(mesh);
      order.vertices_new_to_old = detail::vertices_by_first_use(mesh, order.faces_new_to_old);
      break;
    case ReorderMethod::fronts:
      order.vertices_new_to_old =
          detail::vertices_by_cells(positions, mesh.vertex_count(), execution, 0);
      break;
  }
  order.vertices_old_to_new = inverse_of(order.vertices_new_to_old, execution);
  if (method != ReorderMethod::vertex_cache) {
    order.faces_new_to_old =
        detail::faces_by_smallest_vertex(mesh, order.vertices_old_to_new, execution);
  }
  return order;
}

// The new mesh, column by column.
template <Topology OldMesh>
class Renumbering {
 public:
  Renumbering(const OldMesh& mesh, const Reordering& order, bool is_triangles,
              const Execution& execution)
      : mesh_(mesh), order_(order), is_triangles_(is_triangles), execution_(execution) {}

  Connectivity run() {
    number_faces();
    gather_columns();
    ConnectivityColumns columns;
    if (is_triangles_) {
      start_fans(TriangleView{column<VertexId>(origin_), column<HalfedgeId>(opposite_), {}, {}});
    } else {
      fill_next_and_face();
      start_fans(PolygonView{column<VertexId>(origin_),
                             column<HalfedgeId>(opposite_),
                             {},
                             column<HalfedgeId>(next_),
                             column<FaceId>(face_),
                             {first_.data(), static_cast<Index>(first_.size())},
                             {}});
    }
    columns.origin = std::move(origin_);
    columns.opposite = std::move(opposite_);
    columns.outgoing = std::move(outgoing_);
    columns.next = std::move(next_);
    columns.face = std::move(face_);
    columns.first = std::move(first_);
    columns.fans = Buffer<FanStart>::copy_of(fans_);
    columns.all_triangles = is_triangles_;
    return Connectivity(std::move(columns));
  }

 private:
  template <class Value>
  static Column<HalfedgeId, Value> column(const Buffer<Index>& values) {
    return {values.data(), static_cast<Index>(values.size())};
  }

  void number_faces() {
    if (!is_triangles_) {
      first_ = Buffer<Index>(order_.faces_new_to_old.size() + 1);
      Index h = 0;
      for (std::size_t f = 0; f < order_.faces_new_to_old.size(); ++f) {
        first_[f] = h;
        h += mesh_.degree(FaceId(order_.faces_new_to_old[f]));
      }
      first_[order_.faces_new_to_old.size()] = h;
    }
    faces_old_to_new_ = inverse_of(order_.faces_new_to_old, execution_);
  }

  [[nodiscard]] kernels::HalfedgeMap<OldMesh> halfedge_map() const {
    return {mesh_, faces_old_to_new_.data(), first_.data()};
  }

  void gather_columns() {
    origin_ = Buffer<Index>(static_cast<std::size_t>(mesh_.halfedge_count()));
    opposite_ = Buffer<Index>(origin_.size());
    const auto map = halfedge_map();
    par::for_each_range(execution_, mesh_.face_count(), kReorderGrain, [&](IndexRange faces) {
      kernels::gather_origins(faces, mesh_, order_.faces_new_to_old.data(), map,
                              order_.vertices_old_to_new.data(), origin_.data());
    });
    par::for_each_range(execution_, mesh_.face_count(), kReorderGrain, [&](IndexRange faces) {
      kernels::gather_opposites(faces, mesh_, order_.faces_new_to_old.data(), map,
                                opposite_.data());
    });
  }

  void fill_next_and_face() {
    next_ = Buffer<Index>(origin_.size());
    face_ = Buffer<Index>(origin_.size());
    par::for_each_range(execution_, mesh_.face_count(), kReorderGrain, [&](IndexRange faces) {
      kernels::fill_polygon_columns(faces, first_.data(), next_.data(), face_.data());
    });
  }

  // Each thread looks at its share of the half-edges, and the first share that knows a vertex has
  // its smallest one.
  void find_smallest_outgoing() {
    const Index share_count = par::share_count(execution_, mesh_.halfedge_count(), kOutgoingShare);
    std::vector<Buffer<Index>> smallest;
    for (Index i = 0; i < share_count; ++i) {
      smallest.emplace_back(static_cast<std::size_t>(mesh_.vertex_count()));
    }
    par::for_each_task(execution_, share_count, [&](Index share, Index) {
      Buffer<Index>& own = smallest[static_cast<std::size_t>(share)];
      std::fill(own.begin(), own.end(), kInvalidIndex);
      const IndexRange halfedges = par::share_of(share, share_count, mesh_.halfedge_count());
      kernels::scatter_smallest_outgoing(halfedges, origin_.data(), own.data());
    });
    par::for_each_range(execution_, mesh_.vertex_count(), kReorderGrain, [&](IndexRange range) {
      for (std::size_t i = 1; i < smallest.size(); ++i) {
        kernels::gather_missing_outgoing(range, smallest[i].data(), smallest[0].data());
      }
    });
    outgoing_ = std::move(smallest[0]);
  }

  template <Topology Mesh>
  void start_fans(const Mesh& mesh) {
    find_smallest_outgoing();
    par::for_each_range(execution_, mesh.halfedge_count(), kReorderGrain, [&](IndexRange range) {
      kernels::scatter_open_starts(range, mesh, mesh_.fans, order_.vertices_new_to_old.data(),
                                   outgoing_.data());
    });
    sort_fans(mesh);
  }

  // At the few vertices with several fans, the one with the smallest half-edge goes first.
  template <Topology Mesh>
  void sort_fans(const Mesh& mesh) {
    struct VertexFan {
      VertexId vertex;
      kernels::Fan fan;
    };
    std::vector<VertexFan> found;
    const auto map = halfedge_map();
    const auto add = [&](VertexId v, HalfedgeId start) {
      found.push_back({v, kernels::find_fan(mesh, start)});
    };
    VertexId last_old;
    for (const FanStart& old : mesh_.fans) {
      const VertexId v(order_.vertices_old_to_new[static_cast<std::size_t>(old.vertex.value)]);
      if (old.vertex != last_old) {
        add(v, HalfedgeId(map(mesh_.outgoing[old.vertex])));
      }
      last_old = old.vertex;
      add(v, HalfedgeId(map(old.start)));
    }
    std::sort(found.begin(), found.end(), [](const VertexFan& a, const VertexFan& b) {
      return std::tuple(a.vertex, a.fan.smallest) < std::tuple(b.vertex, b.fan.smallest);
    });
    VertexId last;
    for (const VertexFan& f : found) {
      if (f.vertex != last) {
        outgoing_[static_cast<std::size_t>(f.vertex.value)] = f.fan.start.value;
      } else {
        fans_.push_back({f.vertex, f.fan.start});
      }
      last = f.vertex;
    }
  }

  const OldMesh& mesh_;
  const Reordering& order_;
  bool is_triangles_;
  const Execution& execution_;
  Buffer<Index> faces_old_to_new_;
  Buffer<Index> origin_;
  Buffer<Index> opposite_;
  Buffer<Index> outgoing_;
  Buffer<Index> next_;
  Buffer<Index> face_;
  Buffer<Index> first_;
  std::vector<FanStart> fans_;
};

Connectivity renumbered(const Connectivity& mesh, const Reordering& order,
                        const Execution& execution) {
  return mesh.visit([&](const auto& view) {
    return Renumbering(view, order, mesh.is_triangle_mesh(), execution).run();
  });
}

// What each half-edge of the new mesh was.
Buffer<Index> old_halfedges(const Connectivity& mesh, const Connectivity& new_mesh,
                            const Buffer<Index>& faces_new_to_old, const Execution& execution) {
  Buffer<Index> halfedges(static_cast<std::size_t>(mesh.halfedge_count()));
  mesh.visit([&](const auto& view) {
    const Index* first =
        new_mesh.is_triangle_mesh() ? nullptr : new_mesh.polygons().first_of.data();
    par::for_each_range(execution, view.face_count(), kReorderGrain, [&](IndexRange faces) {
      kernels::gather_halfedges(faces, view, faces_new_to_old.data(), first, halfedges.data());
    });
  });
  return halfedges;
}

// inner[outer[i]] for every i, in place of `outer`.
void look_up(Buffer<Index>& outer, const Buffer<Index>& inner, const Execution& execution) {
  par::for_each_range(
      execution, static_cast<Index>(outer.size()), kReorderGrain,
      [&](IndexRange range) { kernels::gather_composed(range, inner.data(), outer.data()); });
}

// A search hops between neighbours, so they are brought together first; then it is quick.
Connectivity renumbered_by_fronts(const Connectivity& mesh, const Positions& positions,
                                  Reordering& order, const Execution& execution) {
  Reordering near = choose_order(mesh, positions, ReorderMethod::fronts, execution);
  const Connectivity near_mesh = renumbered(mesh, near, execution);
  detail::VertexNumbers vertices = detail::front_vertices(near_mesh);
  order.faces_new_to_old = detail::faces_by_two_vertices(near_mesh, vertices.old_to_new, execution);
  order.vertices_new_to_old = std::move(vertices.new_to_old);
  order.vertices_old_to_new = std::move(vertices.old_to_new);
  Connectivity result = renumbered(near_mesh, order, execution);
  look_up(order.vertices_new_to_old, near.vertices_new_to_old, execution);
  look_up(order.faces_new_to_old, near.faces_new_to_old, execution);
  order.vertices_old_to_new = inverse_of(order.vertices_new_to_old, execution);
  return result;
}

}  // namespace

Result<ReorderOutput> reorder(const Connectivity& mesh, Positions positions, ReorderMethod method,
                              const Execution& execution) {
  if (mesh.form() != Form::open) return fail({ErrorCode::already_closed});
  if (needs_positions(method)) {
    if (auto ok = detail::check_float3(positions, mesh.vertex_count()); !ok) {
      return fail(ok.error());
    }
  }
  ReorderOutput output;
  output.before = locality(mesh);
  if (method == ReorderMethod::fronts) {
    output.mesh = renumbered_by_fronts(mesh, positions, output.reordering, execution);
  } else {
    output.reordering = choose_order(mesh, positions, method, execution);
    output.mesh = renumbered(mesh, output.reordering, execution);
  }
  output.reordering.halfedges_new_to_old =
      old_halfedges(mesh, output.mesh, output.reordering.faces_new_to_old, execution);
  output.after = locality(output.mesh);
  return output;
}

}  // namespace hedgerow
