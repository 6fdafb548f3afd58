// SPDX-License-Identifier: Apache-2.0
#include <embree3/rtcore.h>

#include <cmath>
#include <string>

#include "scene/diagnostics.h"
#include "tracer/intersect/intersector.h"

namespace vitrail {
namespace {

using Device = std::unique_ptr<RTCDeviceTy, decltype(&rtcReleaseDevice)>;
using EmbreeScene = std::unique_ptr<RTCSceneTy, decltype(&rtcReleaseScene)>;

RTCDevice shared_device() {
  static const Device device(rtcNewDevice(nullptr), &rtcReleaseDevice);
  if (!device) throw MachineError("embree cannot start: error " + std::to_string(rtcGetDeviceError(nullptr)));
  return device.get();
}

// What the callbacks need of a query. `context` has to come first: Embree hands back a pointer to it.
struct Query {
  RTCIntersectContext context;
  const KernelFunctions* kernel;
  const Cluster* clusters;
  RayConstants ray;
  int exponent;  // of the direction's greatest component
  Hit* hit = nullptr;
  float tmax = 0;
};

// Embree's ray is the ray with its direction divided by a power of two, which is exact, and near unit length.
// Its tfar lies a little beyond t, so that no equal or lesser t is lost in float.
float embree_tfar(const Query& query, double t) {
  return static_cast<float>(std::ldexp(t, query.exponent)) * (1 + 2e-6f);
}

RTCRay embree_ray(const Query& query, const Ray& ray, double tmax) {
  RTCRay r{};
  r.org_x = ray.origin.x;
  r.org_y = ray.origin.y;
  r.org_z = ray.origin.z;
  r.dir_x = std::ldexp(ray.direction.x, -query.exponent);
  r.dir_y = std::ldexp(ray.direction.y, -query.exponent);
  r.dir_z = std::ldexp(ray.direction.z, -query.exponent);
  r.tfar = embree_tfar(query, tmax);
  r.mask = 0xffffffffu;
  return r;
}

void closest_in_cluster(const RTCIntersectFunctionNArguments* arguments) {
  Query& query = *reinterpret_cast<Query*>(arguments->context);
  query.kernel->cluster_closest(query.clusters, arguments->primID, query.ray, *query.hit);
  reinterpret_cast<RTCRayHit*>(arguments->rayhit)->ray.tfar = embree_tfar(query, query.hit->t);
}

void occluded_in_cluster(const RTCOccludedFunctionNArguments* arguments) {
  Query& query = *reinterpret_cast<Query*>(arguments->context);
  if (query.kernel->cluster_occluded(query.clusters, arguments->primID, query.ray, query.tmax)) {
    reinterpret_cast<RTCRay*>(arguments->ray)->tfar = -std::numeric_limits<float>::infinity();
  }
}

// The boxes of the clusters, as the nodes have them.
std::vector<RTCBounds> cluster_bounds(const DomainView& domain) {
  std::vector<RTCBounds> bounds(domain.clusters.size());
  for (const BvhNode& node : domain.nodes) {
    for (std::size_t i = 0; i < 8; ++i) {
      if (node.child[i] == BvhNode::empty || !(node.child[i] & BvhNode::cluster_bit)) continue;
      bounds[node.child[i] & ~BvhNode::cluster_bit] = {
          node.lower[0][i], node.lower[1][i], node.lower[2][i], 0,
          node.upper[0][i], node.upper[1][i], node.upper[2][i], 0};
    }
  }
  return bounds;
}

void bounds_of_cluster(const RTCBoundsFunctionArguments* arguments) {
  *arguments->bounds_o = static_cast<const RTCBounds*>(arguments->geometryUserPtr)[arguments->primID];
}

EmbreeScene commit_clusters(const DomainView& domain) {
  const RTCDevice device = shared_device();
  EmbreeScene scene(rtcNewScene(device), &rtcReleaseScene);
  // Robust: Embree's other box test loses boxes when the origin is far away.
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  std::vector<RTCBounds> bounds = cluster_bounds(domain);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(bounds.size()));
  rtcSetGeometryUserData(geometry, bounds.data());
  rtcSetGeometryBoundsFunction(geometry, bounds_of_cluster, nullptr);
  rtcSetGeometryIntersectFunction(geometry, closest_in_cluster);
  rtcSetGeometryOccludedFunction(geometry, occluded_in_cluster);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(scene.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcCommitScene(scene.get());
  if (const RTCError error = rtcGetDeviceError(device)) {
    throw MachineError("embree cannot build a hierarchy over " + std::to_string(bounds.size()) +
                       " clusters: error " + std::to_string(error));
  }
  return scene;
}

}  // namespace

struct EmbreeDomain::Implementation {
  const Cluster* clusters;
  EmbreeScene scene;
  const KernelFunctions& kernel;

  Query query(const Ray& ray) const {
    Query q{{}, &kernel, clusters, prepare(ray), 0};
    rtcInitIntersectContext(&q.context);
    q.exponent = std::ilogb(q.ray.direction_z);
    return q;
  }
};

EmbreeDomain::EmbreeDomain(const DomainView& domain)
    : implementation_(new Implementation{domain.clusters.data(), commit_clusters(domain), best_kernel()}) {}

EmbreeDomain::~EmbreeDomain() = default;

void EmbreeDomain::closest(const Ray& ray, Hit& hit) const {
  Query query = implementation_->query(ray);
  query.hit = &hit;
  RTCRayHit r{embree_ray(query, ray, hit.t), {}};
  r.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(implementation_->scene.get(), &query.context, &r);
}

bool EmbreeDomain::occluded(const Ray& ray, float tmax) const {
  Query query = implementation_->query(ray);
  query.tmax = tmax;
  RTCRay r = embree_ray(query, ray, double{tmax});
  rtcOccluded1(implementation_->scene.get(), &query.context, &r);
  return r.tfar < 0;
}

}  // namespace vitrail
