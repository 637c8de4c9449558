#include <memory>

#include <fmt/format.h>

#include "clock.h"
#include "commands.h"
#include "hedgerow/io/format.h"
#include "mesh_file.h"
#include "table.h"

namespace hedgerow::tool {
namespace {

struct ConvertArguments {
  std::string input;
  std::string output;
};

bool is_winged(const std::string& path) { return io::format_of(path) == io::Format::wet; }

struct Converted {
  Index vertex_count = 0;
  Index face_count = 0;
  std::int64_t byte_count = 0;
  double read_ms = 0;
  double write_ms = 0;
};

Converted convert_mesh(Run& run, const ConvertArguments& arguments) {
  const MeshFile file = read_mesh(run, arguments.input);
  if (run.options().strict) {
    run.progress().step("checking");
    enforce_strict(run, arguments.input, build_mesh(run, file).output);
  }
  run.progress().step("writing");
  const Clock clock;
  const std::int64_t bytes = write_mesh(run, arguments.output, file.soup);
  return {file.soup.vertex_count(), file.soup.face_count(), bytes, file.read_ms, clock.ms()};
}

// Through faces, edges and sides would be numbered anew.
Converted convert_tables(Run& run, const ConvertArguments& arguments) {
  if (run.options().strict) {
    const MeshFile file = read_mesh(run, arguments.input);
    run.progress().step("checking");
    enforce_strict(run, arguments.input, build_mesh(run, file).output);
  }
  const Clock reading;
  const WingedEdgeTables tables = read_tables(run, arguments.input);
  const double read_ms = reading.ms();
  run.progress().step("writing");
  const Clock writing;
  const std::int64_t bytes = write_tables(arguments.output, tables);
  return {tables.vertex_count(), tables.face_count(), bytes, read_ms, writing.ms()};
}

ExitStatus convert(Run& run, const ConvertArguments& arguments) {
  check_output_path(arguments.output);
  const bool keeps_tables = is_winged(arguments.input) && is_winged(arguments.output);
  run.progress().begin(run.options().strict ? 3 : 2);
  run.progress().step("reading");
  const Converted done =
      keeps_tables ? convert_tables(run, arguments) : convert_mesh(run, arguments);
  if (run.is_text()) {
    run.print(fmt::format("{}: {} vertices, {} faces, {}; read in {}, written in {}\n",
                          arguments.output, grouped(done.vertex_count), grouped(done.face_count),
                          byte_text(done.byte_count), time_text(done.read_ms),
                          time_text(done.write_ms)));
    return ExitStatus::done;
  }
  Json json;
  json["input"] = arguments.input;
  json["output"] = arguments.output;
  json["vertices"] = done.vertex_count;
  json["faces"] = done.face_count;
  json["bytes"] = done.byte_count;
  json["timings_ms"] = {{"read", done.read_ms}, {"write", done.write_ms}};
  run.print_json(json);
  return ExitStatus::done;
}

}  // namespace

void add_convert(Program& program) {
  const auto arguments = std::make_shared<ConvertArguments>();
  Command command =
      program.add_command("convert", "Read a mesh in one format and write it in another",
                          "Polygons stay polygons, but in STL, where they are cut into triangles.",
                          "hedgerow convert engine.stl engine.ply",
                          [arguments](Run& run) { return convert(run, *arguments); });
  command.word("IN", arguments->input, "Mesh to read")
      .word("OUT", arguments->output, "File to write: .obj, .ply, .off, .stl or .wet");
}

}  // namespace hedgerow::tool
