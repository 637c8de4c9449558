#include "frames/subject.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "hedgerow/circulate.h"

namespace hedgerow::bench {
namespace {

std::vector<Index> find_blob(const Connectivity& mesh) {
  const Index count = mesh.vertex_count();
  const auto wanted = static_cast<std::size_t>(count / 100 + 1);
  std::vector<bool> is_in(static_cast<std::size_t>(count));
  // A vertex in the middle of the numbers that is on a face.
  Index start = count / 2;
  while (mesh.outgoing()[static_cast<std::size_t>(start)] == kInvalidIndex) {
    start = (start + 1) % count;
  }
  std::vector<Index> blob = {start};
  is_in[static_cast<std::size_t>(start)] = true;
  mesh.visit([&](const auto& view) {
    for (std::size_t i = 0; i < blob.size() && blob.size() < wanted; ++i) {
      for (const VertexId v : neighbours(view, VertexId(blob[i]))) {
        if (is_in[static_cast<std::size_t>(v.value)] || blob.size() == wanted) continue;
        is_in[static_cast<std::size_t>(v.value)] = true;
        blob.push_back(v.value);
      }
    }
  });
  std::ranges::sort(blob);
  return blob;
}

void wave(const Subject& subject, Index v, float time, Buffer<float>& xyz) {
  const float amplitude = 0.01F * subject.diagonal;
  const float frequency = 40 / subject.diagonal;
  const float* rest = subject.soup.positions()[v];
  float* out = xyz.data() + 3 * v;
  out[0] = rest[0];
  out[1] = rest[1];
  out[2] = rest[2] + amplitude * std::sin(frequency * rest[0] + time);
}

void turn(const Subject& subject, float angle, bool is_twist, Buffer<float>& xyz) {
  for (Index v = 0; v < subject.mesh.vertex_count(); ++v) {
    const float* rest = subject.soup.positions()[v];
    const float height = (rest[1] - subject.centre[1]) / subject.diagonal;
    const float by = is_twist ? angle * 2 * height : angle;
    const float x = rest[0] - subject.centre[0];
    const float z = rest[2] - subject.centre[2];
    float* out = xyz.data() + 3 * v;
    out[0] = subject.centre[0] + x * std::cos(by) + z * std::sin(by);
    out[1] = rest[1];
    out[2] = subject.centre[2] - x * std::sin(by) + z * std::cos(by);
  }
}

}  // namespace

Subject::Subject(Soup&& faces) : soup(std::move(faces)) {
  BuildOptions options;
  options.borrow_corners = true;
  auto built = build(soup.face_list(), options, Execution::current_arena());
  if (!built) throw std::runtime_error(name(built.error().code));
  if (!built->faces_new_to_old.empty() || built->mesh.face_count() == 0) {
    throw std::runtime_error("a mesh without faces, or with some that a build drops");
  }
  mesh = std::move(built->mesh);
  blob = find_blob(mesh);
  ray::Vec3 low = {1e30F, 1e30F, 1e30F};
  ray::Vec3 high = {-1e30F, -1e30F, -1e30F};
  for (std::size_t i = 0; i < soup.xyz.size(); ++i) {
    low[i % 3] = std::min(low[i % 3], soup.xyz[i]);
    high[i % 3] = std::max(high[i % 3], soup.xyz[i]);
  }
  float squared = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    centre[axis] = (low[axis] + high[axis]) / 2;
    squared += (high[axis] - low[axis]) * (high[axis] - low[axis]);
  }
  diagonal = std::sqrt(squared);
}

void deform(const Subject& subject, std::span<const Index> moved, float time, Buffer<float>& xyz) {
  for (const Index v : moved) wave(subject, v, time, xyz);
}
void deform(const Subject& subject, IndexRange moved, float time, Buffer<float>& xyz) {
  for (Index v = moved.begin; v < moved.end; ++v) wave(subject, v, time, xyz);
}

void rotate(const Subject& subject, float angle, Buffer<float>& xyz) {
  turn(subject, angle, false, xyz);
}
void twist(const Subject& subject, float angle, Buffer<float>& xyz) {
  turn(subject, angle, true, xyz);
}

}  // namespace hedgerow::bench
