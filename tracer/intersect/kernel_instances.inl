// SPDX-License-Identifier: Apache-2.0
// The part of kernel.inl that goes through instances: a ray in each object's own space finds its clusters,
// which are placed in the scene and tested there.

typedef double EightDoubles __attribute__((vector_size(64)));
typedef float EightFloats __attribute__((vector_size(32), may_alias));

// A cluster of an object where it stands: `placed`, of eight vertices at a time.
inline void place_cluster(const Cluster& local, const InstanceRay& at, Cluster& out) {
  for (int k = 0; k < 3; ++k) {
    const auto& from = local.vertex[at.mirrored && k > 0 ? 3 - k : k];
    EightDoubles p[3];
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = __builtin_convertvector(*reinterpret_cast<const EightFloats*>(from[axis]), EightDoubles);
    for (int axis = 0; axis < 3; ++axis) {
      const auto& row = at.to_bundle.m[axis];
      const EightDoubles sum = row[0] * p[0] + row[1] * p[1] + row[2] * p[2] + row[3];
      *reinterpret_cast<EightFloats*>(out.vertex[k][axis]) = __builtin_convertvector(sum, EightFloats) + 0.0f;
    }
  }
  for (int lane = 0; lane < cluster_width; ++lane)
    out.id[lane] = number_from(at.first_triangle, local.id[lane]);
}

// The limit on s in an object that a limit on ζ means, rounded up.
inline float local_limit(const InstanceRay& ray, float limit) {
  if (ray.depth == 0) return limit;
  const double end = double{limit} < ray.exit ? double{limit} : ray.exit;
  return static_cast<float>((end - ray.entry) * ray.unit * (1 + 1e-6));
}

inline float closest_in_placed(std::uint32_t index, const InstanceRay& at, const RayConstants& ray,
                               float limit, Hit& hit) {
  Cluster there;
  place_cluster(at.clusters[index], at, there);
  const double t = hit.t;
  const std::uint32_t triangle = hit.triangle;
  limit = closest_in_cluster(there, index, ray, limit, hit);
  if (hit.t == t && hit.triangle == triangle) return limit;
  hit.depth = at.depth;
  for (std::uint32_t i = 0; i < at.depth; ++i) hit.chain[i] = at.chain[i];
  return limit;
}

// In the instances of where `outer` is; `slabs` of the ray there.
float closest_in_instances(InstanceRay& outer, const Slabs& slabs, const RayConstants& ray, float limit,
                           Hit& hit) {
  const auto enter = [&](std::uint32_t index) {
    if (is_quadric(outer, index)) {
      if (closest_in_quadric(ray, outer, index, hit)) limit = zeta_limit(ray, hit.t);
      return;
    }
    InstanceRay inner;
    if (!enter_instance(ray, outer, index, limit, inner)) return;
    const Slabs inner_slabs(inner);
    if (inner.nodes)
      visit_nearest_first(inner.nodes, inner.clusters, inner_slabs, local_limit(inner, limit),
                          [&](std::uint32_t c, float) {
                            limit = closest_in_placed(c, inner, ray, limit, hit);
                            return local_limit(inner, limit);
                          });
    if (inner.instance_nodes) limit = closest_in_instances(inner, inner_slabs, ray, limit, hit);
  };
  visit_nearest_first(outer.instance_nodes, outer.instances, slabs, local_limit(outer, limit),
                      [&](std::uint32_t index, float) {
                        enter(index);
                        return local_limit(outer, limit);
                      });
  return limit;
}

inline void closest_in_domain(const DomainView& domain, const Slabs& slabs, const RayConstants& ray,
                              Hit& hit) {
  InstanceRay outer;
  enter_domain(domain, outer);
  if (outer.nodes) closest_in_tree(outer.nodes, outer.clusters, slabs, ray, hit);
  if (outer.instance_nodes) closest_in_instances(outer, slabs, ray, zeta_limit(ray, hit.t), hit);
}

void domain_closest(const DomainView& domain, const RayConstants& ray, Hit& hit) {
  closest_in_domain(domain, Slabs(ray), ray, hit);
}

bool occluded_in_instances(InstanceRay& outer, const Slabs& slabs, const RayConstants& ray, float limit,
                           float tmax) {
  const auto enter = [&](std::uint32_t index) {
    if (is_quadric(outer, index)) return occluded_in_quadric(ray, outer, index, tmax);
    InstanceRay inner;
    if (!enter_instance(ray, outer, index, limit, inner)) return false;
    const Slabs inner_slabs(inner);
    const auto in_cluster = [&](std::uint32_t c) {
      Cluster there;
      place_cluster(inner.clusters[c], inner, there);
      return occluded_in_cluster(there, ray, tmax);
    };
    if (inner.nodes &&
        any_entered(inner.nodes, inner.clusters, inner_slabs, local_limit(inner, limit), in_cluster))
      return true;
    return inner.instance_nodes && occluded_in_instances(inner, inner_slabs, ray, limit, tmax);
  };
  return any_entered(outer.instance_nodes, outer.instances, slabs, local_limit(outer, limit), enter);
}

inline bool occluded_in_domain(const DomainView& domain, const Slabs& slabs, const RayConstants& ray,
                               float tmax) {
  InstanceRay outer;
  enter_domain(domain, outer);
  if (outer.nodes && occluded_in_tree(outer.nodes, outer.clusters, slabs, ray, tmax)) return true;
  return outer.instance_nodes && occluded_in_instances(outer, slabs, ray, zeta_limit(ray, tmax), tmax);
}

bool domain_occluded(const DomainView& domain, const RayConstants& ray, float tmax) {
  return occluded_in_domain(domain, Slabs(ray), ray, tmax);
}

void instances_closest(const DomainView& domain, const RayConstants& ray, Hit& hit) {
  InstanceRay outer;
  enter_domain(domain, outer);
  closest_in_instances(outer, Slabs(ray), ray, zeta_limit(ray, hit.t), hit);
}

bool instances_occluded(const DomainView& domain, const RayConstants& ray, float tmax) {
  InstanceRay outer;
  enter_domain(domain, outer);
  return occluded_in_instances(outer, Slabs(ray), ray, zeta_limit(ray, tmax), tmax);
}
