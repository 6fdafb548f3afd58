// SPDX-License-Identifier: Apache-2.0
#include "tests/laws/exact/soup_laws.h"

#include <fmt/format.h>

#include <cstdio>

#include "partitioner/partition.h"
#include "tests/laws/exact/exact_view.h"
#include "tests/laws/exact/soup_bundle.h"
#include "tests/laws/exact/soup_rays.h"
#include "tests/support/temporary_directory.h"
#include "tracer/intersect/embree_domain.h"
#include "tracer/rays/walk.h"

namespace vitrail::test {

void Findings::differ(const std::string& kind, std::uint64_t seed) {
  Kind& k = differences[kind];
  ++k.count;
  if (k.seeds.size() < 8 && (k.seeds.empty() || k.seeds.back() != seed)) k.seeds.push_back(seed);
}

void Findings::add(const Findings& other) {
  static constexpr std::uint64_t Findings::*sums[] = {
      &Findings::soups,           &Findings::by_files,    &Findings::triangles,
      &Findings::cut_triangles,   &Findings::pieces,      &Findings::domains,
      &Findings::instances,       &Findings::rays,        &Findings::hits,
      &Findings::visits,          &Findings::embree_rays, &Findings::oracle_rays,
      &Findings::oracle_triangles};
  for (const auto sum : sums) this->*sum += other.*sum;
  for (const auto& [what, kind] : other.differences) {
    Kind& k = differences[what];
    k.count += kind.count;
    for (const std::uint64_t seed : kind.seeds)
      if (k.seeds.size() < 8) k.seeds.push_back(seed);
  }
}

std::string Findings::table() const {
  std::string text;
  const auto line = [&](const char* name, std::uint64_t value) {
    text += fmt::format("{:<20}{:>14}\n", name, value);
  };
  line("soups", soups);
  line("by way of files", by_files);
  line("triangles", triangles);
  line("cut triangles", cut_triangles);
  line("pieces", pieces);
  line("domains", domains);
  line("instances in them", instances);
  line("rays", rays);
  line("hits", hits);
  line("visits of domains", visits);
  line("rays of Embree's", embree_rays);
  line("rays of the oracle", oracle_rays);
  line("its triangles", oracle_triangles);
  for (const auto& [what, kind] : differences)
    text += fmt::format("{}: {} times, as in soups {}\n", what, kind.count, fmt::join(kind.seeds, " "));
  if (differences.empty()) text += "no differences\n";
  return text;
}

namespace {

// Domains, wherever they are.
struct Cut {
  const Manifest& manifest;
  std::span<const DomainView> views;
};

std::vector<Cluster> clusters_of(const Triangles& triangles) {
  std::vector<Cluster> clusters((triangles.size() + cluster_width - 1) / cluster_width);
  for (std::uint32_t i = 0; i < clusters.size() * cluster_width; ++i) {
    Cluster& c = clusters[i / cluster_width];
    const std::size_t lane = i % cluster_width;
    const bool filled = i < triangles.size();
    c.id[lane] = filled ? i : no_triangle;
    for (std::size_t k = 0; k < 3; ++k)
      for (int axis = 0; axis < 3; ++axis) c.vertex[k][axis][lane] = filled ? triangles[i][k][axis] : NAN;
  }
  return clusters;
}

// As a rank that has all domains.
Hit closest(const Cut& cut, const KernelFunctions& kernel, const Ray& ray, std::uint32_t& holder,
            std::uint64_t& visits) {
  const RayConstants constants = prepare(ray);
  DomainWalk walk(cut.manifest, ray);
  Hit hit;
  for (DomainWalk::Visit visit; walk.next(hit.t, visit); ++visits) {
    const Hit before = hit;
    kernel.closest(cut.views[visit.domain], constants, hit);
    if (!same(hit, before)) holder = visit.domain;
  }
  return hit;
}

// As ranks that have one domain each.
Hit closest_sent_on(const Cut& cut, const KernelFunctions& kernel, const Ray& ray) {
  const RayConstants constants = prepare(ray);
  Hit hit;
  DomainWalk::Visit visit;
  if (!DomainWalk(cut.manifest, ray).next(hit.t, visit)) return hit;
  const CellWays ways(cut.manifest);
  for (;;) {
    kernel.closest(cut.views[visit.domain], constants, hit);
    DomainWalk walk(cut.manifest, ray);
    walk.skip_past(visit.domain, ways);
    if (!walk.next(hit.t, visit)) return hit;
  }
}

bool occluded(const Cut& cut, const KernelFunctions& kernel, const Ray& ray, float tmax) {
  const RayConstants constants = prepare(ray);
  DomainWalk walk(cut.manifest, ray);
  for (DomainWalk::Visit visit; walk.next(double{tmax}, visit);)
    if (kernel.occluded(cut.views[visit.domain], constants, tmax)) return true;
  return false;
}

// Ends of shadow rays on either side of the nearest hit.
float shadow_end(const Hit& nearest, SoupRandom& random) {
  const double factors[] = {1 - 1e-7, 1, 1 + 1e-7, 0.5, 2};
  const auto end = static_cast<float>(nearest.t * factors[random.below(std::size(factors))]);
  return end > 0 ? std::min(end, std::numeric_limits<float>::max()) : 1;
}

class RayJudge {
 public:
  RayJudge(const Soup& soup, const Effort& effort, Findings& findings)
      : soup_(soup), effort_(effort), findings_(findings), random_(soup.seed ^ 0x7a95) {}

