// SPDX-License-Identifier: Apache-2.0
// The part of kernel.inl that takes many rays at a time through a domain of one node. What floats leave in
// doubt of all of them is gathered, and the exact test decides it for `exact_width` pairs of a ray and a
// triangle side by side: no ray waits for the branches of another.

// ---- The exact test, one pair a lane: exact_test.cpp's operations in its order
// ------------------------------

constexpr int exact_width = 64 / static_cast<int>(sizeof(double)) / exact_parts;
using Exact = lanes::Doubles<exact_width>;
using ExactFloats = lanes::Floats<exact_width>;

constexpr std::uint32_t most_pairs = 128, most_rays = 32, most_of_one_ray = 64;

// Pairs that are to be decided.
struct Pairs {
  alignas(64) float vertex[3][3][most_pairs];  // by the ray's axes x, y, z
  alignas(64) float origin[3][most_pairs], drift[most_pairs];
  alignas(64) double shear_x[most_pairs], shear_y[most_pairs], direction_z[most_pairs];
  alignas(64) double t[most_pairs], u[most_pairs], v[most_pairs];  // t: ∞ where nothing is hit
  std::uint32_t ray[most_pairs], cluster[most_pairs], lane[most_pairs], id[most_pairs];
  std::uint32_t count;
};

inline void add_pair(Pairs& pairs, const RayConstants& ray, std::uint32_t number, const Cluster& cluster,
                     std::uint32_t index, unsigned lane) {
  const std::uint32_t i = pairs.count++;
  for (int k = 0; k < 3; ++k) {
    pairs.vertex[k][0][i] = cluster.vertex[k][ray.x][lane];
    pairs.vertex[k][1][i] = cluster.vertex[k][ray.y][lane];
    pairs.vertex[k][2][i] = cluster.vertex[k][ray.z][lane];
  }
  pairs.origin[0][i] = ray.origin[ray.x];
  pairs.origin[1][i] = ray.origin[ray.y];
  pairs.origin[2][i] = ray.origin[ray.z];
  pairs.drift[i] = ray.drift;
  pairs.shear_x[i] = ray.exact_shear_x;
  pairs.shear_y[i] = ray.exact_shear_y;
  pairs.direction_z[i] = ray.direction_z;
  pairs.ray[i] = number;
  pairs.cluster[i] = index;
  pairs.lane[i] = lane;
  pairs.id[i] = cluster.id[lane];
}

VITRAIL_LANES Exact exact_doubles(const float* p) {
  return lanes::to_doubles(*reinterpret_cast<const ExactFloats*>(p));
}
VITRAIL_LANES Exact exact_load(const double* p) { return *reinterpret_cast<const Exact*>(p); }
VITRAIL_LANES Exact max3(Exact a, Exact b, Exact c) { return lanes::max(lanes::max(a, b), c); }
VITRAIL_LANES Exact min3(Exact a, Exact b, Exact c) { return lanes::min(lanes::min(a, b), c); }
VITRAIL_LANES Exact sum3(Exact a, Exact b, Exact c) {
  const Exact low = lanes::min(a, b), high = lanes::max(a, b);
  return lanes::min(low, c) + lanes::max(high, c) + lanes::max(low, lanes::min(high, c));
}

struct ShearedLanes {
  Exact x, y, z, greatest;  // greatest: |coordinate| of the vertex
};
VITRAIL_LANES ShearedLanes shear(const Pairs& pairs, int k, std::uint32_t i) {
  const Exact px = exact_doubles(&pairs.vertex[k][0][i]), py = exact_doubles(&pairs.vertex[k][1][i]),
              pz = exact_doubles(&pairs.vertex[k][2][i]);
  const Exact z = pz - exact_doubles(&pairs.origin[2][i]);
  const Exact x = px - exact_doubles(&pairs.origin[0][i]);
  const Exact y = py - exact_doubles(&pairs.origin[1][i]);
  return {x - exact_load(&pairs.shear_x[i]) * z, y - exact_load(&pairs.shear_y[i]) * z, z,
          max3(lanes::abs(px), lanes::abs(py), lanes::abs(pz))};
}
VITRAIL_LANES Exact lateral(const ShearedLanes& a) { return lanes::max(lanes::abs(a.x), lanes::abs(a.y)); }

