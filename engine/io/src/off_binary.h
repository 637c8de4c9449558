#pragma once

#include "off_header.h"
#include "read_context.h"

namespace hedgerow::io {

/// Reads what follows the line "OFF BINARY", from `body_offset` on.
[[nodiscard]] Parsed<Soup> read_off_binary(ReadContext& context, const OffVariant& variant,
                                           std::size_t body_offset);

}  // namespace hedgerow::io
