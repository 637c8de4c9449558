#include <array>
#include <cstring>
#include <utility>

#include "hedgerow/normals.h"
#include "report/stages.h"
#include "report/timing.h"

namespace hedgerow::tool {
namespace {

constexpr std::array<std::pair<NormalWeight, const char*>, 4> kWeights = {
    {{NormalWeight::uniform, "uniform"},
     {NormalWeight::area, "area"},
     {NormalWeight::angle, "angle"},
     {NormalWeight::max, "max"}}};
constexpr std::int64_t kVector = 3 * sizeof(float);

bool same_bits(const Buffer<float>& a, const Buffer<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

NormalsOut out_of(Buffer<float>& normals) {
  return {normals.data(), static_cast<std::int64_t>(normals.size() / 3)};
}

/// Bytes of the face list: corners, and offsets where there are any.
std::int64_t face_list_bytes(const Subject& subject) {
  const std::int64_t offsets = subject.mesh.is_implicit() ? 0 : subject.faces() + 1;
  return kIndexBytes * (subject.halfedges() + offsets);
}

/// Bytes that a walk round every vertex reads of the connectivity.
std::int64_t walk_bytes(const Subject& subject) {
  const std::int64_t next = subject.mesh.is_implicit() ? 0 : subject.halfedges();
  return kIndexBytes * (2 * subject.halfedges() + next + subject.vertices());
}

/// Both ways to the vertex normals, on the same mesh with the same options.
class VertexNormals {
 public:
  VertexNormals(const Subject& subject, NormalWeight weight)
      : subject_(subject), normals_(subject.soup.xyz.size()) {
    options_.weight = weight;
  }
  bool gather(const Execution& execution) {
    return gather_vertex_normals(subject_.mesh, subject_.soup.positions(), out_of(normals_),
                                 options_, execution, workspace_)
        .has_value();
  }
  bool scatter(const Execution& execution) {
    return scatter_vertex_normals(subject_.soup.face_list(), subject_.soup.positions(),
                                  out_of(normals_), options_, execution, workspace_)
        .has_value();
  }
  [[nodiscard]] const Buffer<float>& normals() const noexcept { return normals_; }

 private:
  const Subject& subject_;
  NormalOptions options_;
  Buffer<float> normals_;
  Workspace workspace_;
};

}  // namespace

void measure_face_normals(Stages& stages, const Subject& subject) {
  Stage stage{.name = "face_normals"};
  stage.elements = subject.faces();
  stage.unit = "face";
  stage.bytes = face_list_bytes(subject) + kVector * (subject.vertices() + subject.faces());
  stage.mix = Mix::triad;
  stages.run().progress().step("face_normals, the other meshes");
  stage.pointer_ms = time_median([&] { subject.pointer.compute_face_normals(); }).ms;
  stage.aos_ms = time_median([&] { subject.structs.compute_face_normals(); }).ms;
  Buffer<float> normals(3 * static_cast<std::size_t>(subject.faces()));
  const auto work = [&](const Execution& execution) {
    return face_normals(subject.soup.face_list(), subject.soup.positions(), out_of(normals), {},
                        execution)
        .has_value();
  };
  stages.measure(
      std::move(stage),
      [&](const Execution& execution) {
        return work(execution) && subject.reference.accepts_face_normals(normals);
      },
      work);
}

void measure_vertex_normals(Stages& stages, const Subject& subject) {
  subject.pointer.compute_face_normals();
  subject.structs.compute_face_normals();
  for (const auto& [weight, word] : kWeights) {
    stages.run().progress().step(std::string("vertex normals by the other meshes, ") + word);
    // Both write the face normals, too: they have no way to the vertex normals without them.
    const auto on = [weight = weight](auto& mesh) {
      return time_median([&] {
               mesh.compute_face_normals();
               mesh.compute_vertex_normals(weight);
             })
          .ms;
    };
    Stage stage;
    stage.variant = word;
    stage.elements = subject.vertices();
    stage.unit = "vertex";
    stage.mix = Mix::triad;
    stage.pointer_ms = on(subject.pointer);
    stage.aos_ms = on(subject.structs);

    VertexNormals linear(subject, weight);
    VertexNormals walk(subject, weight);
    const bool is_reference_met =
        linear.scatter(Execution::serial()) &&
        subject.reference.accepts_vertex_normals(linear.normals(), weight);
    const Buffer<float> expected = Buffer<float>::copy_of(linear.normals().span());

    stage.name = "vertex_normals_facelist";
    stage.bytes = face_list_bytes(subject) + 2 * kVector * subject.vertices();
    stages.measure(
        stage,
        [&](const Execution& execution) {
          return is_reference_met && linear.scatter(execution) &&
                 same_bits(linear.normals(), expected);
        },
        [&](const Execution& execution) { linear.scatter(execution); });

    stage.name = "vertex_normals_halfedge";
    stage.bytes = walk_bytes(subject) + 2 * kVector * subject.vertices();
    stages.measure(
        stage,
        [&](const Execution& execution) {
          return is_reference_met && walk.gather(execution) && same_bits(walk.normals(), expected);
        },
        [&](const Execution& execution) { walk.gather(execution); });
  }
}

}  // namespace hedgerow::tool
