#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "baselines/pointer_mesh.h"
#include "baselines/struct_mesh.h"
#include "hedgerow/connectivity.h"
#include "hedgerow/soup.h"
#include "mesh_file.h"
#include "report/reference.h"
#include "report/stage.h"
#include "run.h"

namespace hedgerow::tool {

inline constexpr std::int64_t kIndexBytes = sizeof(Index);

/// The mesh that the stages work on, in every form that they compare.
struct Subject {
  const Soup& soup;                   ///< the kept faces
  const Connectivity& mesh;           ///< built from `soup`, its columns may view it
  const Connectivity& explicit_mesh;  ///< the same with every column stored
  const Reference& reference;
  baselines::PointerHalfedgeMesh& pointer;
  baselines::StructHalfedgeMesh& structs;

  [[nodiscard]] std::int64_t vertices() const noexcept { return mesh.vertex_count(); }
  [[nodiscard]] std::int64_t halfedges() const noexcept { return mesh.halfedge_count(); }
  [[nodiscard]] std::int64_t faces() const noexcept { return mesh.face_count(); }
};

/// Collects stages: checks each answer, then times it on one thread and on all.
class Stages {
 public:
  explicit Stages(Run& run) : run_(run) {}

  using Work = std::function<void(const Execution&)>;
  using Check = std::function<bool(const Execution&)>;

  /// `stage` says everything but threads, ms, runs and checked. `check` does the work once, for
  /// each thread count, and compares the answer; if it is wrong the stage is not timed and counts
  /// as failed.
  void measure(Stage stage, const Check& check, const Work& work);
  /// For work that has no threads of its own.
  void measure_serial(Stage stage, const Check& check, const Work& work);
  /// The same, where there is no reference to compare with: `checked` is false.
  void measure_unchecked(Stage stage, const Work& work);
  /// Records that an answer is wrong.
  void fail(const std::string& what) { failed_.push_back(what); }

  [[nodiscard]] Run& run() noexcept { return run_; }
  [[nodiscard]] const std::vector<Stage>& stages() const noexcept { return stages_; }
  [[nodiscard]] const std::vector<std::string>& failed() const noexcept { return failed_; }

 private:
  void measure_on(Stage stage, int threads, const Check& check, const Work& work);

  Run& run_;
  std::vector<Stage> stages_;
  std::vector<std::string> failed_;
};

/// About as many steps as a report on a triangle mesh has.
inline constexpr int kReportSteps = 64;

/// `folder` takes a file for the check, which is removed again.
void measure_read(Stages& stages, const MeshFile& file, const std::string& folder);
void measure_build(Stages& stages, const Subject& subject);
void measure_validate(Stages& stages, const Subject& subject);
void measure_face_normals(Stages& stages, const Subject& subject);
void measure_vertex_normals(Stages& stages, const Subject& subject);
/// After a hundredth of the vertices have moved.
void measure_dirty_normals(Stages& stages, const Subject& subject);
void measure_one_ring(Stages& stages, const Subject& subject);
void measure_boundary_loops(Stages& stages, const Subject& subject);
void measure_components(Stages& stages, const Subject& subject);
void measure_reorder(Stages& stages, const Subject& subject);

}  // namespace hedgerow::tool
