#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "read_context.h"

namespace tinygltf {
class Model;
}

namespace hedgerow::io {

/// A glTF asset as text, with the binary chunk that may come with it.
struct GltfSource {
  std::string_view json;
  std::size_t json_offset = 0;         ///< of the JSON in the file
  std::span<const char> binary_chunk;  ///< empty: none
  Place place = Place::text;
};

/// Failure at the value that a JSON pointer leads to; the message begins with the pointer.
[[nodiscard]] tl::unexpected<Failure> gltf_failure(const GltfSource& source, IoErrorCode code,
                                                   std::string_view pointer, std::string message);

/// Fills `model` with the buffers, views, accessors and meshes of the asset. Buffers are read from
/// the asset itself or from the directory of the file; nothing else of the asset is looked at.
[[nodiscard]] Parsed<void> load_gltf_model(ReadContext& context, const GltfSource& source,
                                           tinygltf::Model& model);

/// Elements of an accessor, every byte of which was checked to be inside its buffer.
class GltfElements {
 public:
  /// Checks accessor `index`. `pointer` is where the asset refers to it.
  [[nodiscard]] static Parsed<GltfElements> find(const GltfSource& source,
                                                 const tinygltf::Model& model, int index,
                                                 std::string_view pointer);

  [[nodiscard]] std::size_t count() const noexcept { return count_; }
  [[nodiscard]] int component_type() const noexcept { return component_type_; }
  [[nodiscard]] int type() const noexcept { return type_; }
  [[nodiscard]] bool is_normalized() const noexcept { return is_normalized_; }
  /// Bytes of element i, or null where no buffer holds it (its value is then zero).
  [[nodiscard]] const char* operator[](std::size_t i) const noexcept {
    return data_ == nullptr ? nullptr : data_ + i * stride_;
  }
  /// Calls `visit(i, bytes)` for each element that a sparse accessor replaces.
  template <class Visit>
  void for_each_replaced(const Visit& visit) const {
    for (std::size_t j = 0; j < sparse_indices_.size(); ++j) {
      visit(sparse_indices_[j], sparse_values_ + j * element_bytes_);
    }
  }

 private:
  [[nodiscard]] Parsed<void> find_sparse(const GltfSource& source, const tinygltf::Model& model,
                                         int index);

  const char* data_ = nullptr;
  std::size_t stride_ = 0;
  std::size_t count_ = 0;
  std::size_t element_bytes_ = 0;
  int component_type_ = 0;
  int type_ = 0;
  bool is_normalized_ = false;
  std::vector<std::size_t> sparse_indices_;
  const char* sparse_values_ = nullptr;
};

/// Value of an unsigned integer component; 0 for null.
[[nodiscard]] std::uint32_t gltf_index(const char* bytes, int component_type) noexcept;

}  // namespace hedgerow::io
