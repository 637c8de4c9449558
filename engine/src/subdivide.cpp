#include "hedgerow/subdivide.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "float3_check.h"
#include "hedgerow/boundary.h"
#include "subdivide/level.h"
#include "triangle_mesh.h"

namespace hedgerow {

namespace {

using subdivision::Level;
using subdivision::refine_quads;
using subdivision::refine_quarters;
using subdivision::refine_thirds;

Result<SubdivisionOutput> refine(const Level& level, SubdivisionScheme scheme, int number,
                                 const Execution& execution) {
  switch (scheme) {
    case SubdivisionScheme::loop:
      return refine_quarters(detail::triangles_of(*level.mesh), level, execution);
    case SubdivisionScheme::sqrt3:
      return refine_thirds(detail::triangles_of(*level.mesh), level, number % 2 == 1, execution);
    case SubdivisionScheme::catmull_clark:
      break;
  }
  return refine_quads(level, execution);
}

Index face_halfedge_count(const Connectivity& mesh) noexcept {
  if (mesh.form() == Form::open) return mesh.halfedge_count();
  const PolygonView view = mesh.polygons();
  return view.first_of[FaceId(view.face_count())].value;
}

Result<void> check_input(const Connectivity& mesh, const Positions& positions,
                         const SubdivisionOptions& options) {
  const bool is_sqrt3 = options.scheme == SubdivisionScheme::sqrt3;
  if (options.scheme != SubdivisionScheme::catmull_clark) {
    if (const Result<void> all = detail::check_triangles(mesh); !all) return all;
  }
  const auto given = static_cast<std::int64_t>(options.sharpness.size());
  const std::int64_t needed = is_sqrt3 ? 0 : face_halfedge_count(mesh);
  if (given != 0 && given != needed) {
    return fail({ErrorCode::count_mismatch, kInvalidIndex, given, needed});
  }
  std::int64_t halfedges = face_halfedge_count(mesh);
  for (int i = 0; i < options.levels && halfedges > 0; ++i) {
    const std::int64_t factor = is_sqrt3 ? 3 : 4;
    if (halfedges > kMaxCount / factor) {
      const bool is_told = halfedges <= std::numeric_limits<std::int64_t>::max() / factor;
      const std::int64_t asked =
          is_told ? halfedges * factor : std::numeric_limits<std::int64_t>::max();
      return fail({ErrorCode::too_many_elements, kInvalidIndex, asked, kMaxCount});
    }
    halfedges *= factor;
  }
  return detail::check_float3(positions, mesh.vertex_count());
}

Connectivity copy_of(const Connectivity& mesh) {
  ConnectivityColumns columns;
  columns.form = mesh.form();
  columns.all_triangles = mesh.is_triangle_mesh();
  columns.origin = Buffer<Index>::copy_of(mesh.origin());
  columns.opposite = Buffer<Index>::copy_of(mesh.opposite());
  columns.outgoing = Buffer<Index>::copy_of(mesh.outgoing());
  columns.fans = Buffer<FanStart>::copy_of(mesh.fans());
  if (mesh.is_explicit()) {
    const PolygonView view = mesh.polygons();
    const auto copy = [](const auto& column) {
      return Buffer<Index>::copy_of({column.data(), at(column.size())});
    };
    columns.next = copy(view.next_of);
    columns.face = copy(view.face_of);
    columns.first = copy(view.first_of);
  }
  return Connectivity(std::move(columns));
}

SubdivisionOutput copy_of(const Connectivity& mesh, const Positions& positions,
                          std::span<const float> sharpness) {
  SubdivisionOutput output{copy_of(mesh), Buffer<float>(3 * at(mesh.vertex_count())),
                           Buffer<float>::copy_of(sharpness)};
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    std::copy_n(positions[v], 3, output.positions.data() + 3 * at(v));
  }
  return output;
}

}  // namespace

Result<SubdivisionOutput> subdivide(const Connectivity& mesh, const Positions& positions,
                                    const SubdivisionOptions& options, const Execution& execution) {
  HEDGEROW_ASSERT(options.levels >= 0);
  if (const Result<void> sound = check_input(mesh, positions, options); !sound) {
    return fail(sound.error());
  }
  if (options.levels <= 0) return copy_of(mesh, positions, options.sharpness);
  Connectivity opened;
  Level level{&mesh, positions, options.sharpness.empty() ? nullptr : options.sharpness.data()};
  if (mesh.form() == Form::closed) {
    Result<Connectivity> open = open_boundary(mesh, execution);
    if (!open) return fail(open.error());
    opened = std::move(*open);
    level.mesh = &opened;
  }
  SubdivisionOutput output;
  for (int i = 0; i < options.levels; ++i) {
    Result<SubdivisionOutput> finer = refine(level, options.scheme, i, execution);
    if (!finer) return finer;
    output = std::move(*finer);
    level = {&output.mesh,
             {output.positions.data(), output.mesh.vertex_count()},
             output.sharpness.empty() ? nullptr : output.sharpness.data()};
  }
  if (mesh.form() == Form::closed) {
    Result<Connectivity> closed = close_boundary(output.mesh, execution);
    if (!closed) return fail(closed.error());
    output.mesh = std::move(*closed);
  }
  return output;
}

}  // namespace hedgerow
