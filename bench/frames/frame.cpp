#include "frames/frame.h"

#include <cstring>
#include <span>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "hedgerow/circulate.h"
#include "hedgerow/ray/surface.h"
#include "memory_use.h"

namespace hedgerow::bench {
namespace {

constexpr std::size_t kPacketsATask = 64;
constexpr std::size_t kVerticesATask = 4096;

/// Adds the time since it was made, or since the last call, to a part.
class Lap {
 public:
  explicit Lap(PartTimes& times) : times_(times) {}
  void end(FramePart part) {
    const double now = now_ms();
    times_[part] += now - last_;
    last_ = now;
  }

 private:
  PartTimes& times_;
  double last_ = now_ms();
};

/// Calls body(begin, end) for parts of [0, count).
template <class Body>
void spread(const FrameThreads& threads, std::size_t count, std::size_t grain, const Body& body) {
  if (threads.arena == nullptr) return body(std::size_t{0}, count);
  threads.arena->execute([&] {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain),
                      [&](const auto& range) { body(range.begin(), range.end()); });
  });
}

}  // namespace

Execution FrameThreads::execution() const {
  return arena == nullptr ? Execution::serial() : Execution::in(*arena);
}

Frame::Frame(const Subject& subject, const ray::Device& device, const FrameOptions& options)
    : subject_(subject),
      xyz_(Buffer<float>::copy_of(subject.soup.xyz.span())),
      normals_(xyz_.size()),
      dirty_(subject.mesh),
      packets_(primary_rays(subject, options.rays)),
      hits_(packets_.size()),
      answers_(packets_.size()),
      scene_(*ray::Scene::build(device, subject.mesh, ray::PaddedPositions::of(xyz_),
                                {.motion = ray::Motion::moving, .piece_faces = options.piece_faces},
                                Execution::serial())) {
  (void)gather_vertex_normals(subject.mesh, positions(), normals_out(), {}, Execution::serial(),
                              workspace_);
}

void Frame::update(float time, Change change, const FrameThreads& threads, PartTimes& times) {
  const Execution execution = threads.execution();
  Lap lap(times);
  move(time, change, threads);
  lap.end(kDeform);
  const bool is_done = change == Change::some ? compute_moved(execution) : compute_all(execution);
  lap.end(kNormals);
  const std::int64_t before = allocations_so_far();
  is_good_ = is_done && scene_.refit(dirty_, execution) && !scene_.has_built() && is_good_;
  refit_allocations_ += allocations_so_far() - before;
  lap.end(kRefit);
}

void Frame::move(float time, Change change, const FrameThreads& threads) {
  if (change != Change::all) return deform(subject_, subject_.blob, time, xyz_);
  spread(threads, static_cast<std::size_t>(subject_.vertices()), kVerticesATask,
         [&](std::size_t begin, std::size_t end) {
           deform(subject_, IndexRange{static_cast<Index>(begin), static_cast<Index>(end)}, time,
                  xyz_);
         });
}

/// Of everything, the pass over the faces is the faster way to the same bits.
bool Frame::compute_all(const Execution& execution) {
  const IndexRange all{0, subject_.mesh.vertex_count()};
  return dirty_.find(subject_.mesh, MovedVertices::range(all)) &&
         scatter_vertex_normals(face_list(subject_.mesh), positions(), normals_out(), {}, execution,
                                workspace_);
}

bool Frame::compute_moved(const Execution& execution) {
  return dirty_.find(subject_.mesh, MovedVertices::list(subject_.blob)) &&
         update_vertex_normals(subject_.mesh, positions(), normals_out(), {}, dirty_, execution,
                               workspace_);
}

void Frame::trace(const FrameThreads& threads, PartTimes& times) {
  Lap lap(times);
  spread(threads, packets_.size(), kPacketsATask, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) hits_[i] = scene_.intersect(packets_[i]);
  });
  lap.end(kRays);
  subject_.mesh.visit([&](const auto& view) {
    spread(threads, packets_.size(), kPacketsATask, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) answers_[i] = ask(view, hits_[i]);
    });
  });
  lap.end(kHits);
}

template <Topology Mesh>
float Frame::ask(const Mesh& mesh, const ray::HitPacket& packet) const {
  float sum = 0;
  for (const ray::Hit& hit : packet) {
    if (!hit.valid()) continue;
    const ray::SurfacePoint point = scene_.primitives().point(hit);
    const ray::Vec3 normal =
        ray::interpolate_normal(mesh, point, {normals_.data(), subject_.vertices()});
    std::uint32_t ring = 0;
    for (const VertexId u : neighbours(mesh, ray::nearest_vertex(mesh, point))) {
      ring += static_cast<std::uint32_t>(u.value);
    }
    sum += normal[2] + static_cast<float>(ring & 1U);
  }
  return sum;
}

std::string Frame::check(std::int64_t sample) const {
  if (!is_good_) return "an operation failed, or a refit built a tree";
  Buffer<float> expected(normals_.size());
  Workspace workspace;
  (void)gather_vertex_normals(subject_.mesh, positions(), {expected.data(), subject_.vertices()},
                              {}, Execution::serial(), workspace);
  if (std::memcmp(expected.data(), normals_.data(), normals_.size_bytes()) != 0) {
    return "the normals differ from those of a full pass";
  }
  const std::int64_t wrong = wrong_hits(subject_, xyz_, packets_, hits_, sample);
  return wrong == 0 ? std::string() : fmt::format("{} of {} rays are wrong", wrong, sample);
}

std::string Frame::rates() const {
  return fmt::format("{} rays, {} hits, {} dirty vertices, {} of {} pieces", count_rays(packets_),
                     count_hits(hits_),
                     dirty_.is_all() ? subject_.vertices() : std::ssize(dirty_.vertices()),
                     scene_.refitted_pieces(), scene_.stats().piece_count);
}

}  // namespace hedgerow::bench
