// Winged-edge tables as text; the format is described in winged_edge.h.
#include <array>
#include <iterator>
#include <utility>

#include "compose.h"
#include "face_collector.h"
#include "text_cursor.h"
#include "wet.h"

namespace hedgerow::io {

namespace {

constexpr const char* kTables[] = {"vertices", "faces", "edges"};
constexpr std::size_t kFewestBytes[] = {8, 2, 16};  // of a row: a digit and a blank for each entry

class WetReader {
 public:
  WetReader(ReadContext& context, TextCursor cursor) : context_(context), cursor_(cursor) {}

  Parsed<WingedEdgeTables> read() {
    if (!read_version() || !read_vertices() || !read_faces() || !read_edges() || !read_end()) {
      return tl::unexpected<Failure>(std::move(failure_));
    }
    const std::vector<WingedFault> faults = check_winged_edges(tables_);
    if (faults.empty()) return std::move(tables_);
    report(faults.front(), faults.size());
    return tl::unexpected<Failure>(std::move(failure_));
  }

 private:
  bool fail(IoErrorCode code, const char* place, std::string message) {
    failure_ = Failure{code, cursor_.offset_of(place), Place::text, std::move(message)};
    return false;
  }
  std::string_view word_at(const char* place) const {
    TextCursor there = cursor_;
    there.set_position(place);
    const std::string_view word = there.word();
    return word.substr(0, word.find('#'));
  }
  bool end_line() {
    if (cursor_.ends_before_comment()) return true;
    return fail(
        IoErrorCode::unexpected_word, cursor_.position(),
        compose("{} follows the last value of this line", in_quotes(word_at(cursor_.position()))));
  }

  bool read_version() {
    cursor_.skip_space_and_comments();
    const char* place = cursor_.position();
    if (word_at(place) != "wet") {
      return fail(IoErrorCode::bad_header, place, "the first word is not \"wet\"");
    }
    cursor_.set_position(place + 3);
    std::int64_t version = 0;
    if (cursor_.ends_before_comment()) {
      return fail(IoErrorCode::missing_value, cursor_.position(), "no version behind \"wet\"");
    }
    place = cursor_.position();
    if (cursor_.read_integer(version) != NumberStatus::ok || !cursor_.at_word_end() ||
        version != 1) {
      return fail(IoErrorCode::unsupported_variant, place,
                  compose("version {}; only 1 is read", in_quotes(word_at(place))));
    }
    return end_line();
  }

  bool read_count(WingedTable table, std::size_t& count) {
    const auto i = static_cast<std::size_t>(table);
    cursor_.skip_space_and_comments();
    const char* place = cursor_.position();
    const std::string_view word = word_at(place);
    if (cursor_.at_end() || word != kTables[i]) {
      const auto code =
          cursor_.at_end() ? IoErrorCode::unexpected_end : IoErrorCode::unexpected_word;
      return fail(code, place,
                  compose("\"{}\" and a count are required here, not {}", kTables[i],
                          cursor_.at_end() ? "the end" : in_quotes(word)));
    }
    cursor_.set_position(place + word.size());
    if (cursor_.ends_before_comment()) {
      return fail(IoErrorCode::missing_value, cursor_.position(),
                  compose("the number of {} is missing", kTables[i]));
    }
    place = cursor_.position();
    std::int64_t value = 0;
    const NumberStatus status = cursor_.read_integer(value);
    if (status == NumberStatus::bad || !cursor_.at_word_end() || value < 0) {
      return fail(IoErrorCode::bad_count, place,
                  compose("the number of {} is {}", kTables[i], in_quotes(word_at(place))));
    }
    const auto left = static_cast<std::size_t>(cursor_.end() - cursor_.position());
    const std::size_t most = (left + 1) / kFewestBytes[i];
    if (status == NumberStatus::too_large || static_cast<std::uint64_t>(value) > most) {
      return fail(IoErrorCode::count_too_large, place,
                  compose("{} {} are declared, the {} bytes left hold at most {}",
                          in_quotes(word_at(place)), kTables[i], left, most));
    }
    // Sides are numbered, two an edge.
    if (value > kMaxCount / 2) {
      return fail(IoErrorCode::too_many_elements, place,
                  compose("{} {}; at most {} can be read", value, kTables[i], kMaxCount / 2));
    }
    count = static_cast<std::size_t>(value);
    if (!end_line()) return false;
    start_of_[i] = cursor_.position();
    return true;
  }