  void judge(const Triangles& triangles, const Cut& whole, const Cut& divided) {
    const std::vector<Cluster> clusters = clusters_of(triangles);
    DomainView all;
    all.clusters = clusters;
    std::unique_ptr<const EmbreeDomain> embree;
    if (soup_.seed % 16 == 0) embree = std::make_unique<const EmbreeDomain>(whole.views[0]);
    const std::vector<Kernel> kernels = available_kernels();
    for (const Ray& ray :
         rays_for(triangles, divided.manifest.kd_nodes, soup_.reach, random_, effort_.rays)) {
      ray_ = ray;
      expected_ = brute_force(all, ray);
      tmax_ = shadow_end(expected_, random_);
      shadowed_ = expected_.t < double{tmax_};
      ++findings_.rays;
      findings_.hits += expected_.triangle != no_triangle;
      for (const Kernel kernel : kernels) undivided(whole, kernel);
      const Kernel kernel = kernels[random_.below(kernels.size())];
      in_domains(divided, kernel_functions(kernel), name(kernel));
      if (embree) by_embree(*embree);
      if (random_.below(effort_.oracle_every) == 0) by_oracle(triangles);
    }
  }

 private:
  void differ(const std::string& what, const Hit& hit) {
    findings_.differ(what, soup_.seed);
    if (!effort_.verbose) return;
    const auto& [o, d, exclude] = ray_;
    fmt::print(stderr, "{}: o ({:a}, {:a}, {:a}) d ({:a}, {:a}, {:a}) excluding {}\n", what, o.x, o.y, o.z,
               d.x, d.y, d.z, static_cast<int>(exclude));
    fmt::print(stderr, "  expected t {} of {}; found t {} of {}; tmax {}\n", expected_.t,
               static_cast<int>(expected_.triangle), hit.t, static_cast<int>(hit.triangle), tmax_);
  }
  void expect(const Hit& hit, const std::string& what) {
    if (!same(hit, expected_)) differ(what, hit);
  }
  void expect(bool occluded, const std::string& what) {
    if (occluded != shadowed_) differ(what, {});
  }

  void undivided(const Cut& whole, Kernel kernel) {
    const RayConstants constants = prepare(ray_);
    const KernelFunctions& f = kernel_functions(kernel);
    Hit hit;
    f.closest(whole.views[0], constants, hit);
    expect(hit, fmt::format("hit, undivided, {}", name(kernel)));
    expect(f.occluded(whole.views[0], constants, tmax_), fmt::format("shadow, undivided, {}", name(kernel)));
  }

  void in_domains(const Cut& divided, const KernelFunctions& f, std::string_view kernel) {
    std::uint32_t holder = 0;
    const Hit hit = closest(divided, f, ray_, holder, findings_.visits);
    expect(hit, fmt::format("hit, in domains, {}", kernel));
    expect(occluded(divided, f, ray_, tmax_), fmt::format("shadow, in domains, {}", kernel));
    expect(closest_sent_on(divided, f, ray_), fmt::format("hit, sent on, {}", kernel));
    if (hit.triangle == no_triangle) return;
    Hit again;
    f.closest(divided.views[holder], prepare(ray_), again);
    if (!same(again, hit)) differ("hit, found again where it was found", again);
  }

  void by_embree(const EmbreeDomain& embree) {
    ++findings_.embree_rays;
    Hit hit;
    embree.closest(prepare(ray_), hit);
    expect(hit, "hit, Embree");
    expect(embree.occluded(prepare(ray_), tmax_), "shadow, Embree");
  }

