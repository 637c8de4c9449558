#include <memory>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "clock.h"
#include "commands.h"
#include "failure.h"
#include "hedgerow/normals.h"
#include "hedgerow/reorder.h"
#include "mesh_file.h"
#include "table.h"

namespace hedgerow::tool {
namespace {

struct ReorderArguments {
  std::string input;
  std::string output;
  std::string order = "hilbert";
};

ReorderMethod method_named(std::string_view word) {
  if (word == "morton") return ReorderMethod::morton;
  if (word == "bfs") return ReorderMethod::breadth_first;
  if (word == "vertex-cache") return ReorderMethod::vertex_cache;
  if (word == "fronts") return ReorderMethod::fronts;
  return ReorderMethod::hilbert;
}

/// The reordered mesh as vertices and faces, positions carried along.
Soup reordered_soup(const ReorderOutput& output, const Buffer<float>& positions) {
  Buffer<float> xyz(positions.size());
  fill_permuted(output.reordering.vertices_new_to_old.span(), positions.span(), xyz.span(), 3);
  return soup_of(output.mesh, std::move(xyz));
}

Json locality_json(const Locality& locality) {
  return {{"mean_index_gap", locality.mean_index_gap}, {"lines_per_face", locality.lines_per_face}};
}

std::string report_text(const Run& run, const ReorderArguments& arguments,
                        const ReorderOutput& output, bool has_helped, double ms) {
  const Locality& before = output.before;
  const Locality& after = output.after;
  Table table(
      {{"locality", Table::Align::left}, {"before"}, {"after"}, {"unit", Table::Align::left}});
  table.add({"cache lines fetched per face", short_text(before.lines_per_face),
             short_text(after.lines_per_face), "64-byte lines"});
  table.add({"mean gap along an edge", short_text(before.mean_index_gap),
             short_text(after.mean_index_gap), "vertices"});
  return fmt::format(
      "{}\n{}: {} order in {}; it {}\n", table.text(run.colour()), arguments.output,
      arguments.order, time_text(ms),
      has_helped ? "helped: fewer lines are fetched" : "did not help: no fewer lines are fetched");
}

ExitStatus reorder_file(Run& run, const ReorderArguments& arguments) {
  check_output_path(arguments.output);
  run.progress().begin(4);
  const OpenedMesh opened = open_mesh(run, arguments.input);
  const Soup& soup = opened.kept;
  run.progress().step("reordering");
  const Clock clock;
  const Result<ReorderOutput> output =
      reorder(opened.mesh(), soup.positions(), method_named(arguments.order), run.execution());
  const double ms = clock.ms();
  if (!output) throw describe(output.error(), arguments.input);
  run.progress().step("writing");
  write_mesh(run, arguments.output, reordered_soup(*output, soup.xyz));

  const bool has_helped = output->after.lines_per_face < output->before.lines_per_face;
  if (run.is_text()) {
    run.print(report_text(run, arguments, *output, has_helped, ms));
    return ExitStatus::done;
  }
  Json json;
  json["input"] = arguments.input;
  json["output"] = arguments.output;
  json["order"] = arguments.order;
  json["vertices"] = soup.vertex_count();
  json["faces"] = soup.face_count();
  json["before"] = locality_json(output->before);
  json["after"] = locality_json(output->after);
  json["helped"] = has_helped;
  json["timings_ms"] = {
      {"read", opened.file.read_ms}, {"build", opened.built.build_ms}, {"reorder", ms}};
  run.print_json(json);
  return ExitStatus::done;
}

}  // namespace

void add_reorder(Program& program) {
  const auto arguments = std::make_shared<ReorderArguments>();
  Command command = program.add_command(
      "reorder", "Renumber vertices and faces so that neighbours lie close in memory",
      "Prints a measure of locality before and after, and whether the new order helped.",
      "hedgerow reorder scan.ply scan-hilbert.ply --order hilbert",
      [arguments](Run& run) { return reorder_file(run, *arguments); });
  command.word("IN", arguments->input, "Mesh to read")
      .word("OUT", arguments->output, "Mesh to write; the kept faces only")
      .choice("--order", {"hilbert", "morton", "bfs", "vertex-cache", "fronts"}, arguments->order,
              "The new order");
}

}  // namespace hedgerow::tool
