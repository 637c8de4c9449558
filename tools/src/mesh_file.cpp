#include "mesh_file.h"

#include <algorithm>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "clock.h"
#include "failure.h"
#include "hedgerow/io/atomic_file.h"
#include "hedgerow/io/format.h"
#include "hedgerow/io/points.h"
#include "hedgerow/io/read.h"
#include "hedgerow/io/winged_edge.h"
#include "hedgerow/io/write.h"
#include "table.h"

namespace hedgerow::tool {
namespace {

/// The place as the io library writes it, so that paths are quoted in one way only.
std::string place_of(const io::IoError& error) {
  const std::string text = io::to_string(error);
  return text.substr(0, text.find(fmt::format(": error: {}: ", io::name(error.code))));
}

Failure describe_file(const io::IoError& error, ExitStatus status) {
  if (error.code == io::IoErrorCode::too_many_elements) status = ExitStatus::limit;
  return {status, place_of(error), io::name(error.code), error.message, error.details};
}

io::ReadOptions read_options(Run& run) {
  io::ReadOptions options;
  options.keep_out_of_range = run.options().policies[DefectKind::out_of_range] == Action::skip;
  options.keep_non_finite = run.options().keep_non_finite;
  options.progress = [&run](std::int64_t done, std::int64_t total) {
    run.progress().part(done, total);
  };
  return options;
}

void note_warnings(Run& run, const std::string& path,
                   const std::vector<io::ReadWarning>& warnings) {
  for (const io::ReadWarning& warning : warnings) {
    const std::string place = warning.line > 0 ? fmt::format("{}:{}", path, warning.line) : path;
    const std::string more =
        warning.count > 1 ? fmt::format(" ({} times)", grouped(warning.count)) : "";
    run.note(fmt::format("{}: warning: {}: {}{}\n", place, warning.code, warning.message, more));
  }
}

std::string writable_extensions() { return ".obj .ply .off .stl .wet"; }

}  // namespace

MeshFile read_mesh(Run& run, const std::string& path) {
  const Clock clock;
  io::IoResult<io::ReadOutput> output = io::read(path, read_options(run));
  const double read_ms = clock.ms();
  if (!output) throw describe_file(output.error(), ExitStatus::input);
  note_warnings(run, path, output->warnings);
  return {path, std::move(output->soup), read_ms};
}

PointsFile read_points(Run& run, const std::string& path) {
  const Clock clock;
  io::IoResult<io::PointsOutput> output = io::read_points(path, read_options(run));
  const double read_ms = clock.ms();
  if (!output) throw describe_file(output.error(), ExitStatus::input);
  note_warnings(run, path, output->warnings);
  return {path, std::move(output->points), read_ms};
}

void check_output_path(const std::string& path) {
  const std::optional<io::Format> format = io::format_of(path);
  if (format && io::can_write(*format)) return;
  throw Failure{ExitStatus::usage,
                path,
                "unknown-extension",
                "this extension stands for no format that can be written",
                {"can be written: " + writable_extensions()}};
}

void check_output_path(const std::string& path, const std::string& extension) {
  const std::optional<io::Format> format = io::format_of(path);
  if (format && '.' + std::string(io::name(*format)) == extension) return;
  throw Failure{ExitStatus::usage,
                path,
                "unknown-extension",
                fmt::format("the output of this command is a {} file", extension),
                {}};
}

std::int64_t write_mesh(Run& run, const std::string& path, const Soup& soup,
                        const Buffer<float>& normals) {
  io::WriteInput input;
  input.positions = soup.positions();
  input.faces = soup.face_list();
  input.normals = {normals.data(), static_cast<std::int64_t>(normals.size() / 3)};
  io::WriteOptions options;
  options.progress = [&run](std::int64_t done, std::int64_t total) {
    run.progress().part(done, total);
  };
  const io::IoResult<io::WriteOutput> output = io::write(path, input, options);
  if (!output) {
    const bool is_mesh_bad = output.error().code == io::IoErrorCode::bad_mesh;
    throw describe_file(output.error(), is_mesh_bad ? ExitStatus::input : ExitStatus::output);
  }
  if (output->split_face_count > 0) {
    run.note(fmt::format("{}: warning: polygons-split: {} polygons were cut into triangles\n", path,
                         grouped(output->split_face_count)));
  }
  if (output->dropped_face_count > 0) {
    run.note(fmt::format("{}: warning: faces-dropped: {} faces have fewer than three corners\n",
                         path, grouped(output->dropped_face_count)));
  }
  return output->byte_count;
}

WingedEdgeTables read_tables(Run& run, const std::string& path) {
  io::IoResult<WingedEdgeTables> tables = io::read_winged_edges(path, read_options(run));
  if (!tables) throw describe_file(tables.error(), ExitStatus::input);
  return std::move(*tables);
}

std::int64_t write_tables(const std::string& path, const WingedEdgeTables& tables) {
  const io::IoResult<io::WriteOutput> output = io::write_winged_edges(path, tables);
  if (!output) throw describe_file(output.error(), ExitStatus::output);
  return output->byte_count;
}

void write_text(const std::string& path, const std::string& text) {
  const io::IoResult<void> output = io::write_file_atomically(path, text);
  if (!output) throw describe_file(output.error(), ExitStatus::output);
}

}  // namespace hedgerow::tool
