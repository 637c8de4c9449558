#include <memory>
#include <optional>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "commands.h"
#include "failure.h"
#include "hedgerow/weld.h"
#include "mesh_file.h"
#include "orient_faces.h"
#include "table.h"

namespace hedgerow::tool {
namespace {

struct RepairArguments {
  std::string input;
  std::string output;
  std::string maps;
  bool orient = false;
  bool drop_duplicates = false;
  std::optional<double> weld;
};

/// A face list has no room for a cut edge: it would be joined again when the file is read. So where
/// nothing else was asked for, `repair` splits.
Policies repair_policies(const Options& options, bool drop_duplicates) {
  Policies policies = options.policies;
  if (drop_duplicates) policies[DefectKind::duplicate_face] = Action::skip;
  for (const DefectKind kind : {DefectKind::nonmanifold_edge, DefectKind::inconsistent_edge,
                                DefectKind::nonmanifold_vertex}) {
    if (!options.is_policy_given[static_cast<std::size_t>(kind)]) policies[kind] = Action::split;
  }
  return policies;
}

/// Numbers as the first step left them, in the numbers before it; an empty map changes none.
std::vector<Index> composed(std::span<const Index> second, std::span<const Index> first,
                            Index count) {
  std::vector<Index> map;
  for (Index i = 0; i < count; ++i) {
    const Index between = second.empty() ? i : second[static_cast<std::size_t>(i)];
    map.push_back(first.empty() ? between : first[static_cast<std::size_t>(between)]);
  }
  return map;
}

/// What the repair did, and what a fresh look at the result finds.
struct Outcome {
  Policies policies;
  BuildStats before;
  BuildStats after;
  std::int64_t vertices_before = 0;
  std::int64_t vertices_after = 0;
  std::int64_t faces_before = 0;
  std::int64_t faces_after = 0;
  /// New vertices that repeat the position of an earlier one, and old ones that none came from.
  std::int64_t vertices_split = 0;
  std::int64_t vertices_dropped = 0;
  std::int64_t vertices_merged = 0;
  std::optional<OrientedFaces> oriented;
};

void count_vertices(const BuildOutput& output, Outcome& outcome) {
  const std::span<const Index> new_to_old = output.vertices_new_to_old.span();
  if (new_to_old.empty()) return;
  const std::int64_t welded_count = outcome.vertices_before - outcome.vertices_merged;
  std::vector<bool> is_used(static_cast<std::size_t>(welded_count), false);
  for (const Index old : new_to_old) {
    const auto v = static_cast<std::size_t>(old);
    outcome.vertices_split += is_used[v] ? 1 : 0;
    is_used[v] = true;
  }
  outcome.vertices_dropped = welded_count + outcome.vertices_split - outcome.vertices_after;
}

std::string outcome_text(const Run& run, const RepairArguments& arguments, const Outcome& outcome) {
  Table kinds(
      {{"defect", Table::Align::left}, {"before"}, {"action", Table::Align::left}, {"after"}});
  bool is_any_cut = false;
  for (std::size_t i = 0; i < kDefectKindCount; ++i) {
    const auto kind = static_cast<DefectKind>(i);
    if (outcome.before.defect_count[i] == 0 && outcome.after.defect_count[i] == 0) continue;
    kinds.add({name(kind), grouped(outcome.before.defect_count[i]), name(outcome.policies[kind]),
               grouped(outcome.after.defect_count[i])});
    is_any_cut = is_any_cut || outcome.policies[kind] == Action::cut;
  }
  Table counts({{"", Table::Align::left}, {"before"}, {"after"}, {"change", Table::Align::left}});
  counts.add(
      {"vertices", grouped(outcome.vertices_before), grouped(outcome.vertices_after),
       fmt::format("{} merged, {} added by splitting, {} dropped", grouped(outcome.vertices_merged),
                   grouped(outcome.vertices_split), grouped(outcome.vertices_dropped))});
  counts.add({"faces", grouped(outcome.faces_before), grouped(outcome.faces_after),
              fmt::format("{} dropped", grouped(outcome.faces_before - outcome.faces_after))});
  std::string out = kinds.empty() ? "no defects\n" : kinds.text(run.colour());
  out += '\n' + counts.text(run.colour());
  if (outcome.oriented) out += '\n' + text_of(*outcome.oriented);
  if (is_any_cut) {
    out += "\na cut leaves the faces in the file as they are; split removes the defect\n";
  }
  out += fmt::format("\nwrote {}\n", arguments.output);
  if (!arguments.maps.empty()) out += fmt::format("wrote {}\n", arguments.maps);
  return out;
}

Json outcome_json(const RepairArguments& arguments, const Outcome& outcome) {
  Json policies;
  Json before;
  Json after;
  for (std::size_t i = 0; i < kDefectKindCount; ++i) {
    const auto kind = static_cast<DefectKind>(i);
    policies[name(kind)] = name(outcome.policies[kind]);
    before[name(kind)] = outcome.before.defect_count[i];
    after[name(kind)] = outcome.after.defect_count[i];
  }
  Json json;
  json["input"] = arguments.input;
  json["output"] = arguments.output;
  json["maps"] = arguments.maps.empty() ? Json(nullptr) : Json(arguments.maps);
  json["policies"] = std::move(policies);
  json["before"] = {{"vertices", outcome.vertices_before},
                    {"faces", outcome.faces_before},
                    {"defects", std::move(before)}};
  json["after"] = {{"vertices", outcome.vertices_after},
                   {"faces", outcome.faces_after},
                   {"defects", std::move(after)}};
  json["vertices_merged"] = outcome.vertices_merged;
  json["vertices_split"] = outcome.vertices_split;
  json["vertices_dropped"] = outcome.vertices_dropped;
  json["faces_dropped"] = outcome.faces_before - outcome.faces_after;
  json["orientation"] = outcome.oriented ? json_of(*outcome.oriented) : Json(nullptr);
  return json;
}

void write_maps(const RepairArguments& arguments, const BuildOutput& output,
                std::span<const Index> welded_to_old) {
  Json maps;
  maps["vertices_new_to_old"] =
      composed(output.vertices_new_to_old.span(), welded_to_old, output.mesh.vertex_count());
  maps["faces_new_to_old"] = composed(output.faces_new_to_old.span(), {}, output.mesh.face_count());
  write_text(arguments.maps, maps.dump() + '\n');
}

/// Merges vertices in place, if that was asked for. Returns the map to their old numbers.
Buffer<Index> weld_vertices(const RepairArguments& arguments, Soup& soup) {
  if (!arguments.weld) return {};
  Result<Weld> weld = find_weld(soup.positions(), *arguments.weld);
  if (!weld) throw describe(weld.error(), arguments.input);
  soup = welded(soup, *weld);
  return std::move(weld->new_to_old);
}

ExitStatus repair(Run& run, const RepairArguments& arguments) {
  check_output_path(arguments.output);
  Outcome outcome;
  outcome.policies = repair_policies(run.options(), arguments.drop_duplicates);
  run.progress().begin(4);
  run.progress().step("reading");
  MeshFile file = read_mesh(run, arguments.input);
  run.progress().step("repairing");
  outcome.vertices_before = file.soup.vertex_count();
  const Buffer<Index> welded_to_old = weld_vertices(arguments, file.soup);
  outcome.vertices_merged = outcome.vertices_before - file.soup.vertex_count();
  if (arguments.orient) {
    outcome.oriented = orient_faces(run, arguments.input, file.soup, outcome.policies);
  }
  const BuiltMesh built = build_mesh(run, arguments.input, file.soup, outcome.policies);
  const Soup soup = kept_soup(built.output, file.soup.xyz);
  run.progress().step("checking the result");
  const BuiltMesh again = build_mesh(run, arguments.output, soup, Policies{});
  enforce_strict(run, arguments.output, again.output);
  run.progress().step("writing");
  if (!arguments.maps.empty()) write_maps(arguments, built.output, welded_to_old.span());
  write_mesh(run, arguments.output, soup);

  outcome.before = built.output.stats;
  outcome.after = again.output.stats;
  outcome.vertices_after = soup.vertex_count();
  outcome.faces_before = file.soup.face_count();
  outcome.faces_after = soup.face_count();
  count_vertices(built.output, outcome);
  if (run.is_text()) {
    run.print(outcome_text(run, arguments, outcome));
  } else {
    run.print_json(outcome_json(arguments, outcome));
  }
  return ExitStatus::done;
}

}  // namespace

void add_repair(Program& program) {
  const auto arguments = std::make_shared<RepairArguments>();
  Command command = program.add_command(
      "repair", "Apply the policies to a mesh and write the result",
      "Without --policy, edges and vertices that are not manifold are split, faces with a "
      "repeated\n"
      "vertex or fewer than three corners are dropped, and all else is kept. Nothing is lost\n"
      "silently: what was changed is printed. Under --strict nothing is written if defects remain.",
      "hedgerow repair scan.stl clean.ply --policy isolated-vertex=skip --maps maps.json",
      [arguments](Run& run) { return repair(run, *arguments); });
  command.word("IN", arguments->input, "Mesh to read")
      .word("OUT", arguments->output, "Mesh to write")
      .optional_number("--weld", {0}, arguments->weld,
                       "First merge vertices within this distance of one\n"
                       "another, directly or by way of others; 0: those at\n"
                       "the same place")
      .flag("--drop-duplicates", arguments->drop_duplicates,
            "Keep the first of the faces with the same vertices:\n"
            "as --policy duplicate-face=skip")
      .flag("--orient", arguments->orient,
            "Then turn faces over so that those of each patch\n"
            "agree. A patch with no orientation, as a Moebius\n"
            "band, is reported with a cycle of faces as proof")
      .text("--maps", "FILE", arguments->maps,
            "JSON file to write: vertices_new_to_old and\n"
            "faces_new_to_old, one number of the input for each\n"
            "vertex and face of the output");
}

}  // namespace hedgerow::tool
