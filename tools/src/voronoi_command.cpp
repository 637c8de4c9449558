#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "clock.h"
#include "commands.h"
#include "failure.h"
#include "hedgerow/voronoi.h"
#include "mesh_file.h"
#include "planar_output.h"
#include "table.h"

namespace hedgerow::tool {
namespace {

struct VoronoiArguments {
  std::string input;
  std::string output;
  std::vector<double> box;  ///< of four, or empty
};

struct Areas {
  double sum = 0;
  double smallest = 0;
  double largest = 0;
};
Areas areas_of(const Voronoi& diagram) {
  Areas areas;
  for (Index f = 0; f < diagram.mesh.face_count(); ++f) {
    const double area = cell_area(diagram, FaceId(f));
    areas.sum += area;
    areas.smallest = f == 0 ? area : std::min(areas.smallest, area);
    areas.largest = std::max(areas.largest, area);
  }
  return areas;
}

Repeated repeated_points(const PointsFile& file, const Voronoi& diagram) {
  const std::span<const Index> sites = diagram.sites.span();
  Repeated repeated{static_cast<Index>(file.points.size() - sites.size()), 0};
  while (repeated.first < static_cast<Index>(sites.size()) &&
         sites[static_cast<std::size_t>(repeated.first)] == repeated.first) {
    ++repeated.first;
  }
  return repeated;
}

std::vector<Point2> distinct_points(const PointsFile& file, const Voronoi& diagram) {
  std::vector<Point2> points;
  for (const Index site : diagram.sites)
    points.push_back(file.points[static_cast<std::size_t>(site)]);
  return points;
}

Failure describe_box(const Error& error, const PointsFile& file, const Box2& box) {
  const Point2& site = file.points[static_cast<std::size_t>(error.element)];
  Failure failure{
      ExitStatus::usage,
      file.path,
      name(error.code),
      fmt::format("point {} at {}, {} is not inside the box from {}, {} to {}, {}", error.element,
                  site[0], site[1], box.low[0], box.low[1], box.high[0], box.high[1]),
      {}};
  if (error.count > 1) failure.details.push_back(fmt::format("{} in all", error.count));
  return failure;
}

void print_report(Run& run, const VoronoiArguments& arguments, const PointsFile& file,
                  const Box2& box, const Voronoi& diagram, double ms) {
  const Areas areas = areas_of(diagram);
  const double box_area = (box.high[0] - box.low[0]) * (box.high[1] - box.low[1]);
  const Index repeated = repeated_points(file, diagram).count;
  if (run.is_text()) {
    Table table({{"Voronoi diagram", Table::Align::left}, {"count"}});
    table.add({"points", grouped(static_cast<std::int64_t>(file.points.size()))});
    table.add({"of those, at the place of an earlier one", grouped(repeated)});
    table.add({"cells", grouped(diagram.mesh.face_count())});
    table.add({"vertices", grouped(diagram.mesh.vertex_count())});
    table.add({"edges", grouped(edge_count(diagram.mesh))});
    run.print(fmt::format("{}\n{}: cells of {:.6g} to {:.6g} in a box of {:.6g}; in {}\n",
                          table.text(run.colour()), arguments.output, areas.smallest, areas.largest,
                          box_area, time_text(ms)));
    return;
  }
  Json json;
  json["input"] = arguments.input;
  json["output"] = arguments.output;
  json["before"] = {{"points", file.points.size()}, {"repeated_points", repeated}};
  json["after"] = {{"vertices", diagram.mesh.vertex_count()},
                   {"faces", diagram.mesh.face_count()},
                   {"edges", edge_count(diagram.mesh)}};
  json["box"] = {box.low[0], box.low[1], box.high[0], box.high[1]};
  json["box_area"] = box_area;
  json["cell_area"] = {{"sum", areas.sum}, {"min", areas.smallest}, {"max", areas.largest}};
  json["timings_ms"] = {{"read", file.read_ms}, {"voronoi", ms}};
  run.print_json(json);
}

ExitStatus write_voronoi(Run& run, const VoronoiArguments& arguments) {
  check_planar_output_path(arguments.output);
  run.progress().begin(3);
  run.progress().step("reading");
  const PointsFile file = read_points(run, arguments.input);
  const Box2 box = arguments.box.empty() ? box_round(file.points)
                                         : Box2{{arguments.box[0], arguments.box[1]},
                                                {arguments.box[2], arguments.box[3]}};
  run.progress().step("cells");
  const Clock clock;
  Result<Voronoi> diagram = voronoi(file.points, box, run.execution());
  const double ms = clock.ms();
  if (!diagram && diagram.error().code == ErrorCode::site_outside_box) {
    throw describe_box(diagram.error(), file, box);
  }
  if (!diagram) throw describe(diagram.error(), arguments.input);
  enforce_distinct(run, file, repeated_points(file, *diagram));
  run.progress().step("writing");
  write_planar(run, arguments.input, arguments.output,
               {diagram->mesh,
                diagram->points.span(),
                distinct_points(file, *diagram),
                {},
                "Voronoi diagram"});
  print_report(run, arguments, file, box, *diagram, ms);
  return ExitStatus::done;
}

}  // namespace

void add_voronoi(Program& program) {
  const auto arguments = std::make_shared<VoronoiArguments>();
  Command command =
      program.add_command("voronoi", "Divide a box into the cells of points in the plane",
                          "Cells are polygons and face i is the cell of point i, unless points "
                          "repeat. A picture (.svg)\n"
                          "shows cells and points; mesh files hold floats.",
                          "hedgerow voronoi stations.csv cells.svg --box 0,0,100,80",
                          [arguments](Run& run) { return write_voronoi(run, *arguments); });
  command.word("POINTS", arguments->input, "Points to read: .xy or .csv")
      .word("OUT", arguments->output, "File to write: .svg, .obj, .ply, .off or .stl")
      .numbers("--box", 4, arguments->box,
               "X and y of its lower left and its upper right corner, all points inside; "
               "without it a tenth larger than the points need");
}

}  // namespace hedgerow::tool
