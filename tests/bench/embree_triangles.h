// SPDX-License-Identifier: Apache-2.0
// Embree as the benchmarks of intersection ask it: one ray at a time.
#pragma once

#include <embree3/rtcore.h>

#include <algorithm>

#include "tests/partitioner/hierarchy/clustered_mesh.h"

namespace vitrail::test {

inline RTCRay embree_ray(const Ray& ray, float tmax) {
  const Point3f o = ray.origin;
  const Vector3f d = ray.direction;
  return {o.x, o.y, o.z, 0, d.x, d.y, d.z, 0, tmax, 0xffffffffu, 0, 0};
}

inline RTCRayHit closest(RTCScene scene, const Ray& ray) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit r{embree_ray(ray, std::numeric_limits<float>::infinity()), {}};
  r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(scene, &context, &r);
  return r;
}

inline bool occluded(RTCScene scene, const Ray& ray, float tmax) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay r = embree_ray(ray, tmax);
  rtcOccluded1(scene, &context, &r);
  return r.tfar < 0;
}

inline void attach(RTCScene scene, RTCGeometry geometry) {
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene, geometry);
  rtcReleaseGeometry(geometry);
}

inline void attach(RTCScene scene, const Triangles& triangles, RTCDevice device) {
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  const std::size_t count = triangles.size();
  auto* vertices = static_cast<Triangle*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, sizeof(Point3f), 3 * count));
  auto* indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), count));
  std::ranges::copy(triangles, vertices);
  for (std::uint32_t i = 0; i < 3 * count; ++i) indices[i] = i;
  attach(scene, geometry);
}

}  // namespace vitrail::test
