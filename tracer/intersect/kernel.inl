// SPDX-License-Identifier: Apache-2.0
// The kernel's text, over the eight lanes (Floats, Lanes) that the including file has defined. Included
// inside a namespace without a name, after kernels.h and exact_test.h: nothing here may be seen by code that
// is compiled for another instruction set. Bounds of the rounding errors are derived in
// docs/why/exact-intersection.md.

constexpr float unit_roundoff = 0x1p-24f;
// Below it floats begin to lose bits: no less counts as known.
constexpr float least_depth = 1e-37f;

// ---- Clusters ----------------------------------------------------------------------------

// The float twin of the exact test. `error` bounds the distance of u, v, w from those of the exact test.
struct Edges {
  Floats u, v, w, az, bz, cz, least, greatest, error;
};

inline Edges edges_of(const Cluster& cluster, const RayConstants& ray) {
  const Floats ox = fill(ray.origin[ray.x]), oy = fill(ray.origin[ray.y]), oz = fill(ray.origin[ray.z]);
  const Floats sx = fill(ray.shear_x), sy = fill(ray.shear_y);
  Edges e;
  e.az = sub(load(cluster.vertex[0][ray.z]), oz);
  e.bz = sub(load(cluster.vertex[1][ray.z]), oz);
  e.cz = sub(load(cluster.vertex[2][ray.z]), oz);
  const Floats ax = sub_mul(sub(load(cluster.vertex[0][ray.x]), ox), sx, e.az);
  const Floats ay = sub_mul(sub(load(cluster.vertex[0][ray.y]), oy), sy, e.az);
  const Floats bx = sub_mul(sub(load(cluster.vertex[1][ray.x]), ox), sx, e.bz);
  const Floats by = sub_mul(sub(load(cluster.vertex[1][ray.y]), oy), sy, e.bz);
  const Floats cx = sub_mul(sub(load(cluster.vertex[2][ray.x]), ox), sx, e.cz);
  const Floats cy = sub_mul(sub(load(cluster.vertex[2][ray.y]), oy), sy, e.cz);
  e.u = sub_mul(mul(cx, by), cy, bx);
  e.v = sub_mul(mul(ax, cy), ay, cx);
  e.w = sub_mul(mul(bx, ay), by, ax);
  const Floats s = max(max(max(abs(ax), abs(ay)), max(abs(bx), abs(by))), max(abs(cx), abs(cy)));
  const Floats z = max(max(abs(e.az), abs(e.bz)), abs(e.cz));
  const Floats w = add(s, z);
  const Floats uw = mul(fill(20 * unit_roundoff), w);
  e.error = mul_add(uw, mul_add(fill(4 * unit_roundoff), w, s), fill(1e-30f));
  e.least = min(min(e.u, e.v), e.w);
  e.greatest = max(max(e.u, e.v), e.w);
  return e;
}

// Lanes that the exact test might accept.
inline Lanes may_hit(const Edges& e) { return less_equal(min(e.greatest, sub(fill(0), e.least)), e.error); }

// ζ of the hits, as fractions: ζ·det lies within earliest … latest. Only lanes in `known` say anything.
struct Depths {
  Floats det, earliest, latest;
  Lanes known;
};

inline Depths depths_of(const Edges& e, const RayConstants& ray) {
  const Floats sign = fill(ray.sign_z);
  const Floats a = mul(e.az, sign), b = mul(e.bz, sign), c = mul(e.cz, sign);
  const Floats nearest = min(min(a, b), c), farthest = max(max(a, b), c);
  const Floats signed_det = add(add(e.u, e.v), e.w);
  const Floats zeta = flip_by(mul_add(e.u, a, mul_add(e.v, b, mul(e.w, c))), signed_det);
  Depths d;
  d.det = abs(signed_det);
  const Floats depth = mul_add(fill(40 * unit_roundoff), max(abs(nearest), abs(farthest)), fill(least_depth));
  const Floats rounding = mul_add(depth, d.det, fill(10 * least_depth));
  const Floats error = mul_add(mul(fill(20), e.error), sub(farthest, nearest), rounding);
  d.earliest = sub(zeta, error);
  d.latest = add(zeta, error);
  // The second condition keeps overflow out: with it |ζ·det| is finite too.
  d.known = both(less_equal(mul(fill(8), e.error), d.det), less_equal(error, fill(1e30f)));
  return d;
}