// seen_hit of the pairs i … i + exact_width − 1.
VITRAIL_LANES void decide_lanes(Pairs& pairs, std::uint32_t i) {
  const ShearedLanes a = shear(pairs, 0, i), b = shear(pairs, 1, i), c = shear(pairs, 2, i);
  const Exact u = c.x * b.y - c.y * b.x;
  const Exact v = a.x * c.y - a.y * c.x;
  const Exact w = b.x * a.y - b.y * a.x;
  const auto outside = (min3(u, v, w) < 0) & (max3(u, v, w) > 0);
  const Exact det = sum3(u, v, w);
  const Exact s = max3(lateral(a), lateral(b), lateral(c));
  const Exact reach = max3(a.greatest, b.greatest, c.greatest);
  const Exact far = s + max3(lanes::abs(a.z), lanes::abs(b.z), lanes::abs(c.z));
  const Exact span = max3(a.z, b.z, c.z) - min3(a.z, b.z, c.z);
  const Exact sw = s * far, conditioned = lanes::abs(det), flat = 5e-9 * span;
  const auto holds = (conditioned * a.greatest > sw * (flat + 6e-15 * a.greatest)) |
                     (conditioned * reach > sw * (flat + 6e-15 * reach));
  const Exact direction_z = exact_load(&pairs.direction_z[i]);
  Exact t = sum3(u * a.z, v * b.z, w * c.z) / det / direction_z;
  const auto hit = ~outside & holds & (t > 0);
  const auto front = (det > 0) == (direction_z > 0);
  const Exact from = exact_doubles(&pairs.drift[i]) * 0x1p47, depth = lanes::abs(direction_z);
  const Exact back = 0x1p-21 * lanes::min(reach, from + t * depth) / depth;
  t = lanes::select<Exact>(front, t, t + back);
  *reinterpret_cast<Exact*>(&pairs.t[i]) = lanes::select<Exact>(hit, t, lanes::fill<Exact>(__builtin_inf()));
  *reinterpret_cast<Exact*>(&pairs.u[i]) = v / det;
  *reinterpret_cast<Exact*>(&pairs.v[i]) = w / det;
}

// What is behind the last pair is whatever was there.
inline void decide(Pairs& pairs) {
  for (std::uint32_t i = 0; i < pairs.count; i += exact_width) decide_lanes(pairs, i);
}

// ---- What floats say
// ---------------------------------------------------------------------------------------

// A cluster that a ray enters, and what floats know of the ray there.
struct Entered {
  Floats det, earliest;
  unsigned known, lanes;  // lanes: that the exact test might accept
  std::uint32_t cluster, ray;
};

// The work of many rays on the clusters of a node. It is laid out by kinds of work, as to how many clusters a
// ray comes, and in which it may hit, no branch can foretell.
struct NodeWork {
  Entered entered[8 * most_rays];
  Floats certain[most_rays];  // no less than ζ of a hit that the exact test certainly accepts
  float limit[most_rays];
  std::uint32_t count;
};

inline void enter_node(const BvhNode& node, const RayConstants& ray, std::uint32_t number, const Hit& hit,
                       NodeWork& work) {
  const Slabs slabs(ray);
  const float limit = zeta_limit(ray, hit.t);
  Floats entry;
  unsigned children = entered_children(node, slabs, limit, entry);
  work.limit[number] = limit;
  work.certain[number] = fill(limit);
  const std::uint32_t first = work.count;
  work.count += static_cast<std::uint32_t>(__builtin_popcount(children));
  // Of most rays not more than four: what is behind the last is written over.
  std::uint32_t i = first;
  do {
    for (int k = 0; k < 4; ++k, ++i, children &= children - 1) {
      work.entered[i].cluster = node.child[__builtin_ctz(children | 0x80)] & ~BvhNode::cluster_bit;
      work.entered[i].ray = number;
    }
  } while (children);
}

inline void look_into(const Cluster& cluster, const RayConstants& ray, Entered& e, Floats& certain) {
  const Floats zero = fill(0);
  const Edges edges = edges_of(cluster, ray);
  const Depths d = depths_of(edges, ray);
  const Lanes others = unlike(cluster.id, ray.exclude);
  const Lanes inside =
      either(less_equal(edges.error, edges.least), less_equal(edges.greatest, sub(zero, edges.error)));
  const Lanes in_front = both(less_equal(fill(least_depth), d.earliest), less_equal(d.det, fill(1e30f)));
  const Lanes sure = both(both(inside, d.known), both(others, in_front));
  certain = min(certain, choose(sure, mul(d.latest, reciprocal_above(d.det)), certain));
  e.det = d.det;
  e.earliest = d.earliest;
  e.known = bits(d.known);
  e.lanes = bits(both(may_hit(edges), others)) & ~bits(both(d.known, less_equal(d.latest, zero)));
}

