#include <array>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "clock.h"
#include "commands.h"
#include "failure.h"
#include "hedgerow/delaunay.h"
#include "hedgerow/io/points.h"
#include "hedgerow/triangulate.h"
#include "mesh_file.h"
#include "planar_output.h"
#include "table.h"

namespace hedgerow::tool {
namespace {

struct DelaunayArguments {
  std::string input;
  std::string output;
  std::string edges;
  std::string test = "angle-sum";
  std::string order = "rounds";
  std::optional<std::int64_t> max_flips;
};

// ---- points

Repeated repeated_points(std::span<const Index> same_as) {
  Repeated repeated;
  for (std::size_t i = 0; i < same_as.size(); ++i) {
    if (same_as[i] == static_cast<Index>(i)) continue;
    if (repeated.count++ == 0) repeated.first = static_cast<Index>(i);
  }
  return repeated;
}

// A file of edges is one of points whose coordinates are numbers of points.
std::vector<std::array<Index, 2>> read_edges(Run& run, const std::string& path) {
  std::vector<std::array<Index, 2>> edges;
  for (const Point2& row : read_points(run, path).points) {
    std::array<Index, 2>& edge = edges.emplace_back();
    for (std::size_t end = 0; end < 2; ++end) {
      if (std::abs(row[end]) > 1e9 || row[end] != std::floor(row[end])) {
        throw Failure{ExitStatus::input,
                      path,
                      "bad-number",
                      fmt::format("edge {} has the end {}, which is not the number of a point",
                                  edges.size() - 1, row[end]),
                      {}};
      }
      edge[end] = static_cast<Index>(row[end]);
    }
  }
  return edges;
}

Failure describe_edges(const Error& error, const DelaunayArguments& arguments) {
  const auto failed = [&](std::string message) {
    return Failure{ExitStatus::input, arguments.edges, name(error.code), std::move(message), {}};
  };
  switch (error.code) {
    case ErrorCode::index_out_of_range:
      return failed(fmt::format("edge {} refers to point {}, but there are {} points",
                                error.element, error.value, error.limit));
    case ErrorCode::repeated_vertex:
      return failed(
          fmt::format("edge {} ends where it begins, at point {}", error.element, error.value));
    case ErrorCode::crossing_edges:
      return failed(fmt::format("edge {} crosses edge {}", error.element, error.value));
    default:
      return describe(error, arguments.input);
  }
}

ConstrainedTriangulation triangulation_of(Run& run, const DelaunayArguments& arguments,
                                          const PointsFile& file,
                                          std::span<const std::array<Index, 2>> edges) {
  if (arguments.edges.empty()) {
    Result<Triangulation> made = triangulate(file.points, run.execution());
    if (!made) throw describe(made.error(), arguments.input);
    return {std::move(made->mesh), std::move(made->same_as), {}};
  }
  Result<ConstrainedTriangulation> made =
      triangulate_constrained(file.points, edges, run.execution());
  if (!made) throw describe_edges(made.error(), arguments);
  return std::move(*made);
}

// Both sides of an inner edge are listed, and the one side of an edge of the hull.
Index constrained_edge_count(const ConstrainedTriangulation& made) {
  Index sides = 0;
  for (const Index h : made.constrained) {
    sides += made.mesh.opposite()[static_cast<std::size_t>(h)] == kInvalidIndex ? 2 : 1;
  }
  return sides / 2;
}

void print_triangulation(Run& run, const DelaunayArguments& arguments, const PointsFile& file,
                         const ConstrainedTriangulation& made, double ms) {
  const Connectivity& mesh = made.mesh;
  const Index repeated = repeated_points(made.same_as.span()).count;
  const Index hull = 2 * edge_count(mesh) - mesh.halfedge_count();
  if (run.is_text()) {
    Table table({{"Delaunay triangulation", Table::Align::left}, {"count"}});
    table.add({"points", grouped(mesh.vertex_count())});
    table.add({"of those, at the place of an earlier one", grouped(repeated)});
    table.add({"triangles", grouped(mesh.face_count())});
    table.add({"edges", grouped(edge_count(mesh))});
    table.add({"of those, of the hull", grouped(hull)});
    table.add({"of those, constrained", grouped(constrained_edge_count(made))});
    run.print(
        fmt::format("{}\n{}: {}\n", table.text(run.colour()), arguments.output, time_text(ms)));
    return;
  }
  Json json;
  json["input"] = arguments.input;
  json["output"] = arguments.output;
  json["before"] = {{"points", mesh.vertex_count()}, {"repeated_points", repeated}};
  json["after"] = {{"vertices", mesh.vertex_count()},
                   {"faces", mesh.face_count()},
                   {"edges", edge_count(mesh)},
                   {"boundary_edges", hull},
                   {"constrained_edges", constrained_edge_count(made)}};
  json["timings_ms"] = {{"read", file.read_ms}, {"delaunay", ms}};
  run.print_json(json);
}

ExitStatus triangulate_points(Run& run, const DelaunayArguments& arguments) {
  check_planar_output_path(arguments.output);
  run.progress().begin(3);
  run.progress().step("reading");
  const PointsFile file = read_points(run, arguments.input);
  std::vector<std::array<Index, 2>> edges;
  if (!arguments.edges.empty()) edges = read_edges(run, arguments.edges);
  run.progress().step("triangulating");
  const Clock clock;
  const ConstrainedTriangulation made = triangulation_of(run, arguments, file, edges);
  const double ms = clock.ms();
  enforce_distinct(run, file, repeated_points(made.same_as.span()));
  run.progress().step("writing");
  write_planar(
      run, arguments.input, arguments.output,
      {made.mesh, file.points, file.points, made.constrained.span(), "Delaunay triangulation"});
  print_triangulation(run, arguments, file, made, ms);
  return ExitStatus::done;
}

// ---- surfaces

DelaunayOptions flip_options(const DelaunayArguments& arguments) {
  DelaunayOptions options;
  options.test = arguments.test == "in-circle" ? DelaunayTest::in_circle : DelaunayTest::angle_sum;
  options.order = arguments.order == "queue" ? DelaunayOrder::queue : DelaunayOrder::rounds;
  options.max_flips = arguments.max_flips.value_or(options.max_flips);
  return options;
}

struct Flipped {
  DelaunayReport before;  // of a look that changes nothing
  DelaunayReport report;
  Connectivity mesh;
  double ms = 0;
};

template <class Value>
Value value_of(Result<Value>&& result, const std::string& path) {
  if (!result) throw describe(result.error(), path);
  return std::move(*result);
}

Flipped flip_surface(Run& run, const DelaunayArguments& arguments, const OpenedMesh& opened) {
  const Positions positions = opened.kept.positions();
  EditMesh mesh = value_of(EditMesh::of(opened.mesh(), run.execution()), arguments.input);
  DelaunayOptions options = flip_options(arguments);
  options.max_flips = 0;
  Flipped done;
  done.before =
      value_of(flip_to_delaunay(mesh, positions, options, run.execution()), arguments.input);
  const Clock clock;
  done.report = value_of(
      flip_to_delaunay(mesh, positions, flip_options(arguments), run.execution()), arguments.input);
  done.ms = clock.ms();
  // No vertex was added or removed, so positions are where they were.
  done.mesh = value_of(mesh.compact(), arguments.input).mesh;
  return done;
}

void print_flips(Run& run, const DelaunayArguments& arguments, const OpenedMesh& opened,
                 const Flipped& done) {
  const DelaunayReport& report = done.report;
  if (run.is_text()) {
    Table table({{"edges", Table::Align::left}, {"before"}, {"after"}});
    table.add({"fail the test", grouped(done.before.left), grouped(report.left)});
    table.add({"not to be judged", grouped(done.before.undefined), grouped(report.undefined)});
    run.print(fmt::format("{}\n{}: {} flips in {}{}\n", table.text(run.colour()), arguments.output,
                          grouped(report.flips), time_text(done.ms),
                          report.is_cut_short ? "; stopped at --max-flips" : ""));
    return;
  }
  const auto counts = [](const Connectivity& mesh, const DelaunayReport& look) -> Json {
    return {{"vertices", mesh.vertex_count()},
            {"faces", mesh.face_count()},
            {"edges", edge_count(mesh)},
            {"failing_edges", look.left},
            {"undefined_edges", look.undefined}};
  };
  Json json;
  json["input"] = arguments.input;
  json["output"] = arguments.output;
  json["test"] = arguments.test;
  json["order"] = arguments.order;
  json["before"] = counts(opened.mesh(), done.before);
  json["after"] = counts(done.mesh, report);
  json["flips"] = report.flips;
  json["rounds"] = report.rounds;
  json["candidates"] = report.candidates;
  json["postponed"] = report.postponed;
  json["cut_short"] = report.is_cut_short;
  json["timings_ms"] = {
      {"read", opened.file.read_ms}, {"build", opened.built.build_ms}, {"delaunay", done.ms}};
  run.print_json(json);
}

ExitStatus flip_file(Run& run, const DelaunayArguments& arguments) {
  check_output_path(arguments.output);
  if (!arguments.edges.empty()) {
    throw Failure{ExitStatus::usage,
                  "hedgerow",
                  "usage",
                  "--edges is for points (.xy, .csv); a surface has its edges",
                  {}};
  }
  run.progress().begin(4);
  const OpenedMesh opened = open_mesh(run, arguments.input);
  run.progress().step("flipping");
  const Flipped done = flip_surface(run, arguments, opened);
  run.progress().step("writing");
  write_mesh(run, arguments.output,
             soup_of(done.mesh, Buffer<float>::copy_of(opened.kept.xyz.span())));
  print_flips(run, arguments, opened, done);
  return ExitStatus::done;
}

}  // namespace

void add_delaunay(Program& program) {
  const auto arguments = std::make_shared<DelaunayArguments>();
  Command command = program.add_command(
      "delaunay", "Triangulate points in the plane, or flip the edges of a surface",
      "Points (.xy or .csv) are triangulated with exact signs; vertex i is point i. A picture "
      "(.svg)\n"
      "shows edges and points; mesh files hold floats. Of a surface mesh, edges between triangles\n"
      "are flipped until each passes the test, or cannot be flipped without doubling another.",
      "hedgerow delaunay stations.csv network.svg", [arguments](Run& run) {
        return io::is_points_file(arguments->input) ? triangulate_points(run, *arguments)
                                                    : flip_file(run, *arguments);
      });
  command.word("IN", arguments->input, "Points (.xy, .csv) or a mesh to read")
      .word("OUT", arguments->output, "Mesh to write; of points also .svg")
      .text("--edges", "FILE", arguments->edges,
            "Of points: edges to have, as a file (.xy, .csv) of two numbers of points a line, from "
            "0")
      .choice("--test", {"angle-sum", "in-circle"}, arguments->test,
              "Of a mesh: angles across an edge, or circles by x and y, exact")
      .choice("--order", {"rounds", "queue"}, arguments->order,
              "Of a mesh: many flips at once, or one by one")
      .optional_number("--max-flips", {0}, arguments->max_flips, "Of a mesh: stop after so many");
}

}  // namespace hedgerow::tool
