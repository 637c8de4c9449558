#include "ply_header.h"
#include "ply_mesh.h"
#include "read_context.h"
#include "text_cursor.h"

namespace hedgerow::io {

Parsed<Soup> read_ply(ReadContext& context) {
  const Parsed<PlyHeader> header = read_ply_header(context.bytes);
  if (!header) {
    // Sixteen-bit text fails at its first byte; say why.
    if (std::optional<Failure> failed =
            check_is_text(context.bytes.first(std::min<std::size_t>(context.bytes.size(), 16)));
        failed && failed->code == IoErrorCode::utf16_text) {
      return tl::unexpected<Failure>(std::move(*failed));
    }
    return tl::unexpected<Failure>(header.error());
  }
  const bool is_ascii = header->format == PlyFormat::ascii;
  if (is_ascii) {
    if (std::optional<Failure> failed = check_is_text(context.bytes)) {
      return tl::unexpected<Failure>(std::move(*failed));
    }
  }
  PlyMesh mesh(context, *header, is_ascii ? Place::text : Place::binary);
  const bool is_read =
      is_ascii ? read_ply_ascii_body(*header, mesh) : read_ply_binary_body(*header, mesh);
  if (!is_read) return tl::unexpected<Failure>(mesh.take_failure());
  return mesh.take_soup();
}

}  // namespace hedgerow::io
