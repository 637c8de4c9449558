// Sharing buffers, refitting and committing follow the manual of Embree 3; what the code relies on
// beyond its letter is pinned by tests/embree_facts_test.cpp.
#include "hedgerow/ray/scene.h"

#include <algorithm>
#include <limits>
#include <new>
#include <span>
#include <utility>

#include "float3_check.h"
#include "outliers.h"
#include "scene_impl.h"

namespace hedgerow::ray {
namespace {

// Embree loads a vertex into a register of four floats.
constexpr std::size_t kVertexLoadBytes = 16;
constexpr std::int64_t kMaxPositionBytes = std::int64_t{16} << 30U;
constexpr std::int64_t kMaxEmbreeCount = std::numeric_limits<std::uint32_t>::max() - 1;

/// Embree calls this on every thread, before it asks for memory and after it has given some back.
bool count_memory(void* user, ssize_t bytes, bool /*after*/) {
  auto& handle = *static_cast<Device::Handle*>(user);
  handle.held_bytes += bytes;
  return true;
}

/// Embree calls this while it builds: `done` is the share of the primitives that are in the tree. A
/// refit puts none in.
bool note_progress(void* user, double done) {
  if (done > 0) *static_cast<std::atomic<bool>*>(user) = true;
  return true;
}

/// The error that Embree has recorded on this thread, which is thereby forgotten.
Result<void> embree_error(RTCDevice device) {
  const RTCError code = rtcGetDeviceError(device);
  if (code == RTC_ERROR_NONE) return {};
  if (code == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  return fail({ErrorCode::ray_library, kInvalidIndex, static_cast<std::int64_t>(code)});
}

Result<void> check_positions(const PaddedPositions& padded, Index vertex_count) {
  const Positions& positions = padded.positions;
  if (auto ok = hedgerow::detail::check_float3(positions, vertex_count); !ok) return ok;
  const auto stride = static_cast<std::int64_t>(positions.stride_bytes);
  if (vertex_count > 0 && stride > kMaxPositionBytes / vertex_count) {
    return fail(
        {ErrorCode::too_many_elements, kInvalidIndex, vertex_count, kMaxPositionBytes / stride});
  }
  const std::size_t needed = bytes_read({positions.data, vertex_count, positions.stride_bytes});
  if (padded.readable_bytes < needed) {
    return fail({ErrorCode::needs_padding, kInvalidIndex,
                 static_cast<std::int64_t>(padded.readable_bytes),
                 static_cast<std::int64_t>(needed)});
  }
  return {};
}

void set_vertices(RTCGeometry geometry, const Positions& positions, Index vertex_count) {
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions.data,
                             0, positions.stride_bytes, static_cast<std::size_t>(vertex_count));
}

RTCGeometry make_piece(const Scene::Impl& impl, IndexRange primitives) {
  const bool is_triangles = impl.primitives.sides == 3;
  const RTCGeometry geometry = rtcNewGeometry(
      impl.device->device, is_triangles ? RTC_GEOMETRY_TYPE_TRIANGLE : RTC_GEOMETRY_TYPE_QUAD);
  const std::size_t record =
      static_cast<std::size_t>(impl.primitives.sides) * sizeof(std::uint32_t);
  rtcSetGeometryBuildQuality(
      geometry, impl.motion == Motion::moving ? RTC_BUILD_QUALITY_REFIT : RTC_BUILD_QUALITY_MEDIUM);
  set_vertices(geometry, impl.positions, impl.vertex_count);
  rtcSetSharedGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, is_triangles ? RTC_FORMAT_UINT3 : RTC_FORMAT_UINT4,
      impl.primitives.vertices, static_cast<std::size_t>(primitives.begin) * record, record,
      static_cast<std::size_t>(primitives.size()));
  // Embree 4 hides geometry from rays unless the masks share a bit, and its own default has one.
  rtcSetGeometryMask(geometry, ~0U);
  rtcCommitGeometry(geometry);
  return geometry;
}

void make_pieces(Scene::Impl& impl, const SceneOptions& options) {
  const Index count = impl.primitives.count;
  const bool is_cut =
      impl.motion == Motion::moving && options.piece_faces > 0 && impl.primitives.corners.empty();
  impl.piece_size = is_cut ? std::min(options.piece_faces, std::max<Index>(count, 1)) : count;
  for (Index begin = 0; begin < count; begin += impl.piece_size) {
    const RTCGeometry geometry =
        make_piece(impl, {begin, begin + std::min(impl.piece_size, count - begin)});
    rtcAttachGeometryByID(impl.scene, geometry, static_cast<unsigned>(impl.pieces.size()));
    rtcReleaseGeometry(geometry);  // the scene holds it now
    impl.pieces.push_back(geometry);
  }
  impl.touched.resize(impl.pieces.size());
  impl.is_incomplete.resize(impl.pieces.size());
}

/// `rtcCommitScene` spreads its tasks over the arena that it is called in; `rtcJoinCommitScene`
/// would move them to an arena of Embree's own.
Result<void> commit(Scene::Impl& impl, const Execution& execution) {
  Result<void> result;
  impl.has_built = false;
  par::call_inside(execution, impl.lone, [&] {
    rtcCommitScene(impl.scene);
    result = embree_error(impl.device->device);  // kept for each thread by itself
  });
  return result;
}

bool has_outlier_in(const Scene::Impl& impl, std::size_t piece) noexcept {
  const auto begin = static_cast<Index>(piece) * impl.piece_size;
  const Index count = std::min(impl.piece_size, impl.primitives.count - begin);
  const auto sides = static_cast<std::size_t>(impl.primitives.sides);
  return has_outlier(impl.positions,
                     std::span(impl.primitives.vertices + static_cast<std::size_t>(begin) * sides,
                               static_cast<std::size_t>(count) * sides));
}

/// Notes whether Embree leaves faces of a piece out, looking only where it `may_have` such or had
/// some. Returns whether it does or did: a refit brings none back and takes none away.
bool note_incomplete(Scene::Impl& impl, std::size_t piece, bool may_have) noexcept {
  const bool was = impl.is_incomplete[piece] != 0;
  const bool is = (may_have || was) && has_outlier_in(impl, piece);
  impl.is_incomplete[piece] = is ? 1 : 0;
  return was || is;
}

/// `has_outliers`: among the vertices that may have moved.
Result<void> follow(Scene::Impl& impl, bool is_rebuilt, bool has_outliers,
                    const Execution& execution) {
  impl.refitted = 0;
  for (std::size_t i = 0; i < impl.pieces.size(); ++i) {
    if (impl.touched[i] == 0) continue;
    rtcUpdateGeometryBuffer(impl.pieces[i], RTC_BUFFER_TYPE_VERTEX, 0);
    // Other indices mean another tree: Embree then does not refit.
    if (note_incomplete(impl, i, has_outliers) || is_rebuilt) {
      rtcUpdateGeometryBuffer(impl.pieces[i], RTC_BUFFER_TYPE_INDEX, 0);
    }
    rtcCommitGeometry(impl.pieces[i]);
    ++impl.refitted;
  }
  return commit(impl, execution);
}

}  // namespace

