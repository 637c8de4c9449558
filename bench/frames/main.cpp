// The frame loop of a renderer that uses the engine with Embree, as a program and as a benchmark.
#include <cstdio>
#include <exception>
#include <iostream>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "frames/stages.h"
#include "hedgerow/query.h"
#include "machine.h"
#include "mesh_source.h"

namespace {

using namespace hedgerow;         // NOLINT(google-build-using-namespace): a program of one file
using namespace hedgerow::bench;  // NOLINT(google-build-using-namespace)

struct Arguments {
  FrameOptions options;
  std::string mesh;
  std::string shape = "terrain";
  std::int64_t size = 2'000'000;
  std::string stages = "S0,S2,S3,S4,S5,S6";
  std::string moved = "both";
  std::string out;
};

void describe(CLI::App& app, Arguments& arguments) {
  FrameOptions& options = arguments.options;
  app.footer(
      "S0 import, S2 normals, S3 trees, S4 rays (Embree's own speed: shown, not ours), S5\n"
      "connectivity at hits, S6 frames (S1, the deformation, is a part of them). Rays come from\n"
      "fixed seeds before any clock runs; every answer is checked, and a wrong one gives status "
      "1.\n"
      "Times outside S6 are the fastest of --runs.\n"
      "Example: hedgerow_frames --mesh dragon.ply --frames 10000 --out frames.json");
  app.add_option("--mesh", arguments.mesh, "Mesh file (default: a generated terrain)");
  app.add_option("--shape", arguments.shape, "Generated mesh, by the names of the benchmarks")
      ->capture_default_str();
  app.add_option("--size", arguments.size, "Triangles of the generated mesh")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--frames", options.frames, "Frames of each loop, after two that do not count")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--rays", options.rays, "Primary rays a frame, at the most")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--still-rays", options.still_rays, "Primary rays of the stages before")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--runs", options.runs, "Runs of each measurement outside the frames")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("--piece-faces", options.piece_faces, "Faces a piece of the moving tree; 0: one")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  app.add_option("--moved", arguments.moved, "Per cent of the vertices that move in the frames")
      ->check(CLI::IsMember({"1", "100", "both"}))
      ->capture_default_str();
  app.add_option("--loops", options.loops, "Which frames: on one thread, on all, double-buffered")
      ->capture_default_str();
  app.add_option("--stages", arguments.stages, "Which of them, e.g. S5,S6")->capture_default_str();
  app.add_option("--out", arguments.out, "JSON file to write");
}

int run(const Arguments& arguments) {
  FrameOptions options = arguments.options;
  options.moves_some = arguments.moved != "100";
  options.moves_all = arguments.moved != "1";
  const Subject subject(arguments.mesh.empty() ? generate_soup(arguments.shape, arguments.size)
                                               : read_soup(arguments.mesh));
  const std::string name = arguments.mesh.empty() ? arguments.shape : arguments.mesh;
  auto context = machine_context();
  context.emplace_back("embree", fmt::format("{}", ray::Device::create()->version()));
  context.emplace_back(
      "mesh", fmt::format("{}: {} vertices, {} faces", name, subject.vertices(), subject.faces()));
  for (const auto& [key, value] : context) std::printf("%s: %s\n", key.c_str(), value.c_str());

  Rows rows;
  const auto wants = [&](const char* stage) {
    return arguments.stages.find(stage) != std::string::npos;
  };
  if (wants("S0")) measure_import(rows, subject, options);
  if (wants("S2")) measure_normals(rows, subject, options);
  if (wants("S3")) measure_trees(rows, subject, options);
  if (wants("S4")) measure_rays(rows, subject, options);
  if (wants("S5")) measure_hits(rows, subject, options);
  if (wants("S6")) measure_frames(rows, subject, options);
  if (!arguments.out.empty()) rows.write(arguments.out, context);
  return rows.failed().empty() && !rows.rows().empty() ? 0 : 1;
}

}  // namespace

int main(int count, char** values) {
  CLI::App app("Frames of a renderer: deform, normals, refit, rays, connectivity at hits");
  Arguments arguments;
  describe(app, arguments);
  CLI11_PARSE(app, count, values);
  try {
    return run(arguments);
  } catch (const std::exception& error) {
    std::cerr << "hedgerow_frames: " << error.what() << '\n';
    return 1;
  }
}
