// SPDX-License-Identifier: Apache-2.0
#include "farm/simulator/workload.h"

#include <algorithm>
#include <set>

namespace vitrail {

namespace {

double uniform(std::mt19937_64& random) { return static_cast<double>(random() >> 11) * 0x1p-53; }

}  // namespace

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
  for (std::uint32_t d = 0; d < seen; ++d) w.entry.push_back({d, 1.0 / seen});
  return w;
}

}  // namespace vitrail
