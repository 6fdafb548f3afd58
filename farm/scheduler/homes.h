// SPDX-License-Identifier: Apache-2.0
// Homes say which ranks answer for a domain: rays for it wait at one of them.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "bundle/ray_profile.h"

namespace vitrail {

class Homes {
 public:
  // Each domain has one home: `home[d]` is domain d's.
  Homes(const std::vector<int>& home, int ranks) : Homes(home, home, ranks) {}
  // The homes of domain d are ranks [first[d], last[d]], the last included.
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

// Returns contiguous runs of domains in kd order, of about equal bytes: neighbours share a rank and rays stay
// home longer.
Homes homes_by_bytes(const Manifest& manifest, int ranks);

// Returns the same with about equal work, as `profile` saw it. A domain with more than a rank's share has as
// many homes as shares. Where the border of two shares lies within a domain or near to it, both ranks are its
// homes. `bytes_share` says how much of a domain's weight are its bytes, in [0, 1]. Throws Error for a
// profile of another bundle.
Homes homes_by_work(const Manifest& manifest, const RayProfile& profile, int ranks, double bytes_share = .02);

// Returns the same with no more of the bytes than needed, so that the domains and copies of each rank fit
// into `bytes_a_rank`. It returns nothing where they do not, or where the busiest rank would have nearly as
// much work as with `now`. Where `now` does not fit either, nothing has to.
std::optional<Homes> better_homes(const Manifest& manifest, const RayProfile& profile, const Homes& now,
                                  std::uint64_t bytes_a_rank);

// Returns the bytes of the domains and copies of the rank that has most. Objects count in each domain that
// needs them.
std::uint64_t most_bytes_at_home(const Manifest& manifest, const Homes& homes);

// Returns the number of domains whose homes differ.
std::size_t domains_moved(const Homes& from, const Homes& to);

// Returns the work of the busiest rank over the mean, where the homes of each domain share its work as evenly
// as they can; 1 where the profile saw none.
double busiest_over_mean(const Homes& homes, const RayProfile& profile);

}  // namespace vitrail