  bool begin_row(WingedTable table, std::size_t row, std::size_t count) {
    cursor_.skip_space_and_comments();
    context_.progress.at(cursor_.offset());
    if (!cursor_.at_end()) return true;
    return fail(IoErrorCode::unexpected_end, cursor_.end(),
                compose("the file ends before {} row {} of {}", name(table), row + 1, count));
  }

  // 0 is none; a number that no row can have becomes one that no row has.
  bool read_reference(WingedTable table, std::size_t row, const char* column, Index& value) {
    const char* place = cursor_.position();
    if (cursor_.ends_before_comment()) {
      return fail(IoErrorCode::missing_value, cursor_.position(),
                  compose("{} row {} has no {}", name(table), row + 1, column));
    }
    place = cursor_.position();
    std::int64_t number = 0;
    const NumberStatus status = cursor_.read_integer(number);
    if (status == NumberStatus::bad || !cursor_.at_word_end()) {
      return fail(IoErrorCode::bad_number, place,
                  compose("{} of {} row {} is {}, which is no number", column, name(table), row + 1,
                          in_quotes(word_at(place))));
    }
    const bool fits = status == NumberStatus::ok && number >= 0 && number <= kMaxCount;
    value = fits ? static_cast<Index>(number - 1) : kMaxCount;
    return true;
  }

  bool read_coordinate(std::size_t row, int axis, float& value) {
    if (cursor_.ends_before_comment()) {
      return fail(IoErrorCode::missing_value, cursor_.position(),
                  compose("vertices row {} has {} of 3 coordinates", row + 1, axis));
    }
    const char* place = cursor_.position();
    const NumberStatus status = cursor_.read_float(value);
    if (status == NumberStatus::ok) return true;
    if (status == NumberStatus::non_finite && context_.options.keep_non_finite) return true;
    const bool is_number = status == NumberStatus::non_finite;
    return fail(is_number ? IoErrorCode::non_finite : IoErrorCode::bad_number, place,
                compose("{} of vertices row {} is {}{}", "xyz"[axis], row + 1,
                        in_quotes(word_at(place)), is_number ? "" : ", which is no number"));
  }

  bool read_vertices() {
    std::size_t count = 0;
    if (!read_count(WingedTable::vertices, count)) return false;
    tables_.xyz = Buffer<float>(3 * count);
    tables_.vertex_edge = Buffer<EdgeId>(count);
    for (std::size_t v = 0; v < count; ++v) {
      if (!begin_row(WingedTable::vertices, v, count)) return false;
      for (int axis = 0; axis < 3; ++axis) {
        const std::size_t i = 3 * v + static_cast<std::size_t>(axis);
        if (!read_coordinate(v, axis, tables_.xyz[i])) return false;
      }
      Index& edge = tables_.vertex_edge[v].value;
      if (!read_reference(WingedTable::vertices, v, "edge", edge) || !end_line()) return false;
    }
    return true;
  }

  bool read_faces() {
    std::size_t count = 0;
    if (!read_count(WingedTable::faces, count)) return false;
    tables_.face_edge = Buffer<EdgeId>(count);
    for (std::size_t f = 0; f < count; ++f) {
      if (!begin_row(WingedTable::faces, f, count)) return false;
      Index& edge = tables_.face_edge[f].value;
      if (!read_reference(WingedTable::faces, f, "edge", edge) || !end_line()) return false;
    }
    return true;
  }

