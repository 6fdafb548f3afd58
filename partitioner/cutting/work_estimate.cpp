// SPDX-License-Identifier: Apache-2.0
#include "partitioner/cutting/work_estimate.h"

#include <algorithm>

namespace vitrail {

namespace {

constexpr double most_work = 8;

double ratio(double a, double b) { return b > 0 ? a / b : 0; }

}  // namespace

WorkEstimate::WorkEstimate(RayProfile profile, Vector3d offset)
    : profile_(std::move(profile)), offset_(offset) {
  double rays = 0, items = 0, all_work = 0;
  for (const RayProfile::Domain& d : profile_->domains) {
    rays += static_cast<double>(d.rays);
    items += static_cast<double>(d.items);
  }
  std::vector<double> work;
  for (const RayProfile::Domain& d : profile_->domains) {
    const double rays_an_item = ratio(static_cast<double>(d.rays), static_cast<double>(d.items));
    work.push_back(std::min(0.5 + 0.5 * ratio(rays_an_item, ratio(rays, items)), most_work));
    all_work += work.back() * static_cast<double>(d.items);
  }
  for (const double w : work) work_.push_back(static_cast<float>(items > 0 ? w * items / all_work : 1));
}

std::vector<Item> WorkEstimate::items(const std::vector<Bounds3f>& boxes) const {
  std::vector<Item> result;
  result.reserve(boxes.size());
  for (const Bounds3f& b : boxes) {
    Item& item = result.emplace_back(Item{b});
    if (!profile_) continue;
    const Bounds3d box{cast<double>(b.lower), cast<double>(b.upper)};
    item.work = work_[profile_->domain_at(center(box) + offset_)];
  }
  return result;
}

}  // namespace vitrail
