// SPDX-License-Identifier: Apache-2.0
#include "tracer/transport/first_surface.h"

#include "tracer/sampling/wavelengths.h"
#include "tracer/surfaces/albedo.h"
#include "tracer/surfaces/moved_point.h"
#include "tracer/transport/generate.h"

namespace vitrail {

namespace {

// Apart from the streams of the ray's own events.
constexpr std::uint64_t albedo_stream = 0x9e3779b97f4a7c15u;

// The light that surfaces are seen by in an albedo: white in the colours of a picture.
const Spectrum& white_light(const RenderSettings& settings) {
  static const Spectrum d65 = TabulatedSpectrum{{cie_d65().begin(), cie_d65().end()}},
                        ones = ConstantSpectrum{1};
  return settings.rgb == RgbMethod::bands ? ones : d65;
}

std::array<double, 3> values_of(Vector3d v) { return {v.x, v.y, v.z}; }

// Of the layers that are looked up; the others have none.
std::array<double, 3> value_at(const Tracing& tracing, const CameraPath& path, const Interaction& at,
                               const Material& material, Layer layer) {
  const bool in_camera_space = tracing.film.layers().in_camera_space;
  const auto facing = [&](Vector3d normal) {
    const Vector3d n = normal * at.side();
    if (!in_camera_space) return values_of(n);
    return values_of(normalize(to_vector(transform_normal(bundle_to_camera(tracing, path), to_normal(n)))));
  };
  switch (layer) {
    case Layer::position: {
      const Point3d p = in_camera_space ? transform_point(bundle_to_camera(tracing, path), at.p)
                                        : at.p + tracing.manifest().offset;
      return {p.x, p.y, p.z};
    }
    case Layer::geometric_normal:
      return facing(at.geometric);
    case Layer::shading_normal:
      return facing(tracing.scene.materials.shading_normal(material, at));
    case Layer::uv:
      return {at.uv.x, at.uv.y};
    case Layer::depth: {
      const CameraRay ray =
          camera_ray(tracing, path, column_of(tracing, path.film), row_of(tracing, path.film));
      return {ray.before + length(at.p - cast<double>(ray.origin))};
    }
    default:
      return {};
  }
}

// Of the point that is seen, from where it is when the shutter opens to where it is when that closes: to the
// right and up, in pixels. 0 where it is behind the camera then.
std::array<double, 2> motion_at(const Tracing& tracing, const CameraPath& path, Point3d p) {
  if (!tracing.requirements().motion) return {};
  const Shutter& shutter = tracing.manifest().shutter;
  const auto seen_at = [&](double time_s) {
    const DomainView& domain = *tracing.resident[path.hit_domain];
    return tracing.scene.camera.raster(moved_point(domain, path.hit, p, path.time_s, time_s), time_s);
  };
  const auto from = seen_at(shutter.open_s), to = seen_at(shutter.close_s);
  if (!from || !to) return {};
  return {to->x - from->x, from->y - to->y};
}

// As XYZ, under white light, weighted as the picture is.
XYZ albedo_at(const Tracing& tracing, const CameraPath& path, const Interaction& at,
              const Material& material) {
  if (!tracing.scene.materials.scatters(material, at)) return {};
  const Scattering scattering = tracing.scene.materials.scattering_at(
      material, at, path.wavelengths, filled(1), stream_of(path, RayRandom::layers));
  const SampledSpectrum share =
      albedo(scattering.bsdf, scattering.frame.to_local(at.out), path.random + albedo_stream);
  return sense(path.film.sensor, share * evaluate(white_light(tracing.settings()), path.wavelengths));
}

// Something covers so much of the sample's part of the pixel, of whatever kind.
void record_coverage(Tracing& tracing, const CameraPath& path, const Footprint* spread, double share = 1) {
  if (!tracing.film.layers().has(Layer::alpha)) return;
  const double weight = share * tracing.scene.filter.weight(path.film.camera[0], path.film.camera[1]);
  tracing.film.deposit_layer(path.film.pixel, path.film.sample, Layer::alpha, std::array{weight}, spread);
}

}  // namespace

void record_first_medium(Tracing& tracing, CameraPath& path) {
  path.unrecorded = false;
  record_coverage(tracing, path, footprint_of(tracing, path.film.pixel, path.film.sample));
}

void record_leaving(Tracing& tracing, const CameraPath& path) {
  if (path.has_scattered() || !tracing.film.layers().has(Layer::alpha)) return;
  const double begun =
      camera_ray(tracing, path, column_of(tracing, path.film), row_of(tracing, path.film)).weight;
  double left = 0;
  for (const float t : path.throughput.v) left += static_cast<double>(t) / (hero_count * begun);
  const double covered = (path.unrecorded ? 1 : 0) - left;
  if (covered != 0)
    record_coverage(tracing, path, footprint_of(tracing, path.film.pixel, path.film.sample), covered);
}

void record_first_surface(Tracing& tracing, CameraPath& path, const Event& event) {
  const auto& [surface, kind, at, is_there] = event;
  const Material* material = chosen_at(tracing, path, surface, at);
  if (!material) return;
  path.unrecorded = false;

  const FilmLayers& layers = tracing.film.layers();
  const double weight = tracing.scene.filter.weight(path.film.camera[0], path.film.camera[1]);
  const Footprint* const spread = footprint_of(tracing, path.film.pixel, path.film.sample);
  record_coverage(tracing, path, spread);
  for (const Layer layer :
       {Layer::position, Layer::geometric_normal, Layer::shading_normal, Layer::uv, Layer::depth}) {
    if (!layers.has(layer)) continue;
    std::array<double, 3> values = value_at(tracing, path, at, *material, layer);
    for (double& v : values) v *= weight;
    tracing.film.deposit_layer(path.film.pixel, path.film.sample, layer,
                               std::span(values).first(kind_of(layer).sums), spread);
  }
  if (layers.has(Layer::motion)) {
    std::array<double, 2> values = motion_at(tracing, path, at.p);
    for (double& v : values) v *= weight;
    tracing.film.deposit_layer(path.film.pixel, path.film.sample, Layer::motion, values, spread);
  }
  if (layers.has(Layer::albedo)) {
    const XYZ c = albedo_at(tracing, path, at, *material);
    tracing.film.deposit_layer(path.film.pixel, path.film.sample, Layer::albedo, std::array{c.x, c.y, c.z},
                               spread);
  }
  const auto put_id = [&](Layer layer, std::size_t id) {
    if (layers.has(layer))
      tracing.film.put_id(path.film.pixel, path.film.sample, layer, static_cast<std::uint32_t>(id));
  };
  const auto number = static_cast<std::size_t>(&surface - tracing.manifest().surfaces.data());
  put_id(Layer::shape, number);
  put_id(Layer::material, surface.material);
  put_id(Layer::primitive, at.triangle);
  const MatteIds& ids = tracing.scene.mattes;
  if (!ids.surfaces.empty())
    tracing.film.put_matte(path.film.pixel, Layer::crypto_object, ids.surfaces[number], weight, spread);
  if (!ids.materials.empty())
    tracing.film.put_matte(path.film.pixel, Layer::crypto_material, ids.materials[surface.material], weight,
                           spread);
}

}  // namespace vitrail
