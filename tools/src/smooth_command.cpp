#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "before_after.h"
#include "clock.h"
#include "commands.h"
#include "failure.h"
#include "hedgerow/smooth.h"
#include "mesh_file.h"
#include "table.h"

namespace hedgerow::tool {
namespace {

struct SmoothArguments {
  std::string input;
  std::string output;
  int iterations = 1;
  float step = 1;
  std::string weights = "umbrella";
  bool is_in_place = false;
};

SmoothOptions options_of(const SmoothArguments& arguments) {
  SmoothOptions options{arguments.iterations, arguments.step};
  if (arguments.weights == "cotangent") options.weights = SmoothWeights::cotangent;
  if (arguments.is_in_place) options.update = SmoothUpdate::in_place;
  return options;
}

struct Moves {
  std::int64_t moved = 0;  ///< vertices
  double largest = 0;      ///< distance
};

Moves moves_between(const Buffer<float>& before, const Buffer<float>& after) {
  Moves moves;
  for (std::size_t i = 0; i < before.size(); i += 3) {
    if (std::memcmp(&before[i], &after[i], sizeof(float[3])) == 0) continue;
    ++moves.moved;
    moves.largest =
        std::max(moves.largest,
                 static_cast<double>(std::hypot(after[i] - before[i], after[i + 1] - before[i + 1],
                                                after[i + 2] - before[i + 2])));
  }
  return moves;
}

ExitStatus smooth_file(Run& run, const SmoothArguments& arguments) {
  check_output_path(arguments.output);
  run.progress().begin(4);
  const OpenedMesh opened = open_mesh(run, arguments.input);
  run.progress().step("smoothing");
  Buffer<float> xyz = Buffer<float>::copy_of(opened.kept.xyz.span());
  Workspace workspace;
  const Clock clock;
  const Result<void> done = smooth(opened.mesh(), {xyz.data(), opened.mesh().vertex_count()},
                                   options_of(arguments), run.execution(), workspace);
  const double ms = clock.ms();
  if (!done) throw describe(done.error(), arguments.input);
  const Moves moves = moves_between(opened.kept.xyz, xyz);
  run.progress().step("writing");
  write_mesh(run, arguments.output, soup_of(opened.mesh(), std::move(xyz)));

  if (run.is_text()) {
    run.print(
        fmt::format("{}: {} of {} vertices moved, by {:.6g} at the most; {} iterations in {}\n",
                    arguments.output, moves.moved, opened.mesh().vertex_count(), moves.largest,
                    arguments.iterations, time_text(ms)));
    return ExitStatus::done;
  }
  Json json;
  json["input"] = arguments.input;
  json["output"] = arguments.output;
  json["iterations"] = arguments.iterations;
  json["step"] = arguments.step;
  json["weights"] = arguments.weights;
  json["update"] = arguments.is_in_place ? "in-place" : "double-buffered";
  json["before"] = counts_json(opened.mesh());
  json["after"] = counts_json(opened.mesh());
  json["moved_vertices"] = moves.moved;
  json["largest_move"] = moves.largest;
  json["timings_ms"] = {
      {"read", opened.file.read_ms}, {"build", opened.built.build_ms}, {"smooth", ms}};
  run.print_json(json);
  return ExitStatus::done;
}

}  // namespace

void add_smooth(Program& program) {
  const auto arguments = std::make_shared<SmoothArguments>();
  Command command = program.add_command(
      "smooth", "Move vertices towards the mean of their neighbours",
      "The boundary stays. Cotangent weights take triangles only. Says how many vertices moved.",
      "hedgerow smooth scan.ply smooth.ply --iterations 10",
      [arguments](Run& run) { return smooth_file(run, *arguments); });
  command.word("IN", arguments->input, "Mesh to read")
      .word("OUT", arguments->output, "Mesh to write")
      .needed_number("--iterations", {0, 1000000}, arguments->iterations,
                     "How often; 0 copies the mesh")
      .number("--step", {1e-6F, 1.0F}, arguments->step,
              "How far to go to the mean: above 0, at most 1")
      .choice("--weights", {"umbrella", "cotangent"}, arguments->weights, "Of the neighbours")
      .flag("--in-place", arguments->is_in_place,
            "Each vertex from the newest positions, on one thread");
}

}  // namespace hedgerow::tool
