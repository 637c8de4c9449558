#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "before_after.h"
#include "clock.h"
#include "commands.h"
#include "failure.h"
#include "hedgerow/decimate.h"
#include "mesh_file.h"
#include "table.h"

namespace hedgerow::tool {
namespace {

struct DecimateArguments {
  std::string input;
  std::string output;
  std::int64_t faces = 0;
  std::string order = "queue";
};

const char* end_name(DecimateEnd end) { return end == DecimateEnd::faces ? "faces" : "refused"; }

std::string report_text(const Run& run, const DecimateArguments& arguments,
                        const Connectivity& before, const DecimateOutput& output, double ms) {
  std::string text = fmt::format("{}\n{}: {} collapses in {}\n",
                                 before_after_text(before, output.mesh, run.colour()),
                                 arguments.output, output.collapses, time_text(ms));
  if (output.rounds > 0) {
    text += fmt::format("{} of {} candidates of {} rounds accepted\n", output.accepted,
                        output.candidates, output.rounds);
  }
  if (output.end == DecimateEnd::refused) {
    text += fmt::format(
        "{} faces were asked for; no other edge can be collapsed without a face "
        "turned over or a surface joined to itself\n",
        arguments.faces);
  }
  return text;
}

ExitStatus decimate_file(Run& run, const DecimateArguments& arguments) {
  check_output_path(arguments.output);
  run.progress().begin(4);
  const OpenedMesh opened = open_mesh(run, arguments.input);
  run.progress().step("decimating");
  const Clock clock;
  DecimateOptions options;
  options.faces = arguments.faces;
  options.order = arguments.order == "rounds" ? DecimateOrder::rounds : DecimateOrder::queue;
  Result<DecimateOutput> output =
      decimate(opened.mesh(), opened.kept.positions(), options, run.execution());
  const double ms = clock.ms();
  if (!output) throw describe(output.error(), arguments.input);
  run.progress().step("writing");
  write_mesh(run, arguments.output, soup_of(output->mesh, std::move(output->positions)));

  if (run.is_text()) {
    run.print(report_text(run, arguments, opened.mesh(), *output, ms));
    return ExitStatus::done;
  }
  Json json;
  json["input"] = arguments.input;
  json["output"] = arguments.output;
  json["faces"] = arguments.faces;
  json["before"] = counts_json(opened.mesh());
  json["after"] = counts_json(output->mesh);
  json["order"] = arguments.order;
  json["collapses"] = output->collapses;
  json["rounds"] = output->rounds;
  json["candidates"] = output->candidates;
  json["accepted"] = output->accepted;
  json["postponed"] = output->postponed;
  json["largest_cost"] = output->largest_cost;
  json["total_cost"] = output->total_cost;
  json["ended_by"] = end_name(output->end);
  json["timings_ms"] = {
      {"read", opened.file.read_ms}, {"build", opened.built.build_ms}, {"decimate", ms}};
  run.print_json(json);
  return ExitStatus::done;
}

}  // namespace

void add_decimate(Program& program) {
  const auto arguments = std::make_shared<DecimateArguments>();
  Command command = program.add_command(
      "decimate", "Make a mesh of fewer faces that looks like it",
      "Collapses edges, those first that move the surface least (quadric error). The outline of\n"
      "holes is held, no face is turned over. Prints the counts before and after.",
      "hedgerow decimate dragon.ply small.ply --faces 10000",
      [arguments](Run& run) { return decimate_file(run, *arguments); });
  command.word("IN", arguments->input, "Mesh to read")
      .word("OUT", arguments->output, "Mesh to write")
      .needed_number("--faces", {0}, arguments->faces, "How many are to be left, or fewer by one")
      .choice("--order", {"queue", "rounds"}, arguments->order,
              "One by one, or in parts of the mesh at once");
}

}  // namespace hedgerow::tool
