#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "clock.h"
#include "failure.h"
#include "hedgerow/normals.h"
#include "mesh_file.h"
#include "table.h"

namespace hedgerow::tool {

BuiltMesh build_mesh(const Run& run, const std::string& path, const Soup& soup,
                     const Policies& policies) {
  BuildOptions options;
  options.policies = policies;
  options.borrow_corners = true;
  const Clock clock;
  Result<BuildOutput> output = build(soup.face_list(), options, run.execution());
  const double build_ms = clock.ms();
  if (!output) throw describe(output.error(), path);
  return {std::move(*output), build_ms};
}

BuiltMesh build_mesh(const Run& run, const MeshFile& file) {
  return build_mesh(run, file.path, file.soup, run.options().policies);
}

void enforce_strict(const Run& run, const std::string& path, const BuildOutput& output) {
  if (!run.options().strict || output.defects.empty()) return;
  constexpr std::size_t kShown = 10;
  Failure failure{ExitStatus::defects,
                  path,
                  "defects",
                  fmt::format("the mesh has {} defects",
                              grouped(static_cast<std::int64_t>(output.defects.size()))),
                  {}};
  for (std::size_t i = 0; i < std::min(kShown, output.defects.size()); ++i) {
    const Defect& defect = output.defects[i];
    failure.details.push_back(fmt::format("{}: {}", name(defect.kind), defect_text(defect)));
  }
  if (output.defects.size() > kShown) failure.details.emplace_back("...");
  throw failure;
}

Buffer<float> kept_positions(const BuildOutput& output, const Buffer<float>& positions) {
  const std::span<const Index> new_to_old = output.vertices_new_to_old.span();
  Buffer<float> kept(3 * new_to_old.size());
  for (std::size_t v = 0; v < new_to_old.size(); ++v) {
    std::copy_n(positions.data() + 3 * static_cast<std::size_t>(new_to_old[v]), 3,
                kept.data() + 3 * v);
  }
  return kept;
}

Soup soup_of(const Connectivity& mesh, Buffer<float> xyz) {
  Soup soup;
  soup.xyz = std::move(xyz);
  soup.corners = Buffer<Index>::copy_of(mesh.origin());
  const FaceList faces = face_list(mesh);
  if (!faces.is_triangles()) {
    soup.offsets =
        Buffer<Index>::copy_of({faces.offsets, static_cast<std::size_t>(faces.face_count) + 1});
  }
  return soup;
}

Soup kept_soup(const BuildOutput& output, const Buffer<float>& positions) {
  return soup_of(output.mesh, output.vertices_new_to_old.empty()
                                  ? Buffer<float>::copy_of(positions.span())
                                  : kept_positions(output, positions));
}

OpenedMesh open_mesh(Run& run, const std::string& path) {
  OpenedMesh opened;
  run.progress().step("reading");
  opened.file = read_mesh(run, path);
  run.progress().step("building");
  opened.built = build_mesh(run, opened.file);
  enforce_strict(run, path, opened.built.output);
  opened.kept = kept_soup(opened.built.output, opened.file.soup.xyz);
  return opened;
}

std::string defect_text(const Defect& defect) {
  switch (defect.kind) {
    case DefectKind::out_of_range:
      return fmt::format("face {} refers to vertex {}", defect.face.value, defect.value);
    case DefectKind::too_few_corners:
      return fmt::format("face {} has {} corners", defect.face.value, defect.value);
    case DefectKind::repeated_vertex:
      return fmt::format("face {} has vertex {} more than once", defect.face.value,
                         defect.vertex.value);
    case DefectKind::duplicate_face:
      return fmt::format("face {} has the vertices of face {}", defect.face.value, defect.value);
    case DefectKind::nonmanifold_edge:
      return fmt::format("edge {}-{} has {} half-edges; the first is {} in face {}",
                         defect.vertex.value, defect.other.value, defect.value,
                         defect.halfedge.value, defect.face.value);
    case DefectKind::inconsistent_edge:
      return fmt::format(
          "edge {}-{} has two half-edges that run the same way; the first is {} in "
          "face {}",
          defect.vertex.value, defect.other.value, defect.halfedge.value, defect.face.value);
    case DefectKind::nonmanifold_vertex:
      return fmt::format("the faces at vertex {} form {} groups", defect.vertex.value,
                         defect.value);
    case DefectKind::isolated_vertex:
      return fmt::format("vertex {} is on no face", defect.vertex.value);
  }
  return {};
}

Json defect_json(const Defect& defect) {
  Json json;
  json["kind"] = name(defect.kind);
  if (defect.face.valid()) json["face"] = defect.face.value;
  if (defect.halfedge.valid()) json["halfedge"] = defect.halfedge.value;
  if (defect.vertex.valid()) json["vertex"] = defect.vertex.value;
  if (defect.other.valid()) json["other"] = defect.other.value;
  switch (defect.kind) {
    case DefectKind::out_of_range:
      json["index"] = defect.value;
      break;
    case DefectKind::too_few_corners:
      json["corners"] = defect.value;
      break;
    case DefectKind::duplicate_face:
      json["earlier_face"] = defect.value;
      break;
    case DefectKind::nonmanifold_edge:
    case DefectKind::inconsistent_edge:
      json["halfedges"] = defect.value;
      break;
    case DefectKind::nonmanifold_vertex:
      json["groups"] = defect.value;
      break;
    case DefectKind::repeated_vertex:
    case DefectKind::isolated_vertex:
      break;
  }
  return json;
}

}  // namespace hedgerow::tool