  // docs/why/exact-intersection.md states by how much a hit may deviate.
  void by_oracle(const Triangles& triangles) {
    ++findings_.oracle_rays;
    constexpr double u = 0x1p-53;
    const double zeta = expected_.t * std::abs(prepare(ray_).direction_z);
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
      if (i == ray_.exclude) continue;
      ++findings_.oracle_triangles;
      const ExactView view = exact_view(ray_, triangles[i]);
      const auto greatest = [](const double(&a)[3]) {
        return std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
      };
      const double s = std::max(greatest(view.x), greatest(view.y)), z = greatest(view.z), w = s + z;
      const double depth = *std::ranges::max_element(view.z) - *std::ranges::min_element(view.z);
      const double e = u * (4 * z + 2 * s), m = greatest_coordinate({triangles[i]});
      const double along = 1e-6 * m + 8 * u * z;
      if (i == expected_.triangle) {
        if (distance_aside(view) > 2 * e + 8 * u * s) differ("oracle: hit beside its triangle", expected_);
        if (!(std::abs(view.zeta - zeta) <= along + 4 * u * zeta + 0x1p-21 * m))
          differ("oracle: hit before or behind its triangle", expected_);
      }
      const double least = std::min({std::abs(view.edge[0]), std::abs(view.edge[1]), std::abs(view.edge[2])});
      const bool certain = view.crossed && least > 4 * s * e + 2 * e * e + 3 * u * s * s &&
                           std::abs(view.det) * m > 2 * s * w * (5e-9 * depth + 6e-15 * m);
      if (certain && view.zeta > along && view.zeta < zeta - 2 * along)
        differ("oracle: crossing missed", expected_);
    }
  }

  const Soup& soup_;
  const Effort& effort_;
  Findings& findings_;
  SoupRandom random_;
  Ray ray_;
  Hit expected_;
  float tmax_ = 0;
  bool shadowed_ = false;
};

void count(const Manifest& m, Findings& f) {
  ++f.soups;
  f.triangles += m.triangles;
  f.cut_triangles += m.cut_triangles;
  f.domains += m.domains.size();
  for (const DomainInfo& d : m.domains) {
    f.pieces += d.pieces;
    f.instances += d.instances;
  }
}

void expect_ghost_free(const Soup& soup, const BundleGeometry& geometry, const Effort& effort,
                       Findings& findings) {
  const std::string problems = problems_of_pieces(geometry);
  for (const DomainGeometry& d : geometry.domains)
    for (const Face& f : d.parents())
      for (std::size_t k = 0; k < 3; ++k)
        if (!(f.polygon[k] == cast<double>(soup.triangles[f.triangle][k])))
          findings.differ("second law: another triangle", soup.seed);
  if (problems.empty()) return;
  findings.differ("second law: " + problems.substr(0, problems.find(" (")), soup.seed);
  if (effort.verbose) fmt::print(stderr, "second law: {}\n", problems);
}

void judge_in_memory(const Soup& soup, const Effort& effort, Findings& findings) {
  const SoupBundle whole = cut_in_memory(soup, 1), divided = cut_in_memory(soup, soup.domains);
  count(divided.manifest, findings);
  expect_ghost_free(soup, geometry_of(divided), effort, findings);
  RayJudge(soup, effort, findings)
      .judge(soup.triangles, {whole.manifest, whole.views}, {divided.manifest, divided.views});
}

// By id, in the bundle's coordinates.
Triangles triangles_of(const LoadedBundle& undivided) {
  Triangles triangles(undivided.manifest.triangles);
  for (const Cluster& cluster : undivided.views[0].clusters)
    for (std::size_t lane = 0; lane < cluster_width; ++lane)
      for (std::size_t k = 0; k < 3 && cluster.id[lane] != no_triangle; ++k) {
        const auto& v = cluster.vertex[k];
        triangles[cluster.id[lane]][k] = {v[0][lane], v[1][lane], v[2][lane]};
      }
  return triangles;
}

void judge_by_files(const Soup& soup, const Effort& effort, Findings& findings) {
  const TemporaryDirectory directory;
  // Instances are moved and scaled, and must stay where scenes may reach.
  const bool instances =
      soup.seed / 128 % 2 == 0 && !soup.triangles.empty() && greatest_coordinate(soup.triangles) < 1e9f;
  const Scene scene = instances ? scene_with_instances(soup) : scene_of(soup);
  partition(scene, directory / "whole.vit", {.domains = 1, .threads = 1, .flatten = true});
  const auto at_once = static_cast<std::uint32_t>(soup.seed / 256 % 3);
  partition(scene, directory / "cut.vit",
            {.domains = soup.domains, .domains_at_once = at_once, .threads = 1});
  const LoadedBundle whole(directory / "whole.vit"), divided(directory / "cut.vit");
  count(divided.manifest, findings);
  ++findings.by_files;
  const Triangles triangles = triangles_of(whole);
  if (!instances) {
    Soup moved = soup;
    moved.triangles = triangles;
    expect_ghost_free(moved, load_geometry(directory / "cut.vit"), effort, findings);
  }
  RayJudge(soup, effort, findings)
      .judge(triangles, {whole.manifest, whole.views}, {divided.manifest, divided.views});
}

}  // namespace

void judge(const Soup& soup, const Effort& effort, Findings& findings) {
  if (soup.seed % 128 == 5)
    judge_by_files(soup, effort, findings);
  else
    judge_in_memory(soup, effort, findings);
}

}  // namespace vitrail::test
