// SPDX-License-Identifier: Apache-2.0
#include "farm/plan/job_manifest.h"

#include <fmt/format.h>

#include <algorithm>

#include "bundle/checksum.h"
#include "bundle/manifest_json.h"
#include "farm/plan/film_size.h"
#include "farm/plan/rounds.h"
#include "film/picture_fields.h"
#include "scene/daylight/photometry.h"
#include "scene/models/sensor_file.h"
#include "scene/records/film_extent.h"
#include "scene/records/light_traits.h"
#include "scene/spectra/color.h"
#include "tracer/photons/progressive.h"
#include "tracer/rays/ray_records.h"

namespace vitrail {

namespace {

void override_layers(Manifest& m, const PictureSettings& picture, const std::filesystem::path& bundle) {
  const FilmLayers kept = m.film.layers;
  if (picture.layers) m.film.layers.bits = *picture.layers;
  m.film.layers.bits |= picture.more_layers;
  if (picture.layers_in_camera_space) m.film.layers.in_camera_space = *picture.layers_in_camera_space;
  const auto require = [&](Layer layer, bool there, const char* what) {
    if (m.film.layers.has(layer) && !there)
      throw Error(fmt::format("the bundle keeps no {0}: partition the scene with --aov {1}", what,
                              kind_of(layer).name),
                  {bundle.string()});
  };
  if (m.film.layers.has(Layer::motion) && !std::holds_alternative<PerspectiveCamera>(m.camera) &&
      !std::holds_alternative<OrthographicCamera>(m.camera))
    throw UsageError(
        "--aov motion is for perspective and orthographic cameras, and the scene has another one");
  require(Layer::uv, m.requirements.uv, "(u,v), as nothing in the scene needs them");
  for (const Layer layer : {Layer::shape, Layer::crypto_object})
    require(layer, tells_shapes(kept), "account of which shape is which");
}

Point3d place_of(const Camera& camera) {
  return std::visit([](const auto& c) { return transform_point(c.camera_to_world, {0, 0, 0}); }, camera);
}

// In the place of the camera, whose own is returned. They belong to what the film is of.
Point3d put_sensors(Manifest& m, const PictureSettings& picture) {
  if (picture.width || picture.height || picture.scale != 1 || picture.crop || picture.bins ||
      picture.layers || picture.more_layers || picture.samples.filter || picture.hides_emitters ||
      picture.light_groups.any())
    throw UsageError(
        "--sensors measures and makes no picture: leave out options of size, crop, filter, spectrum, "
        "channels and lights");
  if (picture.clamp > 0)
    throw UsageError("--clamp is for pictures: it would remove light from the measurements of --sensors");
  SensorCamera camera{translate(-m.offset), read_sensors(picture.sensors)};
  const Point3d replaced = place_of(m.camera);
  m.film = sensor_film(camera.sensors.size());
  m.camera = std::move(camera);
  m.camera_motion = {};
  ++m.settings.max_depth;  // the sensor's own event
  Hasher hasher;
  hasher.add(std::as_bytes(std::span(&m.scene_hash, 1)));
  const std::string text = camera_to_json(m.camera).dump();
  hasher.add(std::as_bytes(std::span(text)));
  m.scene_hash = hasher.digest();
  return replaced;
}

TabulatedSpectrum one_lux_of_d65() {
  TabulatedSpectrum d65;
  const auto unit = static_cast<float>(1 / photometric(1));  // its luminance is 1
  for (const float value : cie_d65()) d65.values.push_back(unit * value);
  return d65;
}

// In place of the scene's lights: 1 cd/m² from all around, or a sun of 1 lx, of D65. Lamps are for others to
// turn off.
void put_daylight(Manifest& m, const DaylightRows& rows) {
  if (!std::holds_alternative<SensorCamera>(m.camera) || rows.count() > max_film_extent)
    throw UsageError("daylight coefficients are of sensors, and of as many suns as a film may have rows");
  if (m.settings.rgb == RgbMethod::bands)
    throw UsageError(
        "this bundle's colours are three numbers, and daylight is a spectrum: partition the scene again with "
        "--rgb jakob-hanika");
  std::erase_if(m.lights, [](const Light& light) { return traits_of(light.model).is_far(); });
  if (rows.patches)
    m.lights.push_back({InfiniteLight{one_lux_of_d65()}, {}});
  else
    m.lights.push_back({DistantLight{{0, 0, -1}, one_lux_of_d65()}, {}});
  m.film.height = m.film.crop.y1 = static_cast<int>(rows.count());
  m.film.spectrum.count = 0;
  Hasher hasher;
  hasher.add(std::as_bytes(std::span(&m.scene_hash, 1)));
  const DirectionFrame& sky = rows.sky;
  constexpr double has_melanopic = 1;  // films are no longer what they were without (daylight_rows.h)
  std::vector<Vector3d> told{
      sky.x,
      sky.y,
      sky.z,
      {rows.patches ? rows.patches->mf() + 0.0 : 0, rows.reflected_alone ? 1.0 : 0, has_melanopic}};
  told.insert(told.end(), rows.suns.begin(), rows.suns.end());
  hasher.add(std::as_bytes(std::span(told)));
  m.scene_hash = hasher.digest();
}

void check_error_is_known(const PictureSettings& picture) {
  if (picture.samples.sampling.one_sequence && (picture.adaptive || picture.target_error))
    throw UsageError(
        "--one-sequence keeps no estimate of the error, and --adaptive, --target-error and --quality need "
        "one: give --spp instead");
}

void check_splat(const Manifest& m, const PictureSettings& picture) {
  if (!picture.samples.sampling.splat) return;
  if (picture.adaptive || picture.target_error)
    throw UsageError(
        "--splat makes the errors of neighbouring pixels alike, and --adaptive, --target-error and --quality "
        "need independent ones: give --spp instead");
  if (std::holds_alternative<SensorCamera>(m.camera))
    throw UsageError("--splat is for pictures: sensors are no neighbours of each other");
  const auto [x, y] =
      std::visit([](const auto& f) { return std::pair(f.radius_x, f.radius_y); }, m.film.filter);
  if (std::max(x, y) > greatest_splat_radius)
    throw UsageError(fmt::format("--splat takes filters of up to {} pixels in radius, this one has {}",
                                 greatest_splat_radius, std::max(x, y)));
}

void choose_integrator(const PictureSettings& picture, RenderSettings& s) {
  if (picture.integrator) {
    s.direct_only = picture.integrator == Integrator::direct;
    if (picture.integrator != Integrator::photon)
      s.photons.reset();
    else if (!s.photons)
      s.photons.emplace();
  }
  const PhotonSettings& given = picture.photons;
  if (!s.photons) {
    if (given != PhotonSettings{})
      throw UsageError("--photons, --photon-radius and --photon-alpha need --integrator photon");
    return;
  }
  if (given.photons) s.photons->photons = given.photons;
  if (given.first_radius) s.photons->first_radius = given.first_radius;
  if (given.alpha) s.photons->alpha = given.alpha;
}

void override_settings(Manifest& m, const RenderOptions& options) {
  const PictureSettings& picture = options.picture;
  RenderSettings& s = m.settings;
  check_error_is_known(picture);
  choose_integrator(picture, s);
  s.samples_per_pixel = static_cast<int>(goal_of(options, s).samples);
  if (picture.max_depth) s.max_depth = *picture.max_depth;
  if (picture.hides_emitters) s.hides_emitters = *picture.hides_emitters;
  if (picture.threshold > 0 && !s.direct_only) throw UsageError("--threshold needs --integrator direct");
  if (s.samples_per_pixel < 1 || static_cast<std::uint32_t>(s.samples_per_pixel) >= max_samples)
    throw UsageError(fmt::format("samples a pixel must be between 1 and {}", max_samples - 1));
  if (picture.target_error && s.samples_per_pixel < 4)
    throw UsageError("an error is estimated from 4 samples a pixel or more: give --spp more than that");
  if (s.max_depth < 0) throw UsageError("the depth must not be negative");
}

void override_film(Manifest& m, const PictureSettings& picture, const std::filesystem::path& bundle) {
  resize_film(m, picture);
  if (picture.crop) m.film.crop = *picture.crop;
  if (picture.bins) m.film.spectrum = *picture.bins;
  if (m.film.spectrum.count > 0 && m.settings.rgb == RgbMethod::bands)
    throw UsageError(
        "--spectral: this bundle's colours are three numbers: partition the scene again with --rgb "
        "jakob-hanika");
  override_layers(m, picture, bundle);
  apply(picture.samples, m);
  check_splat(m, picture);
  const PixelRect& c = m.film.crop;
  if (c.x0 < 0 || c.y0 < 0 || c.x1 > m.film.width || c.y1 > m.film.height || c.x0 >= c.x1 || c.y0 >= c.y1)
    throw UsageError("the crop lies outside the film or is empty");
}

}  // namespace

JobManifest read_job_manifest(const RenderOptions& options) {
  return job_manifest(options, read_manifest(options.bundle));
}

JobManifest job_manifest(const RenderOptions& options, Manifest manifest) {
  JobManifest read{std::move(manifest), std::nullopt};
  Manifest& m = read.manifest;
  if (m.domains.size() > max_domains) throw Error("more than 65535 domains", {options.bundle.string()});
  set_sheets(options.picture.sheets, options.bundle, m);
  edit_scene(options.picture.edits, m);
  edit_view(options.picture.view, m);
  override_settings(m, options);
  if (!options.picture.sensors.empty()) read.replaced_camera = put_sensors(m, options.picture);
  if (options.picture.daylight) put_daylight(m, *options.picture.daylight);
  static_assert(no_limit_of_depth == max_path_depth);
  m.settings.max_depth = std::min(m.settings.max_depth, max_path_depth);
  override_film(m, options.picture, options.bundle);
  return read;
}

namespace {

// As the manifest's settings ask; photons = 0 where there is no photon mapping. Throws UsageError for what it
// does not cover.
PhotonKey photons_of(const PictureSettings& picture, const Manifest& m) {
  if (!m.settings.photons) return {};
  const PhotonSettings& o = *m.settings.photons;
  if (picture.adaptive || picture.target_error)
    throw UsageError(
        "photon mapping (by --integrator photon or by the scene) has no --adaptive and no --target-error: "
        "give --spp or --time, or --integrator path");
  if (m.requirements.media)
    throw UsageError(
        "--integrator photon does not render media, and the scene has some: use --integrator path");
  PhotonKey key;
  key.photons = o.photons.value_or(default_photons(m.film));
  // Each row of sensors has as many (PhotonPass::Part).
  if (std::holds_alternative<SensorCamera>(m.camera))
    key.photons = (key.photons + sensor_rows - 1) / sensor_rows * sensor_rows;
  key.first_radius = o.first_radius.value_or(default_radius(m, key.photons));
  key.alpha = o.alpha.value_or(2.0 / 3);
  return key;
}

}  // namespace

FilmKey key_of(const Manifest& m, const PictureSettings& picture) {
  FilmKey key;
  key.scene_hash = m.scene_hash;
  key.seed = picture.seed;
  key.max_depth = m.settings.max_depth;
  key.direct_only = m.settings.direct_only;
  if (key.direct_only) key.threshold = rounded_threshold(picture.threshold);
  key.straight_counts = m.settings.straight_counts;
  key.clamp = picture.clamp;
  key.splats = picture.samples.sampling.splat;
  key.one_sequence = picture.samples.sampling.one_sequence;
  key.photons = photons_of(picture, m);
  key.hides_emitters = m.settings.hides_emitters;
  key.groups = group_lights(picture.light_groups, m).groups;
  if (key.groups.any() && key.photons.photons > 0)
    throw UsageError("photons do not record their lamp, and --light-groups needs it: use --integrator path");
  return key;
}

}  // namespace vitrail
