// SPDX-License-Identifier: Apache-2.0
// Which ranks answer for a domain: rays for it wait at one of them.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "bundle/ray_profile.h"

namespace vitrail {

class Homes {
 public:
  // One each: `home[d]` is domain d's.
  Homes(const std::vector<int>& home, int ranks) : Homes(home, home, ranks) {}
  // Those of domain d are ranks [first[d], last[d]].
  Homes(std::vector<int> first, std::vector<int> last, int ranks)
      : first_(std::move(first)), last_(std::move(last)), ranks_(ranks) {}

  int first(std::uint32_t domain) const { return first_[domain]; }
  int last(std::uint32_t domain) const { return last_[domain]; }
  bool has(std::uint32_t domain, int rank) const { return first_[domain] <= rank && rank <= last_[domain]; }
  std::size_t domains() const { return first_.size(); }
  int ranks() const { return ranks_; }
  std::uint64_t places() const;  // homes of all domains together

 private:
  std::vector<int> first_, last_;  // by domain
  int ranks_;
};

// Contiguous runs of domains in kd order, of about equal bytes: neighbours share a rank and rays stay home
// longer.
Homes homes_by_bytes(const Manifest& manifest, int ranks);

// The same of about equal work, as `profile` saw it. A domain with more than a rank's share has as many homes
// as shares, and where the border of two shares lies within a domain or near to it, both ranks are its homes.
// Throws Error for a profile of another bundle.
Homes homes_by_work(const Manifest& manifest, const RayProfile& profile, int ranks);

}  // namespace vitrail
