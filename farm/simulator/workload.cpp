// SPDX-License-Identifier: Apache-2.0
#include "farm/simulator/workload.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

// Items of the farm: a tile's pixels with 16 samples.
constexpr std::uint32_t rays_of_an_item = 4096;

}  // namespace

Workload workload_of(const Manifest& manifest, const RayProfile& profile, double pictures,
                     double most_items) {
  profile.require_of(manifest);
  if (profile.cost.camera_rays == 0) throw Error("the profile has no rays");
  Workload w;
  w.domains.resize(manifest.domains.size());
  w.manifest.domains.resize(manifest.domains.size());
  w.manifest.objects.resize(manifest.objects.size());
  std::uint64_t visits = 0;
  double all_s = profile.cost.camera_s;
  for (const RayProfile::Domain& d : profile.domains) {
    visits += d.rays;
    all_s += d.seconds;
  }
  if (all_s > 0) w.at_hand = profile.cost.trace_s / all_s;
  const double mean = all_s / static_cast<double>(std::max<std::uint64_t>(visits, 1));
  w.camera.seconds = profile.cost.camera_s / static_cast<double>(profile.cost.camera_rays);
  for (std::size_t i = 0; i < manifest.domains.size(); ++i) {
    w.manifest.domains[i].bytes = manifest.domains[i].bytes;
    w.manifest.domains[i].objects = manifest.domains[i].objects;
    w.manifest.domains[i].pack = manifest.domains[i].pack;
    // Where few rays were, none may have been timed.
    const RayProfile::Domain& seen = profile.domains[i];
    w.domains[i].seconds = seen.seconds > 0 ? seen.seconds / static_cast<double>(seen.rays) : mean;
  }
  for (std::size_t i = 0; i < manifest.objects.size(); ++i) {
    w.manifest.objects[i].bytes = manifest.objects[i].bytes;
    w.manifest.objects[i].quadric = manifest.objects[i].quadric;
  }
  for (const RayProfile::Way& way : profile.ways) {
    const bool enters = way.from == RayProfile::Way::camera;
    const std::uint64_t of = enters ? profile.cost.camera_rays : profile.domains[way.from].rays;
    if (of == 0) throw Error("the profile has ways from where no ray was");
    (enters ? w.camera : w.domains[way.from])
        .ways.push_back({way.to, static_cast<double>(way.rays) / static_cast<double>(of)});
  }
  const double rays = static_cast<double>(profile.cost.camera_rays) * pictures;
  w.rays_an_item = static_cast<std::uint32_t>(
      std::min(std::max(rays, 1.0), std::max(double{rays_of_an_item}, std::ceil(rays / most_items))));
  w.items = static_cast<std::uint64_t>(std::max(1.0, std::round(rays / w.rays_an_item)));
  return w;
}

Workload random_workload(std::mt19937_64& random, std::uint32_t domains, std::uint64_t items,
                         std::uint32_t rays_an_item) {
  Workload w;
  w.items = items;
  w.rays_an_item = rays_an_item;
  w.manifest.domains.resize(domains);
  w.manifest.objects.resize(random() % 5);
  for (ObjectInfo& o : w.manifest.objects) o.bytes = 1 + random() % 100'000;
  w.domains.resize(domains);
  for (std::uint32_t d = 0; d < domains; ++d) {
    w.manifest.domains[d].bytes = 100'000 + random() % 1'000'000;
    for (std::uint32_t o = 0; o < w.manifest.objects.size(); ++o)
      if (random() % 3 == 0) w.manifest.domains[d].objects.push_back(o);
    w.domains[d].seconds = (1 + 9 * uniform(random)) * 1e-6;
    std::set<std::uint32_t> near{(d + 1) % domains, (d + domains - 1) % domains};
    near.insert(static_cast<std::uint32_t>(random() % domains));
    const double rays = .5 + .4 * uniform(random);
    for (const std::uint32_t to : near)
      w.domains[d].ways.push_back({to, rays / static_cast<double>(near.size())});
  }
  const auto seen = static_cast<std::uint32_t>(1 + random() % domains);
  for (std::uint32_t d = 0; d < seen; ++d) w.camera.ways.push_back({d, 1.0 / seen});
  return w;
}

}  // namespace vitrail
