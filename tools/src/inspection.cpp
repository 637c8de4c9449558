#include "inspection.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "clock.h"
#include "failure.h"
#include "hedgerow/digest.h"
#include "hedgerow/validate.h"
#include "machine.h"

namespace hedgerow::tool {
namespace {

constexpr std::size_t kListedDefects = 100;

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json valence_json(const std::optional<Valence>& valence) {
  Json json;
  json["min"] = valence ? Json(valence->min) : Json(nullptr);
  json["max"] = valence ? Json(valence->max) : Json(nullptr);
  json["mean"] = valence ? Json(valence->mean) : Json(nullptr);
  return json;
}

}  // namespace

Inspection inspect_mesh(const Run& run, const MeshFile& file, BuiltMesh& built) {
  const Execution execution = run.execution();
  Inspection inspection;
  const Clock clock;
  inspection.violation_count = static_cast<std::int64_t>(validate(built.mesh(), execution).size());
  inspection.validate_ms = clock.ms();
  inspection.summary = summarise(built.mesh(), execution);
  inspection.degenerate_faces = count_degenerate_faces(built.output.stats, run.options().policies);
  const Buffer<float> moved = kept_positions(built.output, file.soup.xyz);
  const Result<std::int64_t> zero_area = count_zero_area_faces(
      built.mesh(),
      {moved.empty() ? file.soup.xyz.data() : moved.data(), built.mesh().vertex_count()},
      execution);
  if (!zero_area) throw describe(zero_area.error(), file.path);
  inspection.zero_area_faces = *zero_area;
  inspection.defects = std::move(built.output.defects);
  inspection.connectivity_bytes = static_cast<std::int64_t>(built.mesh().bytes());
  inspection.read_ms = file.read_ms;
  inspection.build_ms = built.build_ms;
  inspection.digest = digest(built.mesh(), execution);
  inspection.peak_bytes = peak_resident_bytes();
  return inspection;
}

Json inspection_json(const Inspection& inspection) {
  const Summary& summary = inspection.summary;
  Json defects = Json::array();
  for (std::size_t i = 0; i < std::min(kListedDefects, inspection.defects.size()); ++i) {
    defects.push_back(defect_json(inspection.defects[i]));
  }
  Json json;
  json["vertices"] = summary.vertices;
  json["faces"] = summary.faces;
  json["triangles"] = summary.triangles;
  json["quads"] = summary.quads;
  json["polygons"] = summary.polygons;
  json["degenerate_faces"] = inspection.degenerate_faces;
  json["zero_area_faces"] = inspection.zero_area_faces;
  json["duplicate_faces"] = summary.duplicate_faces;
  json["halfedges"] = summary.halfedges;
  json["edges"] = summary.edge_counts.edges;
  json["boundary_edges"] = summary.edge_counts.boundary;
  json["nonmanifold_edges"] = summary.edge_counts.nonmanifold;
  json["inconsistent_edges"] = summary.edge_counts.inconsistent;
  json["isolated_vertices"] = summary.isolated_vertices;
  json["nonmanifold_vertices"] = summary.nonmanifold_vertices;
  json["components"] = summary.components;
  json["euler"] = summary.euler;
  json["boundary_loops"] = or_null(summary.boundary_loops);
  json["genus"] = or_null(summary.genus);
  json["closed"] = summary.is_closed();
  json["manifold"] = summary.is_manifold();
  json["oriented"] = summary.is_oriented();
  json["valence"] = valence_json(summary.valence);
  json["bytes"] = {{"connectivity", inspection.connectivity_bytes},
                   {"peak", inspection.peak_bytes}};
  json["timings_ms"] = {{"read", inspection.read_ms},
                        {"build", inspection.build_ms},
                        {"validate", inspection.validate_ms}};
  json["defects"] = std::move(defects);
  json["defects_total"] = inspection.defects.size();
  json["digest"] = fmt::format("{:016x}", inspection.digest);
  return json;
}

}  // namespace hedgerow::tool
