// SPDX-License-Identifier: Apache-2.0
#include "tracer/transport/waves/wave.h"

#include "tracer/rays/walk.h"
#include "tracer/transport/sensors.h"
#include "tracer/transport/shading.h"

namespace vitrail {

void Wave::add(const Tracing& tracing, int x, int y, std::uint32_t sample) {
  new_.push_back(static_cast<std::uint32_t>(next_));
  set_sample(tracing, place(), x, y, sample);
}

void Wave::trace(Tracing& tracing) {
  const bool in_lanes = LaneLists::apply_to(tracing);
  std::optional<PixelSums> sums;
  if (PixelSums::is_plain(tracing.film)) tracing.sums = &sums.emplace(tracing.film);
  generate(tracing, in_lanes);
  vitrail::trace(tracing, shadows_);
  while (!live_.empty()) {
    find_hits(tracing);
    shade_all(tracing, in_lanes);
    vitrail::trace(tracing, shadows_);
  }
  tracing.sums = nullptr;
  next_ = 0;
}

Given Wave::begin_in_lanes(const Tracing& tracing) {
  const auto radius = tracing.scene.filter.even_radius();
  const NewPaths of{.tracing = tracing,
                    .paths = paths_.get(),
                    .places = new_.data(),
                    .count = new_.size(),
                    .rays = tracing.scene.camera.linear(),
                    .width = static_cast<double>(tracing.film.full_width()),
                    .is_even = radius.has_value(),
                    .radius = radius.value_or(Point2d{})};
  tracing.stages->begin(of);
  return of.rays ? Given::ray : Given::numbers;
}

void Wave::generate(Tracing& tracing, bool in_lanes) {
  const bool has_numbers = in_lanes && tracing.film.bins().count == 0;
  const Given given = has_numbers ? begin_in_lanes(tracing) : Given::nothing;
  for (const std::uint32_t i : new_) {
    CameraPath& path = paths_[i];
    if (!begin(tracing, path, given)) continue;
    if (tracing.traffic) tracing.traffic->begin({});
    ++tracing.counters.born;
    at_[i].reset();
    Begun begun = Begun::goes_on;
    if (const auto sensor = tracing.scene.camera.sensor(column_of(tracing, path.film)))
      begun = begin_at(tracing, path, *sensor, shadows_);
    if (begun == Begun::goes_on) live_.push_back(i);
    if (begun == Begun::ends) ++tracing.counters.died;
  }
  new_.clear();
}

void Wave::find_hits(Tracing& tracing) {
  if (DomainWalk::has_one(tracing.manifest(), tracing.resident) && !tracing.traffic)
    return find_in_one(tracing);
  std::size_t kept = 0;
  for (const std::uint32_t i : live_) {
    CameraPath& path = paths_[i];
    const auto elsewhere = find_hit(tracing, path, at_[i]);
    at_[i].reset();
    if (elsewhere)
      send(tracing, path, *elsewhere);
    else
      live_[kept++] = i;
  }
  live_.resize(kept);
}

// The scene's only domain is resident: nothing goes on elsewhere.
void Wave::find_in_one(Tracing& tracing) {
  HitsInOne hits(tracing);
  for (const std::uint32_t i : live_) {
    if (!at_[i]) {
      hits.add(paths_[i]);
      continue;
    }
    find_hit(tracing, paths_[i], at_[i]);
    at_[i].reset();
  }
  hits.finish();
}

void Wave::shade_all(Tracing& tracing, bool in_lanes) {
  std::size_t kept = 0, alone = 0;
  const bool has_media = tracing.requirements().media;
  std::optional<Arrived> arrived{Arrived{}};
  for (const std::uint32_t i : live_) {
    if (has_media) arrived = fly(tracing, paths_[i]);
    if (arrived && in_lanes && lists_.take(tracing, paths_[i], i, *arrived)) continue;
    ++alone;
    if (arrived && shade(tracing, paths_[i], *arrived, shadows_)) live_[kept++] = i;
  }
  tracing.counters.died += alone - kept;
  tracing.counters.rays_indirect += kept;
  live_.resize(kept);
  if (in_lanes) lists_.run(tracing, paths_.get(), shadows_, live_);
}

}  // namespace vitrail