// Lanes whose ζ is certainly not in (0, limit].
inline Lanes out_of_range(const Depths& d, float limit) {
  const Floats behind = mul(fill(limit * (1 + 1e-6f)), d.det);
  return both(d.known, either(less_equal(d.latest, fill(0)), less_equal(behind, d.earliest)));
}

// ζ of hit.t, and enough more that no equal or lesser t is lost in float.
inline float zeta_limit(const RayConstants& ray, double t) {
  return static_cast<float>(t * __builtin_fabs(ray.direction_z)) * (1 + 2e-6f) + least_depth;
}

// Returns the limit on ζ that holds afterwards. `index` of the cluster.
inline float closest_in_cluster(const Cluster& cluster, std::uint32_t index, const RayConstants& ray,
                                float limit, Hit& hit) {
  const Edges e = edges_of(cluster, ray);
  unsigned lanes = bits(may_hit(e));
  if (!lanes) return limit;
  lanes &= ~bits(out_of_range(depths_of(e, ray), limit));
  for (; lanes; lanes &= lanes - 1) {
    const unsigned lane = static_cast<unsigned>(__builtin_ctz(lanes));
    const std::uint32_t id = cluster.id[lane];
    ExactHit exact;
    if (id == ray.exclude || !seen_hit(ray, cluster, lane, exact)) continue;
    if (!(exact.t < hit.t || (exact.t == hit.t && id < hit.triangle))) continue;
    hit.t = exact.t;
    hit.triangle = id;
    hit.cluster = index;
    hit.lane = lane;
    hit.depth = 0;
    hit.u = exact.u;
    hit.v = exact.v;
    limit = zeta_limit(ray, hit.t);
  }
  return limit;
}

inline bool occluded_in_cluster(const Cluster& cluster, const RayConstants& ray, float tmax) {
  const Edges e = edges_of(cluster, ray);
  unsigned lanes = bits(may_hit(e));
  if (!lanes) return false;
  const Depths d = depths_of(e, ray);
  const float limit = zeta_limit(ray, tmax);
  lanes &= ~bits(out_of_range(d, limit));
  if (!lanes) return false;
  // Lanes that the exact test certainly accepts.
  const Floats zero = fill(0);
  const Lanes inside = either(less_equal(e.error, e.least), less_equal(e.greatest, sub(zero, e.error)));
  // 2⁻²⁰ of the origin and of the way is more than a setback.
  const float certain_limit = (limit - 3 * least_depth) * (1 - 7e-6f) - ray.drift * 0x1p27f;
  const Lanes in_range =
      both(less_equal(fill(least_depth), d.earliest), less_equal(d.latest, mul(fill(certain_limit), d.det)));
  const unsigned certain = bits(both(both(inside, in_range), d.known));
  for (; lanes; lanes &= lanes - 1) {
    const unsigned lane = static_cast<unsigned>(__builtin_ctz(lanes));
    if (cluster.id[lane] == ray.exclude) continue;
    ExactHit exact;
    if (certain >> lane & 1 || (seen_hit(ray, cluster, lane, exact) && exact.t < double{tmax})) return true;
  }
  return false;
}

// ---- Trees -------------------------------------------------------------------------------

// A subtree to visit: the bits of its entry ζ ≥ 0, which order as ζ does, above its reference.
using Pending = std::uint64_t;
constexpr int stack_size = 7 * max_bvh_depth + 8;

inline Pending pending(float zeta, std::uint32_t reference) {
  return static_cast<Pending>(__builtin_bit_cast(std::uint32_t, zeta)) << 32 | reference;
}
inline std::uint32_t reference_of(Pending p) { return static_cast<std::uint32_t>(p); }
inline float zeta_of(Pending p) { return __builtin_bit_cast(float, static_cast<std::uint32_t>(p >> 32)); }

