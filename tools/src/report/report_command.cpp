#include <filesystem>
#include <memory>
#include <system_error>

#include <fmt/format.h>

#include "commands.h"
#include "failure.h"
#include "hedgerow/shapes.h"
#include "report/html.h"
#include "report/result.h"
#include "report/stages.h"
#if HEDGEROW_HAS_RAY
#include "render/picture.h"
#endif

namespace hedgerow::tool {
namespace {

/// Bandwidth is measured with arrays of at most this size: a virtual machine may report the cache
/// of its whole host.
constexpr std::size_t kBandwidthArrayLimit = std::size_t{256} << 20;
constexpr int kBandwidthPasses = 5;

/// The built-in mesh: as irregular as a scan, with boundary.
constexpr shapes::Shape kBuiltInShape = shapes::Shape::gyroid;
constexpr std::int64_t kBuiltInTriangles = 2'000'000;
constexpr const char* kBuiltInName = "a generated gyroid of 2 million triangles";

struct ReportArguments {
  std::string input;
  std::string folder = "report";
};

void make_folder(const std::string& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    throw Failure{ExitStatus::output, folder, "cannot-create-folder", error.message(), {}};
  }
}

/// The file that was named, or the built-in mesh by way of a file, so that reading is measured,
/// too.
class Input {
 public:
  Input(Run& run, const ReportArguments& arguments)
      : name_(arguments.input), path_(arguments.input) {
    if (path_.empty()) {
      name_ = kBuiltInName;
      path_ = (std::filesystem::path(arguments.folder) / "mesh.ply").string();
      is_temporary_ = true;
      const Result<Soup> soup = shapes::generate(kBuiltInShape, kBuiltInTriangles);
      if (!soup) throw describe(soup.error(), name_);
      write_mesh(run, path_, *soup);
    }
    file_ = read_mesh(run, path_);
  }
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;
  ~Input() {
    std::error_code ignored;
    if (is_temporary_) std::filesystem::remove(path_, ignored);
  }

  [[nodiscard]] const MeshFile& file() const noexcept { return file_; }
  [[nodiscard]] const std::string& name() const noexcept { return name_; }

 private:
  std::string name_;
  std::string path_;
  MeshFile file_;
  bool is_temporary_ = false;
};

void measure_stages(Stages& stages, const Subject& subject) {
  measure_build(stages, subject);
  measure_validate(stages, subject);
  measure_face_normals(stages, subject);
  measure_vertex_normals(stages, subject);
  measure_dirty_normals(stages, subject);
  measure_one_ring(stages, subject);
  measure_boundary_loops(stages, subject);
  measure_components(stages, subject);
  measure_reorder(stages, subject);
}

/// Builds the other meshes and the reference beside ours, and measures on the faces that were kept.
RayFacts measure_mesh(Run& run, Stages& stages, const std::string& path, const BuildOutput& output,
                      const Buffer<float>& positions) {
  run.progress().step("building the other meshes");
  const Soup soup = kept_soup(output, positions);
  const BuiltMesh built = build_mesh(run, path, soup, Policies{});
  BuiltMesh stored = build_mesh(run, path, soup, Policies{});
  stored.output.mesh.materialise(run.execution());
  const Reference reference(soup);
  baselines::PointerHalfedgeMesh pointer(soup.face_list(), soup.positions());
  baselines::StructHalfedgeMesh structs(soup.face_list(), soup.positions());
  const Subject subject{soup, built.mesh(), stored.mesh(), reference, pointer, structs};
  measure_stages(stages, subject);
#if HEDGEROW_HAS_RAY
  return measure_rays(stages, subject);
#else
  return {};
#endif
}

/// The PNG file of the mesh; empty without a ray tracer.
std::string draw_mesh([[maybe_unused]] Run& run, [[maybe_unused]] const std::string& name,
                      [[maybe_unused]] const BuildOutput& output,
                      [[maybe_unused]] const MeshFile& file) {
#if HEDGEROW_HAS_RAY
  constexpr int kAoRays = 32;
  RenderOptions options;
  options.ao_rays = kAoRays;
  return make_picture(run, name, {output, file.soup.positions()}, kept_soup(output, file.soup.xyz),
                      Shading::smooth, options)
      .png;
#else
  return {};
#endif
}

/// Writes what there is to write into the folder; `result.files` names it, the report itself first.
Json write_files(ReportResult& result, const std::string& folder, const std::string& png) {
  const auto path_of = [&](const char* name) {
    return (std::filesystem::path(folder) / name).string();
  };
  result.files = {path_of("report.json"), path_of("report.html")};
  if (!png.empty()) result.files.push_back(path_of("render.png"));
  Json json = report_json(result);
  write_text(path_of("report.json"), json_text(json) + '\n');
  write_text(path_of("report.html"), report_html(result, png));
  if (!png.empty()) write_text(path_of("render.png"), png);
  return json;
}

ExitStatus report(Run& run, const ReportArguments& arguments) {
  make_folder(arguments.folder);
  run.progress().begin(kReportSteps);
  run.progress().step("measuring memory bandwidth");
  ReportResult result;
  result.machine = describe_machine();
  result.bandwidth = baselines::measure_bandwidth(
      baselines::stream_array_bytes(kBandwidthArrayLimit), run.threads(), kBandwidthPasses);

  run.progress().step("reading");
  const Input input(run, arguments);
  result.mesh_name = input.name();
  run.progress().step("inspecting");
  BuiltMesh built = build_mesh(run, input.file());
  enforce_strict(run, input.name(), built.output);
  result.inspection = inspect_mesh(run, input.file(), built);

  Stages stages(run);
  measure_read(stages, input.file(), arguments.folder);
  result.rays = measure_mesh(run, stages, input.file().path, built.output, input.file().soup.xyz);
  result.stages = stages.stages();
  result.failed = stages.failed();

  const std::string png = draw_mesh(run, input.name(), built.output, input.file());
  const Json json = write_files(result, arguments.folder, png);
  if (run.is_text()) {
    run.print(report_text(result, run.colour()));
  } else {
    run.print_json(json);
  }
  return result.failed.empty() ? ExitStatus::done : ExitStatus::defects;
}

}  // namespace

void add_report(Program& program) {
  const auto arguments = std::make_shared<ReportArguments>();
  Command command = program.add_command(
      "report", "Measure every operation on a mesh, checked and compared",
      "Each answer is checked against a reference before it is timed, on one thread and on all,\n"
      "beside a pointer-based and an array-of-structs half-edge mesh. Writes DIR/report.json,\n"
      "DIR/report.html (one file with everything in it) and, with a ray tracer, DIR/render.png.",
      "hedgerow report dragon.ply --out results --threads 2",
      [arguments](Run& run) { return report(run, *arguments); });
  command
      .optional_word("IN", arguments->input, fmt::format("Mesh to read; default: {}", kBuiltInName))
      .text("--out", "DIR", arguments->folder, "Folder for the files; made if missing");
}

}  // namespace hedgerow::tool
