#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <vector>

#include "embree_api.h"
#include "hedgerow/buffer.h"
#include "hedgerow/ray/scene.h"
#include "parallel/parallel.h"

namespace hedgerow::ray {

struct Device::Handle {
  RTCDevice device = nullptr;
  std::atomic<std::int64_t> held_bytes = 0;

  explicit Handle(RTCDevice made) noexcept : device(made) {}
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { rtcReleaseDevice(device); }
};

/// The faces as Embree wants them, and the way back.
struct Primitives {
  Index count = 0;
  int sides = 3;  ///< 3: triangles; 4: quads, or triangles that repeat a corner
  const std::uint32_t* vertices = nullptr;  ///< `sides` a primitive: the mesh's own, or `copied`
  Buffer<std::uint32_t> copied;
  Buffer<Index> corners;           ///< four half-edges a primitive; empty where arithmetic does
  const Index* next_of = nullptr;  ///< the mesh's column, where `sides` is 4
  std::int64_t cut_face_count = 0;

  [[nodiscard]] PrimitiveMap map() const noexcept {
    return corners.empty() ? PrimitiveMap(static_cast<Index>(sides)) : PrimitiveMap(corners.data());
  }
};

/// Shares the origin column where all faces are triangles or all are quads, else makes a table.
/// Errors     not_canonical, too_many_elements. Throws std::bad_alloc.
[[nodiscard]] Result<Primitives> make_primitives(const Connectivity& mesh, Positions positions);

struct Scene::Impl {
  std::shared_ptr<Device::Handle> device;
  RTCScene scene = nullptr;
  std::vector<RTCGeometry> pieces;  ///< kept alive by the scene
  std::vector<std::uint8_t> touched;
  std::vector<std::uint8_t> is_incomplete;  ///< of pieces: Embree has left faces out of the tree
  Primitives primitives;
  Index piece_size = 0;  ///< primitives a piece; the last may have fewer
  Index vertex_count = 0;
  Positions positions{};
  const Index* origin = nullptr;
  Motion motion = Motion::still;
  SceneStats stats;
  std::int64_t refitted = 0;
  std::atomic<bool> has_built = false;
  par::LoneThread lone;

  Impl() = default;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
  ~Impl() {
    if (scene != nullptr) rtcReleaseScene(scene);
  }

  [[nodiscard]] Index primitive_of(unsigned geometry, unsigned primitive) const noexcept {
    return static_cast<Index>(geometry) * piece_size + static_cast<Index>(primitive);
  }
};

}  // namespace hedgerow::ray
