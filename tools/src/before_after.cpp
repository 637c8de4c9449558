#include "before_after.h"

#include <fmt/format.h>

#include "table.h"

namespace hedgerow::tool {

Json counts_json(const Connectivity& mesh) {
  return {{"vertices", mesh.vertex_count()},
          {"faces", mesh.face_count()},
          {"halfedges", mesh.halfedge_count()}};
}

std::string before_after_text(const Connectivity& before, const Connectivity& after, bool colour) {
  Table table({{"elements", Table::Align::left}, {"before"}, {"after"}});
  const auto add = [&](const char* what, Index old_count, Index new_count) {
    table.add({what, fmt::format("{}", old_count), fmt::format("{}", new_count)});
  };
  add("vertices", before.vertex_count(), after.vertex_count());
  add("faces", before.face_count(), after.face_count());
  add("half-edges", before.halfedge_count(), after.halfedge_count());
  return table.text(colour);
}

}  // namespace hedgerow::tool
