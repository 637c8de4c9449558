#include <algorithm>

#include "hedgerow/normals.h"
#include "kernels/face_normals.h"
#include "normals_check.h"
#include "parallel/parallel.h"

namespace hedgerow {

namespace {

constexpr Index kFaceNormalGrain = 1 << 14;  // faces a task
constexpr Index kCornerGrain = 1 << 16;      // corners a task of the index check

Result<void> check_indices(const kernels::FaceSource& faces, const Execution& execution) {
  const auto limit = faces.list.vertex_count;
  const auto corner_count = static_cast<Index>(faces.list.corner_count());
  const bool is_bad = par::reduce<bool>(
      execution.with_grain(0), corner_count, kCornerGrain,
      [&](IndexRange corners) {
        const kernels::CornerBounds bounds = kernels::corner_bounds(corners, faces);
        return bounds.smallest < 0 || bounds.largest >= limit;
      },
      [](bool a, bool b) { return a || b; });
  if (is_bad) return fail(detail::find_bad_index(faces));
  return {};
}

NormalStats run(const kernels::FaceSource& faces, Positions positions, NormalsOut out,
                const NormalOptions& options, const Execution& execution) {
  const kernels::Points points{positions};
  const kernels::NormalWriter writer =
      detail::normal_writer(out, faces.face_count(), options.degenerate);
  return par::reduce<NormalStats>(
      execution, faces.face_count(), kFaceNormalGrain,
      [&](IndexRange range) {
        return kernels::face_normals(range, faces, points, options.polygon, writer);
      },
      kernels::merge);
}

}  // namespace

Result<NormalStats> face_normals(const FaceList& faces, Positions positions, NormalsOut out,
                                 const NormalOptions& options, const Execution& execution) {
  if (auto ok = check(faces); !ok) return fail(ok.error());
  if (auto ok = detail::check_arrays(positions, faces.vertex_count, out, faces.face_count); !ok) {
    return fail(ok.error());
  }
  const kernels::FaceSource source(faces);
  if (auto ok = check_indices(source, execution); !ok) return fail(ok.error());
  return run(source, positions, out, options, execution);
}

Result<NormalStats> face_normals(const Connectivity& mesh, Positions positions, NormalsOut out,
                                 const NormalOptions& options, const Execution& execution) {
  const FaceList faces = face_list(mesh);
  if (auto ok = detail::check_arrays(positions, faces.vertex_count, out, faces.face_count); !ok) {
    return fail(ok.error());
  }
  return run(kernels::FaceSource(faces), positions, out, options, execution);
}

FaceList face_list(const Connectivity& mesh) noexcept {
  FaceList faces;
  faces.corners = mesh.origin().data();
  faces.face_count = mesh.face_count();
  faces.vertex_count = mesh.vertex_count();
  if (mesh.is_triangle_mesh()) {
    faces.stride_bytes = 3 * sizeof(Index);
  } else {
    faces.stride_bytes = sizeof(Index);
    // A mesh without any column has no faces and needs no offsets.
    static constexpr Index kNoFaces[1] = {0};
    faces.offsets = mesh.is_explicit() ? mesh.polygons().first_of.data() : kNoFaces;
  }
  return faces;
}

float angle_between(float cross_length, float dot) noexcept {
  return kernels::angle_of(cross_length, dot);
}

}  // namespace hedgerow
