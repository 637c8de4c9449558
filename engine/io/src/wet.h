#pragma once

#include <string>

#include "hedgerow/winged_edge.h"
#include "output.h"
#include "read_context.h"

namespace hedgerow::io {

/// Consistent tables, or why there are none.
[[nodiscard]] Parsed<WingedEdgeTables> parse_wet(ReadContext& context);

/// The corners of the faces of consistent tables.
[[nodiscard]] Soup soup_of(WingedEdgeTables&& tables);

/// "edges row 3, column next_cw: found 9, consistent would be 4"; numbers from 1. `found` is quoted
/// as it is, since a file may hold numbers that no index can.
[[nodiscard]] std::string describe(const WingedFault& fault, const std::string& found);

/// \pre the tables are consistent and have positions
void write_wet(const WingedEdgeTables& tables, Output& out);

/// The tables of faces, by a build; bad_mesh where they cannot be held. \pre the input was checked
[[nodiscard]] Parsed<WingedEdgeTables> tables_of(const WriteInput& input);

}  // namespace hedgerow::io
