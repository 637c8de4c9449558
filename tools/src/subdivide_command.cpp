#include <cmath>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "before_after.h"
#include "clock.h"
#include "commands.h"
#include "failure.h"
#include "hedgerow/subdivide.h"
#include "machine.h"
#include "mesh_file.h"
#include "table.h"

namespace hedgerow::tool {
namespace {

struct SubdivideArguments {
  std::string input;
  std::string output;
  std::string scheme;
  int levels = 1;
};

SubdivisionScheme scheme_named(std::string_view word) {
  if (word == "loop") return SubdivisionScheme::loop;
  if (word == "sqrt3") return SubdivisionScheme::sqrt3;
  return SubdivisionScheme::catmull_clark;
}

// Refuses what this machine cannot hold: a system that promises more memory than it has would end
// the program in the middle. The finest level takes its columns and its positions, at least.
void check_memory(const Connectivity& mesh, const SubdivideArguments& arguments) {
  const double factor = scheme_named(arguments.scheme) == SubdivisionScheme::sqrt3 ? 3 : 4;
  const double halfedges =
      static_cast<double>(mesh.halfedge_count()) * std::pow(factor, arguments.levels);
  if (halfedges > static_cast<double>(kMaxCount)) return;  // the engine refuses it by that count
  const double needed = halfedges * (2 * sizeof(Index) + sizeof(float));
  const auto present = static_cast<double>(describe_machine().memory_bytes);
  if (present == 0 || needed <= present) return;
  constexpr double kGibibyte = 1 << 30;
  throw Failure{ExitStatus::limit,
                arguments.input,
                "out-of-memory",
                fmt::format("{} levels make {:.3g} half-edges, which take at least {:.0f} GiB of "
                            "memory; there are {:.0f}",
                            arguments.levels, halfedges, needed / kGibibyte, present / kGibibyte),
                {}};
}

ExitStatus subdivide_file(Run& run, const SubdivideArguments& arguments) {
  check_output_path(arguments.output);
  run.progress().begin(4);
  const OpenedMesh opened = open_mesh(run, arguments.input);
  check_memory(opened.mesh(), arguments);
  run.progress().step("subdividing");
  const Clock clock;
  Result<SubdivisionOutput> output =
      subdivide(opened.mesh(), opened.kept.positions(),
                {scheme_named(arguments.scheme), arguments.levels, {}}, run.execution());
  const double ms = clock.ms();
  if (!output) throw describe(output.error(), arguments.input);
  run.progress().step("writing");
  write_mesh(run, arguments.output, soup_of(output->mesh, std::move(output->positions)));

  if (run.is_text()) {
    run.print(fmt::format("{}\n{}: {} levels of {} in {}\n",
                          before_after_text(opened.mesh(), output->mesh, run.colour()),
                          arguments.output, arguments.levels, arguments.scheme, time_text(ms)));
    return ExitStatus::done;
  }
  Json json;
  json["input"] = arguments.input;
  json["output"] = arguments.output;
  json["scheme"] = arguments.scheme;
  json["levels"] = arguments.levels;
  json["before"] = counts_json(opened.mesh());
  json["after"] = counts_json(output->mesh);
  json["timings_ms"] = {
      {"read", opened.file.read_ms}, {"build", opened.built.build_ms}, {"subdivide", ms}};
  run.print_json(json);
  return ExitStatus::done;
}

}  // namespace

void add_subdivide(Program& program) {
  const auto arguments = std::make_shared<SubdivideArguments>();
  Command command =
      program.add_command("subdivide", "Refine a mesh and smooth it on the way",
                          "Loop and sqrt3 take triangles only. Prints the counts before and after.",
                          "hedgerow subdivide cube.obj ball.ply --scheme catmull-clark --levels 3",
                          [arguments](Run& run) { return subdivide_file(run, *arguments); });
  command.word("IN", arguments->input, "Mesh to read")
      .word("OUT", arguments->output, "Mesh to write")
      .choice("--scheme", {"loop", "catmull-clark", "sqrt3"}, arguments->scheme, "How to refine")
      .number("--levels", {0, 64}, arguments->levels, "How often; 0 copies the mesh");
}

}  // namespace hedgerow::tool
