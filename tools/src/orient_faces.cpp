#include "orient_faces.h"

#include <algorithm>

#include <fmt/format.h>

#include "hedgerow/orient.h"
#include "table.h"

namespace hedgerow::tool {
namespace {

// The first corner stays the first.
void turn_over(Soup& soup, Index f) {
  const auto i = static_cast<std::size_t>(f);
  const bool is_triangle = soup.offsets.empty();
  const std::size_t begin = is_triangle ? 3 * i : static_cast<std::size_t>(soup.offsets[i]);
  const std::size_t end = is_triangle ? 3 * i + 3 : static_cast<std::size_t>(soup.offsets[i + 1]);
  std::reverse(soup.corners.data() + begin + 1, soup.corners.data() + end);
}

// Patches end at crowded edges, and there alone: what becomes of these edges is no matter here.
Policies without_edges(Policies policies) {
  const Policies defaults;
  for (const DefectKind kind : {DefectKind::nonmanifold_edge, DefectKind::inconsistent_edge,
                                DefectKind::nonmanifold_vertex, DefectKind::isolated_vertex}) {
    policies[kind] = defaults[kind];
  }
  return policies;
}

}  // namespace

OrientedFaces orient_faces(const Run& run, const std::string& path, Soup& soup,
                           const Policies& policies) {
  OrientedFaces oriented;
  {
    const BuiltMesh built = build_mesh(run, path, soup, without_edges(policies));
    const Orientation found =
        find_orientation(built.mesh(), build_radial(built.mesh(), run.execution()));
    const auto input_face = [&](Index f) {
      const auto& new_to_old = built.output.faces_new_to_old;
      return new_to_old.empty() ? f : new_to_old[static_cast<std::size_t>(f)];
    };
    oriented.patch_count = found.patch_count;
    for (const Index f : found.flipped) oriented.turned.push_back(input_face(f));
    for (std::size_t i = 0; i + 1 < found.proof_first.size(); ++i) {
      auto& proof = oriented.proofs.emplace_back();
      for (Index k = found.proof_first[i]; k < found.proof_first[i + 1]; ++k) {
        proof.push_back(input_face(found.proof_faces[static_cast<std::size_t>(k)]));
      }
    }
  }
  // The mesh may view the corners, so not before it is gone.
  for (const Index f : oriented.turned) turn_over(soup, f);
  return oriented;
}

std::string text_of(const OrientedFaces& oriented) {
  std::string out = fmt::format("turned {} faces over, in {} patches\n",
                                grouped(static_cast<std::int64_t>(oriented.turned.size())),
                                grouped(oriented.patch_count));
  constexpr std::size_t kShown = 10;
  for (const auto& proof : oriented.proofs) {
    out += fmt::format(
        "no orientation: faces {}{}\n",
        fmt::join(proof.begin(),
                  proof.begin() + static_cast<std::ptrdiff_t>(std::min(kShown, proof.size())), " "),
        proof.size() > kShown ? fmt::format(" ... ({} in a cycle)", proof.size())
                              : std::string(" in a cycle"));
  }
  return out;
}

Json json_of(const OrientedFaces& oriented) {
  Json json;
  json["faces_turned"] = oriented.turned;
  json["patches"] = oriented.patch_count;
  json["nonorientable_patches"] = oriented.proofs.size();
  json["proofs"] = oriented.proofs;
  return json;
}

}  // namespace hedgerow::tool
