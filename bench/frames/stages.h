#pragma once

#include <cstdint>
#include <string>

#include "frames/rows.h"
#include "frames/subject.h"
#include "hedgerow/execution.h"

namespace hedgerow::bench {

struct FrameOptions {
  std::int64_t frames = 10'000;
  std::int64_t rays = 16'384;           ///< primary rays a frame
  std::int64_t still_rays = 2'073'600;  ///< primary rays of the stages that are not frames
  int runs = 5;                         ///< of each measurement outside the frame loop
  Index piece_faces = 8'192;
  bool moves_some = true;  ///< loops in which a hundredth of the vertices moves
  bool moves_all = true;   ///< loops in which all of them do
  std::string loops = "serial,parallel,double";  ///< which of them
};

/// From index buffers to half-edges: orders and formats.
void measure_import(Rows& rows, const Subject& subject, const FrameOptions& options);
/// Normals of everything and of what a hundredth of the vertices changes.
void measure_normals(Rows& rows, const Subject& subject, const FrameOptions& options);
/// Trees: build, refit, rebuild; how rays slow down as refits go on, and when a rebuild pays.
void measure_trees(Rows& rows, const Subject& subject, const FrameOptions& options);
/// Embree's own speed on the rays of the next stage: shown, not ours.
void measure_rays(Rows& rows, const Subject& subject, const FrameOptions& options);
/// Connectivity at hits, in three orders, beside the baselines and what these take to build.
void measure_hits(Rows& rows, const Subject& subject, const FrameOptions& options);
/// The frame loop, one frame after the other and two at a time, and the same by OpenMesh.
void measure_frames(Rows& rows, const Subject& subject, const FrameOptions& options);

}  // namespace hedgerow::bench
