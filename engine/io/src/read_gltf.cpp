// glTF 2.0 and its binary container. tinygltf turns the JSON into structures; every reference,
// range and type that is used here is checked here.
#include <cmath>

#include "binary_value.h"
#include "compose.h"
#include "face_collector.h"
#include "gltf_asset.h"
#include "json_text.h"
#include "strips.h"
#include "text_cursor.h"
#include "tiny_gltf_config.h"

namespace hedgerow::io {

namespace {

// Primitives may share accessors, so that a small file can ask for any amount of memory. No real
// asset comes near this many bytes of mesh for each byte of file.
constexpr std::size_t kMostGrowth = 64;
constexpr std::size_t kAlwaysAllowed = std::size_t{64} << 20;

class GltfReader {
 public:
  GltfReader(ReadContext& context, const GltfSource& source)
      : context_(context), source_(source), strips_(faces_) {}

  Parsed<Soup> read() {
    if (std::optional<Failure> failed = check_json(source_.json)) {
      return failure(failed->code, source_.json_offset + failed->offset, source_.place,
                     failed->message);
    }
    if (Parsed<void> loaded = load_gltf_model(context_, source_, model_); !loaded) {
      return tl::unexpected<Failure>(loaded.error());
    }
    budget_ = kAlwaysAllowed + kMostGrowth * context_.bytes.size();
    for (const tinygltf::Buffer& buffer : model_.buffers)
      budget_ += kMostGrowth * buffer.data.size();
    for (std::size_t m = 0; m < model_.meshes.size(); ++m) {
      for (std::size_t p = 0; p < model_.meshes[m].primitives.size(); ++p) {
        pointer_ = compose("/meshes/{}/primitives/{}", m, p);
        if (Parsed<void> done = add_primitive(model_.meshes[m].primitives[p]); !done) {
          return tl::unexpected<Failure>(done.error());
        }
      }
    }
    Soup soup;
    soup.xyz = xyz_.take();
    faces_.move_into(soup);
    return soup;
  }

 private:
  tl::unexpected<Failure> fail(IoErrorCode code, std::string_view pointer, std::string message) {
    return gltf_failure(source_, code, pointer, std::move(message));
  }
  tl::unexpected<Failure> fail(IoErrorCode code, std::string message) {
    return fail(code, pointer_, std::move(message));
  }

  Parsed<void> add_primitive(const tinygltf::Primitive& primitive) {
    const bool has_faces = primitive.mode == TINYGLTF_MODE_TRIANGLES ||
                           primitive.mode == TINYGLTF_MODE_TRIANGLE_STRIP ||
                           primitive.mode == TINYGLTF_MODE_TRIANGLE_FAN;
    const auto position = primitive.attributes.find("POSITION");
    if (!has_faces && (primitive.mode < 0 || primitive.mode > 3)) {
      return fail(IoErrorCode::bad_gltf, compose("the mode is {}", primitive.mode));
    }
    if (!has_faces || position == primitive.attributes.end()) {
      context_.warn("skipped-primitive", source_.json_offset, Place::binary,
                    compose("{} has {}", pointer_,
                            has_faces ? "no positions" : "points or lines instead of faces"));
      return {};
    }
    const std::string where = pointer_ + "/attributes/POSITION";
    Parsed<GltfElements> points = GltfElements::find(source_, model_, position->second, where);
    if (!points) return tl::unexpected<Failure>(std::move(points.error()));
    if (Parsed<void> added = add_points(*points, position->second); !added) return added;
    if (primitive.indices < 0) return add_faces(nullptr, points->count(), primitive);

    const std::string indices_at = pointer_ + "/indices";
    Parsed<GltfElements> indices =
        GltfElements::find(source_, model_, primitive.indices, indices_at);
    if (!indices) return tl::unexpected<Failure>(std::move(indices.error()));
    const int type = indices->component_type();
    if (indices->type() != TINYGLTF_TYPE_SCALAR || indices->is_normalized() ||
        (type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE &&
         type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT &&
         type != TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)) {
      return fail(IoErrorCode::bad_accessor, compose("/accessors/{}", primitive.indices),
                  "indices must be unsigned integers of 8, 16 or 32 bits");
    }
    return add_faces(&*indices, points->count(), primitive);
  }

  Parsed<void> spend(std::size_t count, std::size_t bytes_each) {
    if (count > budget_ / bytes_each) {
      return fail(
          IoErrorCode::count_too_large,
          compose("the mesh would have more than {} times the bytes of the file", kMostGrowth));
    }
    budget_ -= count * bytes_each;
    return {};
  }

