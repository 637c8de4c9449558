#include <memory>

#include <fmt/format.h>

#include "commands.h"
#include "inspection.h"

namespace hedgerow::tool {
namespace {

struct InspectArguments {
  std::string input;
};

ExitStatus inspect(Run& run, const InspectArguments& arguments) {
  run.progress().begin(3);
  run.progress().step("reading");
  const MeshFile file = read_mesh(run, arguments.input);
  run.progress().step("building");
  BuiltMesh built = build_mesh(run, file);
  run.progress().step("counting and validating");
  const Inspection inspection = inspect_mesh(run, file, built);
  if (run.is_text()) {
    run.print(inspection_text(inspection, run.colour()));
  } else {
    run.print_json(inspection_json(inspection));
  }
  if (inspection.violation_count != 0) {
    run.note(fmt::format("{}: error: broken-invariants: {} violations of I1 to I8 in the result\n",
                         arguments.input, inspection.violation_count));
    return ExitStatus::defects;
  }
  const bool has_failed = run.options().strict && !inspection.defects.empty();
  return has_failed ? ExitStatus::defects : ExitStatus::done;
}

}  // namespace

void add_inspect(Program& program) {
  const auto arguments = std::make_shared<InspectArguments>();
  Command command = program.add_command(
      "inspect", "Count what a mesh is made of and list its defects",
      "Exits with 0 for every mesh that can be parsed, whatever its defects, but for "
      "--strict.\n--json prints the fields by their stable names, and the first 100 defects.",
      "hedgerow inspect scan.ply --json",
      [arguments](Run& run) { return inspect(run, *arguments); });
  command.word("IN", arguments->input, "Mesh to read");
}

}  // namespace hedgerow::tool
