#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "commands.h"
#include "failure.h"
#include "mesh_file.h"
#include "render/picture.h"
#include "table.h"

namespace hedgerow::tool {
namespace {

constexpr int kMaxSide = 16384;
constexpr int kMaxAoRays = 65536;

struct RenderArguments {
  std::string input;
  std::string output;
  std::string shading = "smooth";
  RenderOptions options;
};

const std::map<std::string, Shading>& shadings() {
  static const std::map<std::string, Shading> kShadings = {
      {"smooth", Shading::smooth},         {"flat", Shading::flat},
      {"normals", Shading::normals},       {"valence", Shading::valence},
      {"components", Shading::components}, {"defects", Shading::defects}};
  return kShadings;
}

void check_picture_path(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::ranges::transform(extension, extension.begin(), [](char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  });
  if (extension == ".png") return;
  throw Failure{ExitStatus::usage,
                path,
                "unknown-extension",
                "the output of this command is a .png file",
                {}};
}

ExitStatus render_mesh(Run& run, const RenderArguments& arguments) {
  check_picture_path(arguments.output);
  run.progress().begin(5);
  const OpenedMesh opened = open_mesh(run, arguments.input);
  const BuildFacts facts{opened.built.output, opened.file.soup.positions()};
  const Picture picture = make_picture(run, arguments.input, facts, opened.kept,
                                       shadings().at(arguments.shading), arguments.options);
  run.progress().step("writing");
  write_text(arguments.output, picture.png);

  if (run.is_text()) {
    std::string text = fmt::format(
        "{}: {} x {} pixels, {}; {} faces, {} shading; tree in {}, drawn in {}\n", arguments.output,
        arguments.options.width, arguments.options.height,
        byte_text(static_cast<std::int64_t>(picture.png.size())), grouped(opened.kept.face_count()),
        arguments.shading, time_text(picture.tree_ms), time_text(picture.draw_ms));
    for (const LegendEntry& entry : picture.legend) {
      text += fmt::format("  #{:06x}  {}\n", entry.rrggbb, entry.meaning);
    }
    run.print(text);
    return ExitStatus::done;
  }
  Json json;
  json["input"] = arguments.input;
  json["output"] = arguments.output;
  json["width"] = arguments.options.width;
  json["height"] = arguments.options.height;
  json["shading"] = arguments.shading;
  json["wireframe"] = arguments.options.wireframe;
  json["ao"] = arguments.options.ao_rays;
  json["faces"] = opened.kept.face_count();
  json["legend"] = picture.legend_json;
  json["bytes"] = picture.png.size();
  json["timings_ms"] = {{"read", opened.file.read_ms},
                        {"build", opened.built.build_ms},
                        {"tree", picture.tree_ms},
                        {"draw", picture.draw_ms}};
  run.print_json(json);
  return ExitStatus::done;
}

}  // namespace

void add_render(Program& program) {
  const auto arguments = std::make_shared<RenderArguments>();
  Command command = program.add_command(
      "render", "Draw a mesh into a PNG picture by tracing rays",
      "The camera is fitted to the mesh. The same bytes for every number of threads. Faces seen\n"
      "from behind are red under smooth and flat. valence, components and defects print a legend.",
      "hedgerow render bunny.ply bunny.png --wireframe --ao 64",
      [arguments](Run& run) { return render_mesh(run, *arguments); });
  std::vector<std::string> names;
  for (const auto& [name, shading] : shadings()) names.push_back(name);
  command.word("IN", arguments->input, "Mesh to read")
      .word("OUT.png", arguments->output, "Picture to write")
      .number("--width", {1, kMaxSide}, arguments->options.width, "Pixels across")
      .number("--height", {1, kMaxSide}, arguments->options.height, "Pixels down")
      .choice("--shading", names, arguments->shading, "What the colours say")
      .flag("--wireframe", arguments->options.wireframe, "Draw the edges")
      .number("--ao", {0, kMaxAoRays}, arguments->options.ao_rays,
              "Ambient occlusion by so many rays a pixel, rounded up to a multiple of 8");
}

}  // namespace hedgerow::tool
