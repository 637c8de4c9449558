#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "compose.h"
#include "file_bytes.h"
#include "gltf_asset.h"
#include "json_text.h"
#include "text_cursor.h"
#include "tiny_gltf_config.h"

namespace hedgerow::io {

namespace {

// tinygltf looks for a file in the base directory first and then in the working directory; only
// names below this marker are the first.
constexpr std::string_view kBase = "base";

struct FileAccess {
  std::filesystem::path directory;
  std::string forbidden;  ///< the first URI that was refused
  std::string error;      ///< what the first file that could not be read said
};

// A plain relative path that cannot leave the directory: no scheme, no root, no "..".
bool is_allowed(std::string_view uri) {
  if (uri.empty() || uri.find(':') != std::string_view::npos ||
      uri.find('\\') != std::string_view::npos || uri.find('\0') != std::string_view::npos) {
    return false;
  }
  const std::filesystem::path path(uri);
  return path.is_relative() &&
         std::ranges::none_of(path, [](const auto& part) { return part == ".."; });
}

std::string_view uri_of(const std::string& name) noexcept {
  const std::string_view view = name;
  return view.substr(std::min(view.size(), kBase.size() + 1));
}

bool file_exists(const std::string& name, void*) {
  return name.starts_with(kBase) && name.size() > kBase.size() && name[kBase.size()] == '/';
}
std::string same_path(const std::string& name, void*) { return name; }
bool read_whole_file(std::vector<unsigned char>* out, std::string* error, const std::string& name,
                     void* user) {
  auto& access = *static_cast<FileAccess*>(user);
  const std::string_view uri = uri_of(name);
  if (!is_allowed(uri)) {
    if (access.forbidden.empty()) access.forbidden = uri;
    return false;
  }
  IoResult<Buffer<char>> bytes = read_file(access.directory / std::filesystem::path(uri));
  if (!bytes) {
    if (access.error.empty()) access.error = in_quotes(uri) + ": " + bytes.error().message;
    if (error != nullptr) *error += bytes.error().message;
    return false;
  }
  out->assign(bytes->begin(), bytes->end());
  return true;
}
bool write_nothing(std::string*, const std::string&, const std::vector<unsigned char>&, void*) {
  return false;
}

void append_word(std::vector<unsigned char>& out, std::size_t value) {
  for (int shift = 0; shift < 32; shift += 8) {
    out.push_back(static_cast<unsigned char>(value >> shift & 0xff));
  }
}

// What is needed of the asset and nothing else, as a GLB if it has a binary chunk: pictures,
// materials, animations and scenes are not ours to be tripped by.
std::string reduced(const nlohmann::json& asset) {
  nlohmann::json kept = nlohmann::json::object();
  for (const char* key : {"asset", "buffers", "bufferViews", "accessors", "meshes"}) {
    if (const auto found = asset.find(key); found != asset.end()) kept[key] = *found;
  }
  return kept.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::vector<unsigned char> container(const std::string& json, std::span<const char> binary) {
  const std::size_t json_bytes = (json.size() + 3) / 4 * 4;
  const std::size_t binary_bytes = (binary.size() + 3) / 4 * 4;
  const std::size_t chunk_bytes = binary.empty() ? 0 : 8 + binary_bytes;
  std::vector<unsigned char> out;
  out.reserve(20 + json_bytes + chunk_bytes);
  append_word(out, 0x46546c67);
  append_word(out, 2);
  append_word(out, 20 + json_bytes + chunk_bytes);
  append_word(out, json_bytes);
  append_word(out, 0x4e4f534a);
  out.insert(out.end(), json.begin(), json.end());
  out.resize(20 + json_bytes, ' ');
  if (binary.empty()) return out;
  append_word(out, binary_bytes);
  append_word(out, 0x004e4942);
  out.insert(out.end(), binary.begin(), binary.end());
  out.resize(20 + json_bytes + chunk_bytes, 0);
  return out;
}

Parsed<void> check_asset(const GltfSource& source, const nlohmann::json& asset) {
  if (!asset.is_object()) {
    return gltf_failure(source, IoErrorCode::bad_gltf, "", "the asset is no JSON object");
  }
  const auto required = asset.find("extensionsRequired");
  if (required == asset.end() || !required->is_array()) return {};
  for (std::size_t i = 0; i < required->size(); ++i) {
    const nlohmann::json& extension = (*required)[i];
    for (const char* refused : {"KHR_draco_mesh_compression", "EXT_meshopt_compression"}) {
      if (extension == refused) {
        return gltf_failure(source, IoErrorCode::unsupported_feature,
                            compose("/extensionsRequired/{}", i),
                            compose("the extension {} is not read", refused));
      }
    }
  }
  return {};
}

std::string first_line(const std::string& text) {
  const std::string line = text.substr(0, text.find('\n'));
  return line.empty() ? "the asset does not follow the glTF schema"
                      : "the asset does not follow the glTF schema: " + in_quotes(line);
}

}  // namespace

tl::unexpected<Failure> gltf_failure(const GltfSource& source, IoErrorCode code,
                                     std::string_view pointer, std::string message) {
  const std::size_t offset = source.json_offset + locate_json(source.json, pointer);
  if (!pointer.empty()) message = compose("{}: {}", pointer, message);
  return failure(code, offset, source.place, std::move(message));
}

Parsed<void> load_gltf_model(ReadContext& context, const GltfSource& source,
                             tinygltf::Model& model) {
  const auto asset = nlohmann::json::parse(source.json.begin(), source.json.end(), nullptr, false);
  if (Parsed<void> checked = check_asset(source, asset); !checked) return checked;

  FileAccess access{context.path.has_parent_path() ? context.path.parent_path() : ".", {}, {}};
  tinygltf::TinyGLTF loader;
  loader.SetFsCallbacks({file_exists, same_path, read_whole_file, write_nothing, &access});
  std::string error;
  std::string warning;
  bool is_loaded = false;
  try {
    const std::string json = reduced(asset);
    const std::string base(kBase);
    if (source.place == Place::binary) {
      const std::vector<unsigned char> bytes = container(json, source.binary_chunk);
      is_loaded = bytes.size() <= 0xffffffffu &&
                  loader.LoadBinaryFromMemory(&model, &error, &warning, bytes.data(),
                                              static_cast<unsigned>(bytes.size()), base,
                                              tinygltf::NO_REQUIRE);
    } else {
      is_loaded = json.size() <= 0xffffffffu &&
                  loader.LoadASCIIFromString(&model, &error, &warning, json.data(),
                                             static_cast<unsigned>(json.size()), base,
                                             tinygltf::NO_REQUIRE);
    }
  } catch (const nlohmann::json::exception& thrown) {
    error = thrown.what();
  } catch (const std::logic_error& thrown) {
    // Such as the bounds checks of the containers that tinygltf relies on.
    error = thrown.what();
  }
  if (!access.forbidden.empty()) {
    return gltf_failure(source, IoErrorCode::forbidden_uri, "/buffers",
                        compose("the URI {} does not stay in the directory of the file",
                                in_quotes(access.forbidden)));
  }
  if (!access.error.empty()) {
    return gltf_failure(source, IoErrorCode::cannot_open, "/buffers", access.error);
  }
  if (!is_loaded) return gltf_failure(source, IoErrorCode::bad_gltf, "", first_line(error));
  return {};
}

}  // namespace hedgerow::io
