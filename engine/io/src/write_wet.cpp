#include <utility>

#include "compose.h"
#include "hedgerow/build.h"
#include "hedgerow/io/winged_edge.h"
#include "wet.h"

namespace hedgerow::io {

namespace {

tl::unexpected<Failure> cannot_hold(std::string why) {
  return failure(IoErrorCode::bad_mesh, 0, Place::none,
                 "winged-edge tables cannot hold it: " + std::move(why));
}

std::string text_of(const Error& error) {
  switch (error.code) {
    case ErrorCode::too_few_corners:
      return compose("face {} has {} corners", error.element, error.value);
    case ErrorCode::repeated_vertex:
      return compose("face {} has vertex {} more than once", error.element, error.value);
    case ErrorCode::nonmanifold_edge:
      return compose("half-edge {} is on an edge with {} half-edges", error.element, error.value);
    case ErrorCode::nonmanifold_vertex:
      return compose("the faces at vertex {} form {} groups, its record names one", error.element,
                     error.value);
    default:
      return compose("{} (element {}, value {}, limit {})", name(error.code), error.element,
                     error.value, error.limit);
  }
}

void write_id(Output& out, Index id) { out.number(std::int64_t{id} + 1); }

}  // namespace

void write_wet(const WingedEdgeTables& tables, Output& out) {
  out.text("wet 1\nvertices ");
  out.number(std::int64_t{tables.vertex_count()});
  out.text("\n");
  for (std::size_t v = 0; v < tables.vertex_edge.size(); ++v) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      out.number(tables.xyz[3 * v + axis]);
      out.character(' ');
    }
    write_id(out, tables.vertex_edge[v].value);
    out.character('\n');
  }
  out.text("faces ");
  out.number(std::int64_t{tables.face_count()});
  out.text("\n");
  for (const EdgeId e : tables.face_edge) {
    write_id(out, e.value);
    out.character('\n');
  }
  out.text("edges ");
  out.number(std::int64_t{tables.edge_count()});
  out.text("\n# start end prev_cw next_cw prev_ccw next_ccw face_cw face_ccw\n");
  for (const WingedEdge& edge : tables.edges) {
    const Index row[] = {edge.start.value,   edge.end.value,      edge.prev_cw.value,
                         edge.next_cw.value, edge.prev_ccw.value, edge.next_ccw.value,
                         edge.face_cw.value, edge.face_ccw.value};
    for (std::size_t c = 0; c < 8; ++c) {
      if (c > 0) out.character(' ');
      write_id(out, row[c]);
    }
    out.character('\n');
  }
}

Parsed<WingedEdgeTables> tables_of(const WriteInput& input) {
  FaceList faces = input.faces;
  faces.vertex_count = input.positions.count;
  BuildOptions options;
  // Nothing is left out in silence.
  for (const DefectKind kind :
       {DefectKind::too_few_corners, DefectKind::repeated_vertex, DefectKind::nonmanifold_edge}) {
    options.policies[kind] = Action::fail;
  }
  const Result<BuildOutput> built = build(faces, options, Execution::serial());
  if (!built) return cannot_hold(text_of(built.error()));
  Result<WingedEdgeTables> tables = build_winged_edges(built->mesh, input.positions);
  if (!tables) return cannot_hold(text_of(tables.error()));
  return std::move(*tables);
}

IoResult<WriteOutput> write_winged_edges(const std::filesystem::path& path,
                                         const WingedEdgeTables& tables,
                                         const WriteOptions& options) {
  if (tables.xyz.size() != 3 * tables.vertex_edge.size()) {
    return refuse(
        path, IoErrorCode::bad_mesh,
        compose("{} coordinates for {} vertices", tables.xyz.size(), tables.vertex_count()));
  }
  if (const std::vector<WingedFault> faults = check_winged_edges(tables); !faults.empty()) {
    const std::int64_t found = std::int64_t{faults.front().found} + 1;
    return refuse(path, IoErrorCode::bad_mesh, describe(faults.front(), compose("{}", found)));
  }
  IoResult<AtomicFile> file = AtomicFile::create(path, {options.durable});
  if (!file) return tl::unexpected<IoError>(std::move(file.error()));
  Output out(*file);
  write_wet(tables, out);
  if (IoResult<void> finished = out.finish(); !finished) {
    return tl::unexpected<IoError>(std::move(finished.error()));
  }
  WriteOutput report;
  report.byte_count = file->bytes_written();
  return report;
}

}  // namespace hedgerow::io