// The pairs of rays, not more than most_rays, that may lower their hits are handed to `take` in portions.
template <class Take>
inline void gather_closest(const BvhNode& node, const Cluster* clusters, const RayConstants* rays,
                           Hit* const* hits, std::uint32_t count, Pairs& pairs, const Take& take) {
  NodeWork work;
  work.count = 0;
  for (std::uint32_t i = 0; i < count; ++i) enter_node(node, rays[i], i, *hits[i], work);
  for (std::uint32_t i = 0; i < work.count; ++i) {
    Entered& e = work.entered[i];
    look_into(clusters[e.cluster], rays[e.ray], e, work.certain[e.ray]);
  }
  float behind[most_rays];
  for (std::uint32_t i = 0; i < count; ++i) {
    // More than a setback farther, as in occluded_in_cluster.
    const float nearest = least(work.certain[i]) * (1 + 7e-6f) + rays[i].drift * 0x1p27f + 3 * least_depth;
    behind[i] = (nearest < work.limit[i] ? nearest : work.limit[i]) * (1 + 1e-6f);
  }
  std::uint32_t in_doubt = 0;
  for (std::uint32_t i = 0; i < work.count; ++i) {
    Entered& e = work.entered[i];
    e.lanes &= ~(e.known & bits(less_equal(mul(fill(behind[e.ray]), e.det), e.earliest)));
    work.entered[in_doubt].cluster = e.cluster;
    work.entered[in_doubt].ray = e.ray;
    work.entered[in_doubt].lanes = e.lanes;
    in_doubt += e.lanes != 0;
  }
  for (std::uint32_t i = 0; i < in_doubt; ++i) {
    const Entered& e = work.entered[i];
    for (unsigned lanes = e.lanes; lanes; lanes &= lanes - 1) {
      if (pairs.count == most_pairs) take();
      add_pair(pairs, rays[e.ray], e.ray, clusters[e.cluster], e.cluster,
               static_cast<unsigned>(__builtin_ctz(lanes)));
    }
  }
  take();
}

inline void lower_hits(const Pairs& pairs, Hit* const* hits) {
  for (std::uint32_t i = 0; i < pairs.count; ++i) {
    Hit& hit = *hits[pairs.ray[i]];
    const double t = pairs.t[i];
    if (!(t < hit.t || (t == hit.t && pairs.id[i] < hit.triangle))) continue;
    if (t == __builtin_inf()) continue;
    hit.t = t;
    hit.triangle = pairs.id[i];
    hit.cluster = pairs.cluster[i];
    hit.lane = pairs.lane[i];
    hit.depth = 0;
    hit.u = pairs.u[i];
    hit.v = pairs.v[i];
  }
}

void node_closest(const BvhNode& node, const Cluster* clusters, const RayConstants* rays, Hit* const* hits,
                  std::size_t count) {
  Pairs pairs;
  pairs.count = 0;
  for (std::size_t i = 0; i < count; i += most_rays) {
    const std::size_t n = count - i < most_rays ? count - i : most_rays;
    gather_closest(node, clusters, rays + i, hits + i, static_cast<std::uint32_t>(n), pairs, [&] {
      decide(pairs);
      lower_hits(pairs, hits + i);
      pairs.count = 0;
    });
  }
}

// The pairs of a ray that may be in its way. True, and none is added, where one certainly is.
inline bool gather_occluded(const BvhNode& node, const Cluster* clusters, const RayConstants& ray,
                            std::uint32_t number, float tmax, Pairs& pairs) {
  const Slabs slabs(ray);
  const float limit = zeta_limit(ray, tmax);
  Floats entry;
  unsigned children = entered_children(node, slabs, limit, entry);
  const std::uint32_t before = pairs.count;
  const Floats zero = fill(0);
  const Floats certain_limit = fill((limit - 3 * least_depth) * (1 - 7e-6f) - ray.drift * 0x1p27f);
  for (; children; children &= children - 1) {
    const std::uint32_t index = node.child[__builtin_ctz(children)] & ~BvhNode::cluster_bit;
    const Cluster& cluster = clusters[index];
    const Edges e = edges_of(cluster, ray);
    const Depths d = depths_of(e, ray);
    const Lanes others = unlike(cluster.id, ray.exclude);
    const Lanes inside = either(less_equal(e.error, e.least), less_equal(e.greatest, sub(zero, e.error)));
    const Lanes in_range =
        both(less_equal(fill(least_depth), d.earliest), less_equal(d.latest, mul(certain_limit, d.det)));
    if (bits(both(both(inside, in_range), both(d.known, others)))) {
      pairs.count = before;
      return true;
    }
    unsigned lanes = bits(both(may_hit(e), others)) & ~bits(out_of_range(d, limit));
    for (; lanes; lanes &= lanes - 1)
      add_pair(pairs, ray, number, cluster, index, static_cast<unsigned>(__builtin_ctz(lanes)));
  }
  return false;
}

inline void mark_blocked(const Pairs& pairs, const float* tmax, bool* blocked) {
  for (std::uint32_t i = 0; i < pairs.count; ++i) {
    const std::uint32_t ray = pairs.ray[i];
    blocked[ray] |= pairs.t[i] < double{tmax[ray]};
  }
}

void node_occluded(const BvhNode& node, const Cluster* clusters, const RayConstants* rays, const float* tmax,
                   bool* blocked, std::size_t count) {
  Pairs pairs;
  pairs.count = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (pairs.count > most_pairs - most_of_one_ray) {
      decide(pairs);
      mark_blocked(pairs, tmax, blocked);
      pairs.count = 0;
    }
    blocked[i] = gather_occluded(node, clusters, rays[i], static_cast<std::uint32_t>(i), tmax[i], pairs);
  }
  decide(pairs);
  mark_blocked(pairs, tmax, blocked);
}