// The ray against boxes: ζ = x·scale + offset is where it meets the plane at x, less (entry) or more (exit) a
// bound of what rounding does: 8u|o·scale|, and the boxes' own inflation by 10⁻⁶|x| for what is proportional
// to x. Both get `drift` more.
struct Slabs {
  explicit Slabs(const RayConstants& ray) {
    for (int a = 0; a < 3; ++a) {
      const float scale_a = ray.inverse_direction[a], offset = -ray.origin[a] * scale_a;
      const float rounding =
          8 * unit_roundoff * __builtin_fabsf(offset) + ray.drift * __builtin_fabsf(scale_a);
      scale[a] = fill(scale_a);
      entry_offset[a] = fill(offset - rounding);
      exit_offset[a] = fill(offset + rounding);
      near[a] = ray.near_row[a] * 8;
      far[a] = (static_cast<std::uint32_t>(a) * 2 + 3) * 8 - near[a];
    }
  }
  static constexpr float widest = 1e38f;
  // In an object: ζ is the ray's own s, and the margins grow by its pad. Where a transform leaves the numbers
  // of floats they are so wide that every child is entered, and finite, so that the box of none is not.
  explicit Slabs(const InstanceRay& ray) {
    for (std::uint32_t a = 0; a < 3; ++a) {
      const float scale_a = static_cast<float>(ray.inverse_direction[a]);
      const float offset = static_cast<float>(-ray.origin[a] * ray.inverse_direction[a]);
      const float margin = static_cast<float>(ray.pad[a]) * __builtin_fabsf(scale_a) * (1 + 1e-6f) +
                           8 * unit_roundoff * __builtin_fabsf(offset);
      scale[a] = fill(scale_a);
      entry_offset[a] = fill(offset - margin > -widest ? offset - margin : -widest);
      exit_offset[a] = fill(offset + margin < widest ? offset + margin : widest);
      near[a] = (__builtin_signbit(scale_a) ? a + 3 : a) * 8;
      far[a] = (a * 2 + 3) * 8 - near[a];
    }
  }
  Floats scale[3], entry_offset[3], exit_offset[3];
  std::uint32_t near[3], far[3];  // offsets into the boxes of a node, in floats
};

// Children that the ray enters at ζ in [0, limit]; `entry` is where.
inline unsigned entered_children(const BvhNode& node, const Slabs& ray, float limit, Floats& entry) {
  const float* rows = &node.lower[0][0];
  const Floats n0 = mul_add(load(rows + ray.near[0]), ray.scale[0], ray.entry_offset[0]);
  const Floats n1 = mul_add(load(rows + ray.near[1]), ray.scale[1], ray.entry_offset[1]);
  const Floats n2 = mul_add(load(rows + ray.near[2]), ray.scale[2], ray.entry_offset[2]);
  const Floats f0 = mul_add(load(rows + ray.far[0]), ray.scale[0], ray.exit_offset[0]);
  const Floats f1 = mul_add(load(rows + ray.far[1]), ray.scale[1], ray.exit_offset[1]);
  const Floats f2 = mul_add(load(rows + ray.far[2]), ray.scale[2], ray.exit_offset[2]);
  entry = max(max(n0, n1), max(n2, fill(0)));
  return bits(less_equal(entry, min(min(f0, f1), min(f2, fill(limit)))));
}

// `Leaf`: a cluster or an instance.
template <class Leaf>
inline void prefetch(const BvhNode* nodes, const Leaf* leaves, std::uint32_t reference) {
  const char* at = reference & BvhNode::cluster_bit
                       ? reinterpret_cast<const char*>(leaves + (reference & ~BvhNode::cluster_bit))
                       : reinterpret_cast<const char*>(nodes + reference);
  for (int byte = 0; byte < 256; byte += 64) __builtin_prefetch(at + byte);
}

// Puts the entered children (one at least) on the stack, the nearer the later, but for the nearest, which is
// returned.
template <class Leaf>
inline std::uint32_t push_but_nearest(const BvhNode* nodes, const Leaf* leaves, const BvhNode& node,
                                      unsigned children, Floats entry, Pending*& top) {
  unsigned rest = children & (children - 1);
  if (!rest) return first_of(node.child, children);
  alignas(32) float zeta[8];
  store(zeta, entry);
  const auto first = [&](unsigned lanes) {
    const int i = __builtin_ctz(lanes);
    return pending(zeta[i], node.child[i]);
  };
  Pending nearest = first(children);
  Pending* const bottom = top;
  do {  // insertion sort, with the nearest kept apart
    const Pending p = first(rest);
    const Pending farther = p > nearest ? p : nearest;
    nearest = p > nearest ? nearest : p;
    prefetch(nodes, leaves, reference_of(farther));
    Pending* place = top++;
    for (; place != bottom && place[-1] < farther; --place) *place = place[-1];
    *place = farther;
    rest &= rest - 1;
  } while (rest);
  return reference_of(nearest);
}

