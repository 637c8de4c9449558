// hedgerow/subdivide.h.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "hedgerow/subdivide.h"
#include "hedgerow/validate.h"
#include "runner.h"

namespace hedgerow::bench {

namespace {

/// Half-edges of the result for each of the input, all of them triangles.
double growth(SubdivisionScheme scheme) {
  // A quad for each; four triangles for one; three for one.
  return scheme == SubdivisionScheme::sqrt3 ? 3 : 4;
}

/// What is wrong with a result; "": nothing.
std::string find_fault(const Dataset& data, const SubdivisionOutput& output,
                       SubdivisionScheme scheme) {
  const double expected = growth(scheme) * counts_of(data).halfedges;
  if (static_cast<double>(output.mesh.halfedge_count()) != expected) {
    return "another number of half-edges; not measured";
  }
  if (!validate(output.mesh, Execution::serial()).empty()) return "not a sound mesh; not measured";
  const bool is_finite =
      std::ranges::all_of(output.positions, [](float x) { return std::isfinite(x); });
  return is_finite ? "" : "a vertex is nowhere; not measured";
}

Work prepare(const Dataset& data, const Execution& execution, SubdivisionScheme scheme) {
  auto output = std::make_shared<SubdivisionOutput>();
  Work work;
  work.run = [&data, execution, scheme, output] {
    SubdivisionOptions options;
    options.scheme = scheme;
    auto result = subdivide(data.mesh, data.positions(), options, execution);
    if (result) *output = std::move(*result);
  };
  work.cleanup = [output] { *output = {}; };
  work.check = [&data, output, scheme] { return find_fault(data, *output, scheme); };
  work.digest = [output] { return digest_of(output->mesh); };
  const double halfedges = growth(scheme) * counts_of(data).halfedges;
  work.notes = [halfedges]() -> Notes { return {{"output_halfedges", halfedges}}; };
  return work;
}

/// Reads the mesh and its points, and writes those of the result: a vertex for each face and edge,
/// or for each edge, or for each face.
Traffic traffic(const Dataset& data, SubdivisionScheme scheme) {
  const auto [halfedges, vertices, faces] = counts_of(data);
  const bool is_quads = scheme == SubdivisionScheme::catmull_clark;
  const double edges = halfedges / 2;
  const double more = scheme == SubdivisionScheme::sqrt3 ? faces : edges + (is_quads ? faces : 0);
  const double columns = is_quads ? 4 : 2;  // next and face are stored of quads
  return {kIndexBytes * (2 * halfedges + vertices) + kPointBytes * vertices,
          kIndexBytes * columns * growth(scheme) * halfedges +
              (kIndexBytes + kPointBytes) * (vertices + more)};
}

}  // namespace

void add_subdivide(const Plan& plan) {
  if (plan.planar.empty()) return;
  constexpr std::pair<const char*, SubdivisionScheme> kSchemes[] = {
      {"catmull-clark", SubdivisionScheme::catmull_clark},
      {"loop", SubdivisionScheme::loop},
      {"sqrt3", SubdivisionScheme::sqrt3}};
  const std::int64_t size = plan.is_smoke ? 200 : 1'000'000;
  for (const char* order : {"grid", "scan"}) {
    for (const auto& [variant, scheme] : kSchemes) {
      for (const int threads : plan.threads) {
        add({"subdivide",
             {order, size, ""},
             threads,
             variant,
             [scheme = scheme](const Dataset& data, const Execution& execution) {
               return prepare(data, execution, scheme);
             },
             [scheme = scheme](const Dataset& data) { return traffic(data, scheme); },
             Mix::copy});
      }
    }
  }
}

}  // namespace hedgerow::bench