std::size_t bytes_read(const Positions& positions) noexcept {
  if (positions.count <= 0) return 0;
  return static_cast<std::size_t>(positions.count - 1) * positions.stride_bytes + kVertexLoadBytes;
}

Device::Device(std::shared_ptr<Handle> handle) noexcept : handle_(std::move(handle)) {}
Device::Device(Device&&) noexcept = default;
Device& Device::operator=(Device&&) noexcept = default;
Device::~Device() = default;

Result<Device> Device::create() {
  const RTCDevice device = rtcNewDevice(nullptr);
  if (auto ok = embree_error(device); !ok) return fail(ok.error());
  auto handle = std::make_shared<Handle>(device);
  rtcSetDeviceMemoryMonitorFunction(device, count_memory, handle.get());
  return Device(std::move(handle));
}

int Device::version() const noexcept {
  return static_cast<int>(rtcGetDeviceProperty(handle_->device, RTC_DEVICE_PROPERTY_VERSION));
}

std::int64_t Device::held_bytes() const noexcept { return handle_->held_bytes; }

Scene::Scene(std::unique_ptr<Impl> impl) noexcept : impl_(std::move(impl)) {}
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

Result<Scene> Scene::build(const Device& device, const Connectivity& mesh,
                           const PaddedPositions& positions, const SceneOptions& options,
                           const Execution& execution) {
  if (auto ok = check_positions(positions, mesh.vertex_count()); !ok) return fail(ok.error());
  const auto largest_count = std::max<std::int64_t>(mesh.vertex_count(), mesh.face_count());
  if (largest_count > kMaxEmbreeCount) {
    return fail({ErrorCode::too_many_elements, kInvalidIndex, largest_count, kMaxEmbreeCount});
  }
  Result<Primitives> primitives = make_primitives(mesh, positions.positions);
  if (!primitives) return fail(primitives.error());

  auto impl = std::make_unique<Impl>();
  impl->device = device.handle();
  impl->primitives = std::move(*primitives);
  impl->vertex_count = mesh.vertex_count();
  impl->positions = positions.positions;
  impl->origin = mesh.origin().data();
  impl->motion = options.motion;
  impl->scene = rtcNewScene(impl->device->device);
  rtcSetSceneProgressMonitorFunction(impl->scene, note_progress, &impl->has_built);
  int flags = options.is_watertight ? RTC_SCENE_FLAG_ROBUST : RTC_SCENE_FLAG_NONE;
  if (options.motion == Motion::moving) {
    flags |= RTC_SCENE_FLAG_DYNAMIC;
    rtcSetSceneBuildQuality(impl->scene, RTC_BUILD_QUALITY_LOW);
  }
  rtcSetSceneFlags(impl->scene, static_cast<RTCSceneFlags>(flags));
  make_pieces(*impl, options);
  if (has_outlier(impl->positions, impl->vertex_count, execution)) {
    for (std::size_t i = 0; i < impl->pieces.size(); ++i) (void)note_incomplete(*impl, i, true);
  }
  impl->stats = {impl->primitives.copied.size_bytes() + impl->primitives.corners.size_bytes(),
                 std::ssize(impl->pieces), impl->primitives.cut_face_count};
  if (auto ok = embree_error(impl->device->device); !ok) return fail(ok.error());
  if (auto ok = commit(*impl, execution); !ok) return fail(ok.error());
  return Scene(std::move(impl));
}