  Parsed<void> add_points(const GltfElements& points, int accessor) {
    const std::string place = compose("/accessors/{}", accessor);
    if (points.component_type() != TINYGLTF_COMPONENT_TYPE_FLOAT ||
        points.type() != TINYGLTF_TYPE_VEC3 || points.is_normalized()) {
      return fail(IoErrorCode::bad_accessor, place, "positions must be VEC3 of float");
    }
    first_vertex_ = xyz_.size() / 3;
    if (Parsed<void> spent = spend(points.count(), 3 * sizeof(float)); !spent) return spent;
    if (points.count() > static_cast<std::size_t>(kMaxCount) - first_vertex_) {
      return fail(IoErrorCode::too_many_elements, compose("more than {} vertices", kMaxCount));
    }
    float* xyz = xyz_.append(3 * points.count());
    const auto copy = [xyz](std::size_t i, const char* bytes) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        xyz[3 * i + axis] =
            bytes == nullptr ? 0.0f : load_little_endian<float>(bytes + sizeof(float) * axis);
      }
    };
    for (std::size_t i = 0; i < points.count(); ++i) copy(i, points[i]);
    points.for_each_replaced(copy);
    if (context_.options.keep_non_finite) return {};
    for (std::size_t i = 0; i < 3 * points.count(); ++i) {
      if (!std::isfinite(xyz[i])) {
        return fail(IoErrorCode::non_finite, place,
                    compose("coordinate {} of element {} is {}", "xyz"[i % 3], i / 3, xyz[i]));
      }
    }
    return {};
  }

  // `indices` null: the points themselves, in order.
  Parsed<void> add_faces(const GltfElements* indices, std::size_t point_count,
                         const tinygltf::Primitive& primitive) {
    const std::size_t count = indices == nullptr ? point_count : indices->count();
    if (Parsed<void> spent = spend(count, 3 * sizeof(Index)); !spent) return spent;
    if (faces_.is_full(3 * std::min(count, static_cast<std::size_t>(kMaxCount) / 3))) {
      return fail(IoErrorCode::too_many_elements, compose("more than {} corners", kMaxCount));
    }
    std::vector<Index> vertices(count);
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t index =
          indices == nullptr ? i : gltf_index((*indices)[i], indices->component_type());
      if (Parsed<void> set = set_vertex(vertices[i], index, i, point_count, primitive); !set) {
        return set;
      }
    }
    if (indices != nullptr) {
      Parsed<void> result;
      indices->for_each_replaced([&](std::size_t i, const char* bytes) {
        const std::uint32_t index = gltf_index(bytes, indices->component_type());
        if (result) result = set_vertex(vertices[i], index, i, point_count, primitive);
      });
      if (!result) return result;
    }
    emit(vertices, primitive.mode);
    return {};
  }

  Parsed<void> set_vertex(Index& vertex, std::size_t index, std::size_t i, std::size_t point_count,
                          const tinygltf::Primitive& primitive) {
    if (index < point_count) {
      vertex = static_cast<Index>(first_vertex_ + index);
      return {};
    }
    // Beyond its own primitive an index would mean a vertex of the next one.
    vertex = kInvalidIndex;
    if (context_.options.keep_out_of_range) return {};
    const std::size_t face = primitive.mode == TINYGLTF_MODE_TRIANGLES
                                 ? faces_.face_count() + i / 3
                                 : faces_.face_count() + (i < 2 ? 0 : i - 2);
    return fail(IoErrorCode::index_out_of_range, pointer_ + "/indices",
                compose("face {} refers to vertex {} (index {} of the accessor), the primitive "
                        "has {}",
                        face, index, i, point_count));
  }

  void emit(const std::vector<Index>& vertices, int mode) {
    if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
      strips_.restart();
      for (const Index vertex : vertices) strips_.add(vertex);
      return;
    }
    const bool is_fan = mode == TINYGLTF_MODE_TRIANGLE_FAN;
    for (std::size_t i = 2; i < vertices.size(); i += is_fan ? 1 : 3) {
      faces_.add_corner(vertices[is_fan ? 0 : i - 2]);
      faces_.add_corner(vertices[i - 1]);
      faces_.add_corner(vertices[i]);
      faces_.end_face();
    }
    if (!is_fan && vertices.size() % 3 != 0) {
      context_.warn(
          "incomplete-triangle", source_.json_offset, Place::binary,
          compose("{}: {} indices are no whole number of triangles", pointer_, vertices.size()));
    }
  }

  ReadContext& context_;
  const GltfSource& source_;
  tinygltf::Model model_;
  GrowBuffer<float> xyz_;
  FaceCollector faces_;
  StripDecoder strips_;
  std::string pointer_;
  std::size_t first_vertex_ = 0;
  std::size_t budget_ = 0;
};

