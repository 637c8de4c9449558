#pragma once

/// The one place that includes Embree, and all in which its versions 3.13 and 4 differ for us: the
/// name of the folder, and how flags are passed with a ray. CMake has chosen the version that the
/// library is linked with; headers lying about prove nothing.
#if HEDGEROW_EMBREE_MAJOR >= 4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include "hedgerow/ray/ray.h"

namespace hedgerow::ray::embree {

#if HEDGEROW_EMBREE_MAJOR >= 4

/// What goes along with every query.
class Query {
 public:
  explicit Query(Coherence coherence) noexcept {
    const auto flags = coherence == Coherence::coherent ? RTC_RAY_QUERY_FLAG_COHERENT
                                                        : RTC_RAY_QUERY_FLAG_INCOHERENT;
    rtcInitIntersectArguments(&intersect_);
    rtcInitOccludedArguments(&occluded_);
    intersect_.flags = flags;
    occluded_.flags = flags;
  }
  void intersect(RTCScene scene, RTCRayHit& ray) noexcept {
    rtcIntersect1(scene, &ray, &intersect_);
  }
  void intersect(const int* valid, RTCScene scene, RTCRayHit8& rays) noexcept {
    rtcIntersect8(valid, scene, &rays, &intersect_);
  }
  void occluded(RTCScene scene, RTCRay& ray) noexcept { rtcOccluded1(scene, &ray, &occluded_); }
  void occluded(const int* valid, RTCScene scene, RTCRay8& rays) noexcept {
    rtcOccluded8(valid, scene, &rays, &occluded_);
  }

 private:
  RTCIntersectArguments intersect_;
  RTCOccludedArguments occluded_;
};

#else

/// What goes along with every query.
class Query {
 public:
  explicit Query(Coherence coherence) noexcept {
    rtcInitIntersectContext(&context_);
    context_.flags = coherence == Coherence::coherent ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT
                                                      : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
  }
  void intersect(RTCScene scene, RTCRayHit& ray) noexcept { rtcIntersect1(scene, &context_, &ray); }
  void intersect(const int* valid, RTCScene scene, RTCRayHit8& rays) noexcept {
    rtcIntersect8(valid, scene, &context_, &rays);
  }
  void occluded(RTCScene scene, RTCRay& ray) noexcept { rtcOccluded1(scene, &context_, &ray); }
  void occluded(const int* valid, RTCScene scene, RTCRay8& rays) noexcept {
    rtcOccluded8(valid, scene, &context_, &rays);
  }

 private:
  RTCIntersectContext context_{};
};

#endif

}  // namespace hedgerow::ray::embree
