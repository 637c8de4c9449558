#include <memory>

#include <fmt/format.h>

#include "clock.h"
#include "commands.h"
#include "failure.h"
#include "hedgerow/shapes.h"
#include "mesh_file.h"
#include "table.h"

namespace hedgerow::tool {
namespace {

struct GenerateArguments {
  std::string shape;
  std::string output;
  std::int64_t size = shapes::kDefaultTriangles;
};

std::vector<std::string> shape_names() {
  std::vector<std::string> names;
  for (const shapes::Shape shape : shapes::kShapes) names.emplace_back(shapes::name(shape));
  return names;
}

ExitStatus generate(Run& run, const GenerateArguments& arguments) {
  check_output_path(arguments.output);
  run.progress().begin(run.options().strict ? 3 : 2);
  run.progress().step("generating");
  const Clock clock;
  const Result<Soup> soup = shapes::generate(*shapes::shape_named(arguments.shape), arguments.size);
  const double generate_ms = clock.ms();
  if (!soup) throw describe(soup.error(), arguments.output);
  if (run.options().strict) {
    run.progress().step("checking");
    enforce_strict(run, arguments.shape,
                   build_mesh(run, arguments.shape, *soup, run.options().policies).output);
  }
  run.progress().step("writing");
  const Clock write_clock;
  const std::int64_t bytes = write_mesh(run, arguments.output, *soup);
  const double write_ms = write_clock.ms();
  if (run.is_text()) {
    run.print(fmt::format("{}: {}, {} vertices, {} faces, {}; made in {}, written in {}\n",
                          arguments.output, arguments.shape, grouped(soup->vertex_count()),
                          grouped(soup->face_count()), byte_text(bytes), time_text(generate_ms),
                          time_text(write_ms)));
    return ExitStatus::done;
  }
  Json json;
  json["shape"] = arguments.shape;
  json["output"] = arguments.output;
  json["vertices"] = soup->vertex_count();
  json["faces"] = soup->face_count();
  json["bytes"] = bytes;
  json["timings_ms"] = {{"generate", generate_ms}, {"write", write_ms}};
  run.print_json(json);
  return ExitStatus::done;
}

}  // namespace

void add_generate(Program& program) {
  const auto arguments = std::make_shared<GenerateArguments>();
  Command command =
      program.add_command("generate", "Write a mesh made by rule; the same bytes every time", "",
                          "hedgerow generate gyroid gyroid.ply --size 1000000",
                          [arguments](Run& run) { return generate(run, *arguments); });
  std::string names;
  for (const std::string& name : shape_names()) names += (names.empty() ? "" : ", ") + name;
  command.word_of("SHAPE", shape_names(), arguments->shape, "One of: " + names)
      .word("OUT", arguments->output, "File to write: .obj, .ply, .off or .stl")
      .number("--size", {1}, arguments->size,
              "About how many triangles; the nearest number that the shape can have");
}

}  // namespace hedgerow::tool
