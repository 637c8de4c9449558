#include <span>

#include "binary_value.h"
#include "compose.h"
#include "gltf_asset.h"
#include "tiny_gltf_config.h"

namespace hedgerow::io {

namespace {

struct Span {
  const char* data = nullptr;
  std::size_t bytes = 0;
  std::size_t stride = 0;  ///< 0: packed
};

Parsed<Span> find_view(const GltfSource& source, const tinygltf::Model& model, int index,
                       const std::string& pointer) {
  if (index < 0 || static_cast<std::size_t>(index) >= model.bufferViews.size()) {
    return gltf_failure(source, IoErrorCode::bad_accessor, pointer,
                        compose("buffer view {} of {}", index, model.bufferViews.size()));
  }
  const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(index)];
  const std::string view_pointer = compose("/bufferViews/{}", index);
  if (view.buffer < 0 || static_cast<std::size_t>(view.buffer) >= model.buffers.size()) {
    return gltf_failure(source, IoErrorCode::bad_accessor, view_pointer,
                        compose("buffer {} of {}", view.buffer, model.buffers.size()));
  }
  const auto& data = model.buffers[static_cast<std::size_t>(view.buffer)].data;
  if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset) {
    return gltf_failure(source, IoErrorCode::bad_accessor, view_pointer,
                        compose("bytes {} and {} more of a buffer of {}", view.byteOffset,
                                view.byteLength, data.size()));
  }
  return Span{reinterpret_cast<const char*>(data.data()) + view.byteOffset, view.byteLength,
              view.byteStride};
}

// `count` elements of `bytes` each, `stride` apart, from `offset` on, must end inside the view.
bool fits(const Span& view, std::size_t offset, std::size_t count, std::size_t bytes,
          std::size_t stride) noexcept {
  if (count == 0) return true;
  if (offset > view.bytes || bytes > view.bytes - offset) return false;
  return count - 1 <= (view.bytes - offset - bytes) / stride;
}

}  // namespace

std::uint32_t gltf_index(const char* bytes, int component_type) noexcept {
  if (bytes == nullptr) return 0;
  switch (component_type) {
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
      return load_little_endian<std::uint8_t>(bytes);
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
      return load_little_endian<std::uint16_t>(bytes);
    default:
      return load_little_endian<std::uint32_t>(bytes);
  }
}

Parsed<GltfElements> GltfElements::find(const GltfSource& source, const tinygltf::Model& model,
                                        int index, std::string_view pointer) {
  if (index < 0 || static_cast<std::size_t>(index) >= model.accessors.size()) {
    return gltf_failure(source, IoErrorCode::bad_accessor, pointer,
                        compose("accessor {} of {}", index, model.accessors.size()));
  }
  const tinygltf::Accessor& accessor = model.accessors[static_cast<std::size_t>(index)];
  const std::string place = compose("/accessors/{}", index);
  const int component_bytes =
      tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(accessor.componentType));
  const int component_count =
      tinygltf::GetNumComponentsInType(static_cast<std::uint32_t>(accessor.type));
  if (component_bytes <= 0 || component_count <= 0) {
    return gltf_failure(source, IoErrorCode::bad_accessor, place, "unknown type");
  }
  GltfElements elements;
  elements.count_ = accessor.count;
  elements.component_type_ = accessor.componentType;
  elements.type_ = accessor.type;
  elements.is_normalized_ = accessor.normalized;
  elements.element_bytes_ =
      static_cast<std::size_t>(component_bytes) * static_cast<std::size_t>(component_count);
  if (accessor.bufferView >= 0) {
    const Parsed<Span> view = find_view(source, model, accessor.bufferView, place);
    if (!view) return tl::unexpected<Failure>(view.error());
    elements.stride_ = view->stride == 0 ? elements.element_bytes_ : view->stride;
    if (elements.stride_ < elements.element_bytes_ ||
        !fits(*view, accessor.byteOffset, accessor.count, elements.element_bytes_,
              elements.stride_)) {
      return gltf_failure(
          source, IoErrorCode::bad_accessor, place,
          compose("{} elements of {} bytes, {} apart, from byte {} on leave a view of {} bytes",
                  accessor.count, elements.element_bytes_, elements.stride_, accessor.byteOffset,
                  view->bytes));
    }
    elements.data_ = view->data + (accessor.count == 0 ? 0 : accessor.byteOffset);
  }
  if (accessor.sparse.isSparse) {
    if (const Parsed<void> found = elements.find_sparse(source, model, index); !found) {
      return tl::unexpected<Failure>(found.error());
    }
  }
  return elements;
}

Parsed<void> GltfElements::find_sparse(const GltfSource& source, const tinygltf::Model& model,
                                       int index) {
  const auto& sparse = model.accessors[static_cast<std::size_t>(index)].sparse;
  const std::string place = compose("/accessors/{}/sparse", index);
  const int type = sparse.indices.componentType;
  const bool is_index_type = type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE ||
                             type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
                             type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
  if (!is_index_type || sparse.count < 0 || sparse.indices.byteOffset < 0 ||
      sparse.values.byteOffset < 0) {
    return gltf_failure(source, IoErrorCode::bad_accessor, place,
                        "a count, offset or type that makes no sense");
  }
  const Parsed<Span> indices = find_view(source, model, sparse.indices.bufferView, place);
  if (!indices) return tl::unexpected<Failure>(indices.error());
  const Parsed<Span> values = find_view(source, model, sparse.values.bufferView, place);
  if (!values) return tl::unexpected<Failure>(values.error());
  const auto count = static_cast<std::size_t>(sparse.count);
  const auto index_bytes =
      static_cast<std::size_t>(tinygltf::GetComponentSizeInBytes(static_cast<std::uint32_t>(type)));
  const auto index_offset = static_cast<std::size_t>(sparse.indices.byteOffset);
  const auto value_offset = static_cast<std::size_t>(sparse.values.byteOffset);
  if (!fits(*indices, index_offset, count, index_bytes, index_bytes) ||
      !fits(*values, value_offset, count, element_bytes_, element_bytes_)) {
    return gltf_failure(source, IoErrorCode::bad_accessor, place,
                        compose("{} replaced elements leave their buffer views", count));
  }
  sparse_indices_.resize(count);
  for (std::size_t j = 0; j < count; ++j) {
    sparse_indices_[j] = gltf_index(indices->data + index_offset + j * index_bytes, type);
    if (sparse_indices_[j] >= count_) {
      return gltf_failure(source, IoErrorCode::bad_accessor, place,
                          compose("element {} of {} is replaced", sparse_indices_[j], count_));
    }
  }
  if (count != 0) sparse_values_ = values->data + value_offset;
  return {};
}

}  // namespace hedgerow::io