// Whether another node's children might not fit. No tree is so deep: but a file that is cut short while it is
// mapped reads as zeros, nodes that are their own children, until the job sees that it was changed.
template <class Entry>
inline bool is_full(const Entry* top, const Entry (&stack)[stack_size]) {
  return top > stack + (stack_size - 8);
}

// The leaves that the ray enters at ζ ≤ limit, nearest first. `visit(index, limit)` returns the limit that
// holds afterwards.
template <class Leaf, class Visit>
inline void visit_nearest_first(const BvhNode* nodes, const Leaf* leaves, const Slabs& slabs, float limit,
                                const Visit& visit) {
  Pending stack[stack_size];
  Pending* top = stack;
  std::uint32_t at = 0;
  for (;;) {
    if (at & BvhNode::cluster_bit) {
      limit = visit(at & ~BvhNode::cluster_bit, limit);
    } else {
      Floats entry;
      const unsigned children = entered_children(nodes[at], slabs, limit, entry);
      if (is_full(top, stack)) [[unlikely]]
        return;
      if (children) {
        at = push_but_nearest(nodes, leaves, nodes[at], children, entry, top);
        continue;
      }
    }
    do {
      if (top == stack) return;
      --top;
    } while (zeta_of(*top) > limit);
    at = reference_of(*top);
  }
}

// Whether `visit(index)` is true of any leaf that the ray enters at ζ ≤ limit.
template <class Leaf, class Visit>
inline bool any_entered(const BvhNode* nodes, const Leaf* leaves, const Slabs& slabs, float limit,
                        const Visit& visit) {
  std::uint32_t stack[stack_size];
  std::uint32_t* top = stack;
  std::uint32_t at = 0;
  for (;;) {
    if (at & BvhNode::cluster_bit) {
      if (visit(at & ~BvhNode::cluster_bit)) return true;
    } else {
      const BvhNode& node = nodes[at];
      Floats entry;
      unsigned children = entered_children(node, slabs, limit, entry);
      if (is_full(top, stack)) [[unlikely]]
        return false;
      for (; children; children &= children - 1) {
        *top = node.child[__builtin_ctz(children)];
        prefetch(nodes, leaves, *top++);
      }
    }
    if (top == stack) return false;
    at = *--top;
  }
}

void closest_in_tree(const BvhNode* nodes, const Cluster* clusters, const Slabs& slabs,
                     const RayConstants& ray, Hit& hit) {
  visit_nearest_first(nodes, clusters, slabs, zeta_limit(ray, hit.t), [&](std::uint32_t c, float limit) {
    return closest_in_cluster(clusters[c], c, ray, limit, hit);
  });
}

bool occluded_in_tree(const BvhNode* nodes, const Cluster* clusters, const Slabs& slabs,
                      const RayConstants& ray, float tmax) {
  return any_entered(nodes, clusters, slabs, zeta_limit(ray, tmax),
                     [&](std::uint32_t c) { return occluded_in_cluster(clusters[c], ray, tmax); });
}

void tree_closest(const BvhNode* nodes, const Cluster* clusters, const RayConstants& ray, Hit& hit) {
  closest_in_tree(nodes, clusters, Slabs(ray), ray, hit);
}

bool tree_occluded(const BvhNode* nodes, const Cluster* clusters, const RayConstants& ray, float tmax) {
  return occluded_in_tree(nodes, clusters, Slabs(ray), ray, tmax);
}

#include "tracer/intersect/kernel_domains.inl"
#include "tracer/intersect/kernel_many.inl"

// ---- Clusters by themselves ----------------------------------------------------------------

void cluster_closest(const Cluster& cluster, std::uint32_t index, const RayConstants& ray, Hit& hit) {
  closest_in_cluster(cluster, index, ray, zeta_limit(ray, hit.t), hit);
}

bool cluster_occluded(const Cluster& cluster, const RayConstants& ray, float tmax) {
  return occluded_in_cluster(cluster, ray, tmax);
}

constexpr KernelFunctions functions{tree_closest,      tree_occluded,      domain_closest,  domain_occluded,
                                    instances_closest, instances_occluded, cluster_closest, cluster_occluded,
                                    node_closest,      node_occluded,      domains_closest, domains_occluded};