Result<void> Scene::refit(const Execution& execution) {
  std::ranges::fill(impl_->touched, std::uint8_t{1});
  const bool has_outliers = has_outlier(impl_->positions, impl_->vertex_count, execution);
  return follow(*impl_, false, has_outliers, execution);
}

Result<void> Scene::refit(const PaddedPositions& positions, const Execution& execution) {
  if (auto ok = check_positions(positions, impl_->vertex_count); !ok) return ok;
  impl_->positions = positions.positions;
  for (const RTCGeometry piece : impl_->pieces) {
    set_vertices(piece, impl_->positions, impl_->vertex_count);
  }
  return refit(execution);
}

Result<void> Scene::refit(const DirtySet& dirty, const Execution& execution) {
  if (dirty.is_all() || (impl_->pieces.size() == 1 && !dirty.faces().empty())) {
    return refit(execution);
  }
  impl_->refitted = 0;
  if (dirty.faces().empty()) return {};
  std::ranges::fill(impl_->touched, std::uint8_t{0});
  for (const Index f : dirty.faces()) {
    impl_->touched[static_cast<std::size_t>(f / impl_->piece_size)] = 1;
  }
  const bool has_outliers = has_outlier(impl_->positions, dirty.vertices(), execution);
  return follow(*impl_, false, has_outliers, execution);
}

Result<void> Scene::rebuild(const Execution& execution) {
  std::ranges::fill(impl_->touched, std::uint8_t{1});
  const bool has_outliers = has_outlier(impl_->positions, impl_->vertex_count, execution);
  return follow(*impl_, true, has_outliers, execution);
}

const SceneStats& Scene::stats() const noexcept { return impl_->stats; }
PrimitiveMap Scene::primitives() const noexcept { return impl_->primitives.map(); }
std::int64_t Scene::refitted_pieces() const noexcept { return impl_->refitted; }
bool Scene::has_built() const noexcept { return impl_->has_built; }

}  // namespace hedgerow::ray
