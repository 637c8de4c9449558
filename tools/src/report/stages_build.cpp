#include <algorithm>

#include "hedgerow/build.h"
#include "hedgerow/validate.h"
#include "report/stages.h"
#include "report/timing.h"

namespace hedgerow::tool {
namespace {

Result<BuildOutput> build_subject(const Subject& subject, const Execution& execution) {
  BuildOptions options;
  options.borrow_corners = true;
  return build(subject.soup.face_list(), options, execution);
}

ColumnStorage copy_of(std::span<const Index> column) { return {Buffer<Index>::copy_of(column)}; }

/// The subject with one half-edge made its own opposite, which breaks I1.
Connectivity damaged_copy(const Connectivity& mesh, std::size_t halfedge) {
  ConnectivityColumns columns;
  columns.origin = copy_of(mesh.origin());
  columns.outgoing = copy_of(mesh.outgoing());
  Buffer<Index> opposite = Buffer<Index>::copy_of(mesh.opposite());
  opposite[halfedge] = static_cast<Index>(halfedge);
  columns.opposite = std::move(opposite);
  columns.fans = Buffer<FanStart>::copy_of(mesh.fans());
  const PolygonView view = mesh.polygons();
  columns.next = copy_of({view.next_of.data(), mesh.origin().size()});
  columns.face = copy_of({view.face_of.data(), mesh.origin().size()});
  columns.first = copy_of({view.first_of.data(), static_cast<std::size_t>(view.first_of.size())});
  columns.all_triangles = mesh.is_triangle_mesh();
  return Connectivity(std::move(columns));
}

bool finds_damage(const Subject& subject, const Execution& execution) {
  if (subject.halfedges() == 0) return true;
  const auto halfedge = static_cast<std::size_t>(subject.halfedges() / 2);
  const std::vector<Violation> violations =
      validate(damaged_copy(subject.explicit_mesh, halfedge), execution);
  return std::any_of(violations.begin(), violations.end(), [&](const Violation& violation) {
    return violation.invariant == 1 && violation.element == static_cast<Index>(halfedge);
  });
}

}  // namespace

void measure_build(Stages& stages, const Subject& subject) {
  const std::vector<Index>& expected = subject.reference.opposites();
  stages.run().progress().step("build, the other meshes");
  if (subject.pointer.opposite() != expected) stages.fail("build of the pointer mesh");
  if (subject.structs.opposite() != expected) stages.fail("build of the array-of-structs mesh");
  const FaceList faces = subject.soup.face_list();
  const Positions positions = subject.soup.positions();

  Stage stage{.name = "build"};
  stage.elements = subject.halfedges();
  stage.unit = "half-edge";
  // Corners in; opposite and outgoing out, and what a mesh of polygons stores beside them.
  constexpr std::int64_t kIndex = sizeof(Index);
  stage.bytes = kIndex * (2 * subject.halfedges() + subject.vertices());
  if (!subject.mesh.is_implicit()) {
    stage.bytes += kIndex * (2 * subject.halfedges() + 2 * subject.faces());
  }
  stage.mix = Mix::copy;
  stage.pointer_ms =
      time_median([&] { const baselines::PointerHalfedgeMesh mesh(faces, positions); }).ms;
  stage.aos_ms =
      time_median([&] { const baselines::StructHalfedgeMesh mesh(faces, positions); }).ms;
  stages.measure(
      std::move(stage),
      [&](const Execution& execution) {
        const Result<BuildOutput> output = build_subject(subject, execution);
        return output && std::ranges::equal(output->mesh.opposite(), expected) &&
               std::ranges::equal(output->mesh.outgoing(), subject.mesh.outgoing());
      },
      [&](const Execution& execution) {
        const Result<BuildOutput> output = build_subject(subject, execution);
      });
}

void measure_validate(Stages& stages, const Subject& subject) {
  Stage stage{.name = "validate"};
  stage.elements = subject.halfedges();
  stage.unit = "half-edge";
  stage.bytes = static_cast<std::int64_t>(subject.mesh.bytes());
  stage.mix = Mix::read;
  stages.measure(
      std::move(stage),
      [&](const Execution& execution) {
        return validate(subject.mesh, execution).empty() && finds_damage(subject, execution);
      },
      [&](const Execution& execution) {
        const std::vector<Violation> violations = validate(subject.mesh, execution);
      });
}

}  // namespace hedgerow::tool
