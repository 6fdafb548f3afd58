// SPDX-License-Identifier: Apache-2.0
// A Workload says how the rays of a picture behave, as the simulator sees them: numbers of rays that move
// between domains.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "bundle/ray_profile.h"

namespace vitrail {

struct Workload {
  struct Way {
    std::uint32_t domain = 0;
    double rays = 0;  // that leave for it, a ray that is traced
  };
  struct Domain {
    double seconds = 0;  // of a worker, a ray
    std::vector<Way> ways;
  };
  Manifest manifest;            // bytes of domains and objects alone
  std::vector<Domain> domains;  // a ray bears fewer than one in the mean, or no picture ends
  Domain camera;                // of one of its rays, what is before the first domain
  double at_hand = 1;           // times these seconds, where a task meets no domain that is absent
  std::uint64_t items = 0;      // of the job
  std::uint32_t rays_an_item = 0;
  double middle_again = 0;  // the middle third of the items so many times more, which is reckoned
};

// Returns a workload as a profile saw it in a bundle, for `pictures` times its samples. For many, items are
// larger than the farm's, so that there are at most `most_items`. Throws Error for a profile of another
// bundle.
Workload workload_of(const Manifest& manifest, const RayProfile& profile, double pictures, double most_items);

// Returns domains in a row, each of whose rays end, stay near or go anywhere; the domains have unlike sizes,
// some with objects in common.
Workload random_workload(std::mt19937_64& random, std::uint32_t domains, std::uint64_t items,
                         std::uint32_t rays_an_item);

}  // namespace vitrail
