// SPDX-License-Identifier: Apache-2.0
#include "farm/run/photon_work.h"

#include "scene/models/sensor_file.h"

namespace vitrail {

namespace {

std::vector<Sensor> sensors_of(const RenderScene& scene) {
  std::vector<Sensor> sensors;
  if (std::holds_alternative<SensorCamera>(scene.manifest.camera))
    for (int x = 0; x < scene.manifest.film.width; ++x) sensors.push_back(*scene.camera.sensor(x));
  return sensors;
}

// Where the light is to go that is seen.
Point3d eye_of(const Manifest& m, const SensorDiscs& discs) {
  if (std::holds_alternative<SensorCamera>(m.camera)) return discs.middle();
  const Transform& t =
      std::visit([](const auto& camera) -> const Transform& { return camera.camera_to_world; }, m.camera);
  return {t.m[0][3], t.m[1][3], t.m[2][3]};
}

}  // namespace

PhotonWork::PhotonWork(const RenderScene& scene, const PhotonKey& key, std::size_t most_landed,
                       std::uint64_t most_question_bytes, Homes homes, int rank, int ranks)
    : questions(most_question_bytes),
      scene_(scene),
      key_(key),
      discs_(sensors_of(scene)),
      emission_(scene.lights, scene.manifest.bounds, eye_of(scene.manifest, discs_)),
      map_(most_landed),
      homes_(std::move(homes)),
      rank_(rank),
      ranks_(ranks) {
  if (ranks > 1)
    for (std::uint32_t d = 0; d < homes_.domains(); ++d) answers_.push_back(homes_.first(d) == rank);
  pass_.photons = emission_.flux() > 0 ? key.photons : 0;
  pass_.power_w_nm = pass_.photons > 0 ? emission_.flux() / static_cast<double>(pass_.photons) : 0;
  pass_.emission = &emission_;
  pass_.map = &map_;
  pass_.answers = &answers_;
  if (std::holds_alternative<SensorCamera>(scene.manifest.camera)) {
    pass_.sensors = &discs_;
    pass_.parts.resize(sensor_rows);
  }
}

std::vector<std::uint64_t> PhotonWork::chunks_of_this_rank() const {
  std::vector<std::uint64_t> share;
  for (auto i = static_cast<std::uint64_t>(rank_); i < chunks(); i += static_cast<std::uint64_t>(ranks_))
    share.push_back(i);
  return share;
}

std::uint64_t PhotonWork::photons_in(std::uint64_t chunk) const {
  return std::min(chunk_photons, pass_.photons - chunk * chunk_photons);
}

void PhotonWork::begin_flying(std::uint32_t iteration) {
  pass_.flying = true;
  pass_.iteration = iteration;
  pass_.radius = radius_of(key_, iteration);
  map_.begin(pass_.radius, scene_.manifest.bounds);
  for (std::uint32_t part = 0; part < pass_.parts.size(); ++part) {
    const float number = wavelength_number(scene_.seed, iteration, part);
    pass_.parts[part] = {number, time_number(scene_.seed, iteration, part), sample_wavelengths(number)};
  }
  // Where a point is rounded to float decides nothing.
  reach_ = pass_.radius * (1 + 1e-6);
}

void PhotonWork::begin_gathering() {
  map_.build();
  most_kept = std::max(most_kept, map_.in_memory());
  pass_.flying = false;
}

}  // namespace vitrail
