#include <memory>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "clock.h"
#include "commands.h"
#include "failure.h"
#include "hedgerow/digest.h"
#include "hedgerow/normals.h"
#include "mesh_file.h"
#include "table.h"

namespace hedgerow::tool {
namespace {

struct NormalsArguments {
  std::string input;
  std::string output;
  std::string weight = "area";
  std::string method = "halfedge";
};

NormalWeight weight_named(std::string_view word) {
  if (word == "uniform") return NormalWeight::uniform;
  if (word == "angle") return NormalWeight::angle;
  if (word == "max") return NormalWeight::max;
  return NormalWeight::area;
}

struct Normals {
  Buffer<float> xyz;
  NormalStats stats;
  double ms = 0;
};

Normals compute(const Run& run, const NormalsArguments& arguments, const Connectivity& mesh,
                const Soup& soup) {
  NormalOptions options;
  options.weight = weight_named(arguments.weight);
  Normals normals;
  normals.xyz = Buffer<float>(soup.xyz.size());
  const NormalsOut out{normals.xyz.data(), soup.vertex_count()};
  Workspace workspace;
  const Clock clock;
  const Result<NormalStats> stats =
      arguments.method == "halfedge"
          ? gather_vertex_normals(mesh, soup.positions(), out, options, run.execution(), workspace)
          : scatter_vertex_normals(soup.face_list(), soup.positions(), out, options,
                                   run.execution(), workspace);
  normals.ms = clock.ms();
  if (!stats) throw describe(stats.error(), arguments.input);
  normals.stats = *stats;
  return normals;
}

ExitStatus write_normals(Run& run, const NormalsArguments& arguments) {
  check_output_path(arguments.output, ".ply");
  run.progress().begin(4);
  const OpenedMesh opened = open_mesh(run, arguments.input);
  const Soup& soup = opened.kept;
  run.progress().step("computing normals");
  const Normals normals = compute(run, arguments, opened.mesh(), soup);
  run.progress().step("writing");
  write_mesh(run, arguments.output, soup, normals.xyz);

  const std::string hash = fmt::format("{:016x}", digest(std::as_bytes(normals.xyz.span())));
  if (run.is_text()) {
    run.print(fmt::format(
        "{}: {} vertices, {} faces; {} weights by {} in {}\n"
        "{} vertices without a direction (written as 0 0 0); digest of the normals {}\n",
        arguments.output, grouped(soup.vertex_count()), grouped(soup.face_count()),
        arguments.weight, arguments.method, time_text(normals.ms),
        grouped(normals.stats.degenerate_count), hash));
    return ExitStatus::done;
  }
  Json json;
  json["input"] = arguments.input;
  json["output"] = arguments.output;
  json["weight"] = arguments.weight;
  json["method"] = arguments.method;
  json["vertices"] = soup.vertex_count();
  json["faces"] = soup.face_count();
  json["without_direction"] = normals.stats.degenerate_count;
  json["digest"] = hash;
  json["timings_ms"] = {
      {"read", opened.file.read_ms}, {"build", opened.built.build_ms}, {"normals", normals.ms}};
  run.print_json(json);
  return ExitStatus::done;
}

}  // namespace

void add_normals(Program& program) {
  const auto arguments = std::make_shared<NormalsArguments>();
  Command command =
      program.add_command("normals", "Write a PLY file with a unit normal at every vertex",
                          "A vertex without a direction, such as one on no face, gets 0 0 0.",
                          "hedgerow normals bunny.obj bunny.ply --weight angle",
                          [arguments](Run& run) { return write_normals(run, *arguments); });
  command.word("IN", arguments->input, "Mesh to read")
      .word("OUT.ply", arguments->output,
            "Binary little-endian PLY to write: x y z nx ny nz and the kept faces")
      .choice("--weight", {"uniform", "area", "angle", "max"}, arguments->weight,
              "How much each face counts at its corner")
      .choice("--method", {"halfedge", "facelist"}, arguments->method,
              "Walk the half-edges or add up the face list; the same bits");
}

}  // namespace hedgerow::tool
