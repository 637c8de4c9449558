#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "clock.h"
#include "commands.h"
#include "mesh_file.h"
#include "table.h"

namespace hedgerow::tool {
namespace {

struct Arguments {
  std::string input;
  std::string output;
};

ExitStatus convert(Run& run, const Arguments& arguments) {
  check_output_path(arguments.output);
  run.progress().begin(run.options().strict ? 3 : 2);
  run.progress().step("reading");
  const MeshFile file = read_mesh(run, arguments.input);
  if (run.options().strict) {
    run.progress().step("checking");
    enforce_strict(run, arguments.input, build_mesh(run, file).output);
  }
  run.progress().step("writing");
  const Clock clock;
  const std::int64_t bytes = write_mesh(run, arguments.output, file.soup);
  const double write_ms = clock.ms();

  if (run.is_text()) {
    run.print(fmt::format("{}: {} vertices, {} faces, {}; read in {}, written in {}\n",
                          arguments.output, grouped(file.soup.vertex_count()),
                          grouped(file.soup.face_count()), byte_text(bytes),
                          time_text(file.read_ms), time_text(write_ms)));
    return ExitStatus::done;
  }
  Json json;
  json["input"] = arguments.input;
  json["output"] = arguments.output;
  json["vertices"] = file.soup.vertex_count();
  json["faces"] = file.soup.face_count();
  json["bytes"] = bytes;
  json["timings_ms"] = {{"read", file.read_ms}, {"write", write_ms}};
  run.print_json(json);
  return ExitStatus::done;
}

}  // namespace

void add_convert(Program& program) {
  const auto arguments = std::make_shared<Arguments>();
  CLI::App& command =
      program.add_command("convert", "Read a mesh in one format and write it in another",
                          "Polygons stay polygons, but in STL, where they are cut into triangles.",
                          "hedgerow convert engine.stl engine.ply",
                          [arguments](Run& run) { return convert(run, *arguments); });
  command.add_option("IN", arguments->input, "Mesh to read")->required()->type_name("");
  command.add_option("OUT", arguments->output, "File to write: .obj, .ply, .off or .stl")
      ->required()
      ->type_name("");
}

}  // namespace hedgerow::tool
