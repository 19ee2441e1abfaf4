// Embree 3 or 4, whichever the program was built with: what differs between them.
#pragma once

#include <rtcore.h>

namespace chironomia {

// Rays of a pack are neighbours. `valid` holds -1 for each ray that is followed, 0 for the others.
#if RTC_VERSION_MAJOR >= 4

inline void intersect(const int* valid, RTCScene scene, RTCRayHit8& rays) {
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcIntersect8(valid, scene, &rays, &arguments);
}

inline void occlude(const int* valid, RTCScene scene, RTCRay8& rays) {
    RTCOccludedArguments arguments;
    rtcInitOccludedArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_INCOHERENT;
    rtcOccluded8(valid, scene, &rays, &arguments);
}

#else

inline RTCIntersectContext coherent() {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    return context;
}

inline RTCIntersectContext incoherent() {
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT;
    return context;
}

inline void intersect(const int* valid, RTCScene scene, RTCRayHit8& rays) {
    RTCIntersectContext context = coherent();
    rtcIntersect8(valid, scene, &context, &rays);
}

inline void occlude(const int* valid, RTCScene scene, RTCRay8& rays) {
    RTCIntersectContext context = incoherent();
    rtcOccluded8(valid, scene, &context, &rays);
}

#endif

}  // namespace chironomia