struct Chunk {
  std::uint32_t type = 0;
  std::size_t offset = 0;  ///< of its data
  std::size_t bytes = 0;
};

Parsed<Chunk> read_chunk(std::span<const char> bytes, std::size_t at) {
  if (bytes.size() - at < 8) {
    return failure(IoErrorCode::unexpected_end, at, Place::binary,
                   "the asset ends inside the header of a chunk");
  }
  const std::size_t length = load_little_endian<std::uint32_t>(bytes.data() + at);
  const std::size_t left = bytes.size() - at - 8;
  if (length > left) {
    return failure(IoErrorCode::size_mismatch, at, Place::binary,
                   compose("a chunk of {} bytes is declared, {} are left", length, left));
  }
  return Chunk{load_little_endian<std::uint32_t>(bytes.data() + at + 4), at + 8, length};
}

constexpr std::uint32_t kJsonChunk = 0x4e4f534a;
constexpr std::uint32_t kBinaryChunk = 0x004e4942;
constexpr std::size_t kGlbHeaderBytes = 12;

Parsed<void> check_glb_header(std::span<const char> bytes) {
  const std::string_view magic(bytes.data(), std::min<std::size_t>(bytes.size(), 4));
  if (magic != "glTF") {
    return failure(IoErrorCode::bad_header, 0, Place::binary,
                   "the file begins with " + in_quotes(magic) + " instead of \"glTF\"");
  }
  if (bytes.size() < kGlbHeaderBytes) {
    return failure(IoErrorCode::unexpected_end, bytes.size(), Place::binary,
                   "the file ends inside its header");
  }
  const auto version = load_little_endian<std::uint32_t>(bytes.data() + 4);
  if (version != 2) {
    return failure(IoErrorCode::unsupported_variant, 4, Place::binary,
                   compose("version {} of the container; only 2 is read", version));
  }
  const auto length = load_little_endian<std::uint32_t>(bytes.data() + 8);
  if (length > bytes.size() || length < kGlbHeaderBytes) {
    return failure(IoErrorCode::size_mismatch, 8, Place::binary,
                   compose("{} bytes are declared, the file has {}", length, bytes.size()));
  }
  return {};
}

}  // namespace

Parsed<Soup> read_gltf(ReadContext& context) {
  if (std::optional<Failure> failed = check_is_text(context.bytes)) {
    return tl::unexpected<Failure>(std::move(*failed));
  }
  const std::size_t mark = byte_order_mark_size(context.bytes);
  GltfSource source;
  source.json = std::string_view(context.bytes.data(), context.bytes.size()).substr(mark);
  source.json_offset = mark;
  return GltfReader(context, source).read();
}

Parsed<Soup> read_glb(ReadContext& context) {
  if (const Parsed<void> checked = check_glb_header(context.bytes); !checked) {
    return tl::unexpected<Failure>(checked.error());
  }
  const std::size_t length = load_little_endian<std::uint32_t>(context.bytes.data() + 8);
  const std::span<const char> bytes = context.bytes.first(length);
  if (length != context.bytes.size()) {
    context.warn("trailing-bytes", length, Place::binary,
                 compose("{} bytes behind the asset", context.bytes.size() - length));
  }
  const Parsed<Chunk> json = read_chunk(bytes, kGlbHeaderBytes);
  if (!json) return tl::unexpected<Failure>(json.error());
  if (json->type != kJsonChunk) {
    return failure(IoErrorCode::bad_header, kGlbHeaderBytes + 4, Place::binary,
                   "the first chunk is not JSON");
  }
  GltfSource source;
  source.place = Place::binary;
  source.json = std::string_view(bytes.data() + json->offset, json->bytes);
  source.json_offset = json->offset;
  const std::size_t next = json->offset + json->bytes;
  if (next < bytes.size()) {
    const Parsed<Chunk> binary = read_chunk(bytes, next);
    if (!binary) return tl::unexpected<Failure>(binary.error());
    if (binary->type == kBinaryChunk) {
      source.binary_chunk = bytes.subspan(binary->offset, binary->bytes);
    }
  }
  return GltfReader(context, source).read();
}

}  // namespace hedgerow::io