  bool read_edges() {
    std::size_t count = 0;
    if (!read_count(WingedTable::edges, count)) return false;
    tables_.edges = Buffer<WingedEdge>(count);
    for (std::size_t e = 0; e < count; ++e) {
      if (!begin_row(WingedTable::edges, e, count)) return false;
      std::array<Index, 8> entry{};
      for (std::size_t c = 0; c < entry.size(); ++c) {
        const char* column = name(static_cast<WingedColumn>(c + 1));
        if (!read_reference(WingedTable::edges, e, column, entry[c])) return false;
      }
      if (!end_line()) return false;
      tables_.edges[e] = {VertexId(entry[0]), VertexId(entry[1]), EdgeId(entry[2]),
                          EdgeId(entry[3]),   EdgeId(entry[4]),   EdgeId(entry[5]),
                          FaceId(entry[6]),   FaceId(entry[7])};
    }
    return true;
  }

  bool read_end() {
    cursor_.skip_space_and_comments();
    return cursor_.at_end() ||
           fail(IoErrorCode::unexpected_word, cursor_.position(),
                compose("{} follows the last row", in_quotes(word_at(cursor_.position()))));
  }

  // Looks the entry up in the text again, for its place and its digits.
  void report(const WingedFault& fault, std::size_t fault_count) {
    cursor_.set_position(start_of_[static_cast<std::size_t>(fault.table)]);
    cursor_.skip_space_and_comments();
    for (Index row = 0; row < fault.row; ++row) {
      cursor_.skip_to_line_end();
      cursor_.skip_space_and_comments();
    }
    std::size_t skipped = fault.table == WingedTable::vertices ? 3 : 0;
    if (fault.table == WingedTable::edges) skipped = static_cast<std::size_t>(fault.column) - 1;
    for (; skipped > 0; --skipped) {
      static_cast<void>(cursor_.word());
      cursor_.skip_blanks();
    }
    const char* place = cursor_.position();
    std::string message = describe(fault, std::string(word_at(place)));
    if (fault_count > 1) message += compose("; {} entries in all", fault_count);
    fail(IoErrorCode::inconsistent_table, place, std::move(message));
  }

  ReadContext& context_;
  TextCursor cursor_;
  std::array<const char*, 3> start_of_{};  // behind the count of each table
  WingedEdgeTables tables_;
  Failure failure_;
};

}  // namespace

Parsed<WingedEdgeTables> parse_wet(ReadContext& context) {
  if (std::optional<Failure> failed = check_is_text(context.bytes)) {
    return tl::unexpected<Failure>(std::move(*failed));
  }
  TextCursor cursor(context.bytes);
  cursor.set_position(cursor.position() + byte_order_mark_size(context.bytes));
  return WetReader(context, cursor).read();
}

Soup soup_of(WingedEdgeTables&& tables) {
  const WingedEdgeView view(tables);
  FaceCollector faces;
  for (Index f = 0; f < tables.face_count(); ++f) {
    if (!tables.face_edge[static_cast<std::size_t>(f)].valid()) {
      faces.end_face();
      continue;
    }
    const HalfedgeId start = view.first(FaceId(f));
    HalfedgeId s = start;
    do {
      faces.add_corner(view.origin[s].value);
      s = view.next(s);
    } while (s != start);
    faces.end_face();
  }
  Soup soup;
  faces.move_into(soup);
  soup.xyz = std::move(tables.xyz);
  return soup;
}

Parsed<Soup> read_wet(ReadContext& context) {
  Parsed<WingedEdgeTables> tables = parse_wet(context);
  if (!tables) return tl::unexpected<Failure>(std::move(tables.error()));
  return soup_of(std::move(*tables));
}

std::string describe(const WingedFault& fault, const std::string& found) {
  return compose("{} row {}, column {}: found {}, consistent would be {}", name(fault.table),
                 fault.row + 1, name(fault.column), found, fault.expected + 1);
}

}  // namespace hedgerow::io
