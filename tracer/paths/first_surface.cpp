// SPDX-License-Identifier: Apache-2.0
// What the film keeps of the first surface that a camera ray meets.
#include "tracer/paths/path_state.h"
#include "tracer/paths/path_tracer.h"
#include "tracer/sampling/wavelengths.h"
#include "tracer/surfaces/albedo.h"

namespace vitrail {

namespace {

// Apart from the streams of the ray's own events.
constexpr std::uint64_t albedo_stream = 0x9e3779b97f4a7c15u;

// The light that surfaces are seen by in an albedo: white in the colours of a picture.
const Spectrum& white_light() {
  static const Spectrum d65 = TabulatedSpectrum{{cie_d65().begin(), cie_d65().end()}};
  return d65;
}

std::array<double, 3> values_of(Vector3d v) { return {v.x, v.y, v.z}; }

}  // namespace

// As the camera stands when the path sees the scene.
Transform PathTracer::bundle_to_camera(const Path& path) const {
  const Motion& motion = manifest_.camera_motion;
  return motion.moves() ? inverse(motion.at(path.time_s)) : scene_.bundle_to_camera;
}

// Of the layers that are looked up; the others have none.
std::array<double, 3> PathTracer::value_at(const Path& path, const Interaction& at, const Material& material,
                                           Layer layer) const {
  const bool in_camera_space = film_.layers().in_camera_space;
  const auto facing = [&](Vector3d normal) {
    const Vector3d n = normal * at.side();
    if (!in_camera_space) return values_of(n);
    return values_of(normalize(to_vector(transform_normal(bundle_to_camera(path), to_normal(n)))));
  };
  switch (layer) {
    case Layer::position: {
      const Point3d p =
          in_camera_space ? transform_point(bundle_to_camera(path), at.p) : at.p + manifest_.offset;
      return {p.x, p.y, p.z};
    }
    case Layer::geometric_normal:
      return facing(at.geometric);
    case Layer::shading_normal:
      return facing(scene_.materials.shading_normal(material, at));
    case Layer::uv:
      return {at.uv.x, at.uv.y};
    case Layer::depth: {
      const auto width = static_cast<std::uint32_t>(film_.width());
      const CameraRay ray = camera_ray(film_.crop().x0 + static_cast<int>(path.pixel % width),
                                       film_.crop().y0 + static_cast<int>(path.pixel / width), path);
      return {length(at.p - cast<double>(ray.origin))};
    }
    default:
      return {};
  }
}

// As XYZ, under white light, weighted as the picture is.
XYZ PathTracer::albedo_at(const Path& path, const Interaction& at, const Material& material) const {
  if (!scene_.materials.scatters(material, at)) return {};
  const Scattering scattering = scene_.materials.scattering_at(material, at, path.wavelengths, filled(1),
                                                               stream_of(path, RayRandom::layers));
  const SampledSpectrum share =
      albedo(scattering.bsdf, scattering.frame.to_local(at.out), path.random + albedo_stream);
  return sense(path.sensor, share * evaluate(white_light(), path.wavelengths));
}

// Called where the path has decided that the surface is there, but for a mask of its material, which it will
// decide alike.
void PathTracer::record_first_surface(Path& path, const Interaction& at, const Surface& surface) {
  RandomStream chance(stream_of(path, RayRandom::choice));
  const Material* material = scene_.materials.choose(surface.material, at, chance);
  if (!material) return;
  path.clear(path_unrecorded);

  const FilmLayers& layers = film_.layers();
  const double weight = scene_.filter.weight(path.camera[0], path.camera[1]);
  const Footprint* const spread = footprint_of(path.pixel, path.sample);
  for (const Layer layer :
       {Layer::position, Layer::geometric_normal, Layer::shading_normal, Layer::uv, Layer::depth}) {
    if (!layers.has(layer)) continue;
    std::array<double, 3> values = value_at(path, at, *material, layer);
    for (double& v : values) v *= weight;
    film_.deposit_layer(path.pixel, path.sample, layer, std::span(values).first(kind_of(layer).sums), spread);
  }
  if (layers.has(Layer::albedo)) {
    const XYZ c = albedo_at(path, at, *material);
    film_.deposit_layer(path.pixel, path.sample, Layer::albedo, std::array{c.x, c.y, c.z}, spread);
  }
  const auto put_id = [&](Layer layer, std::size_t id) {
    if (layers.has(layer)) film_.put_id(path.pixel, path.sample, layer, static_cast<std::uint32_t>(id));
  };
  put_id(Layer::shape, static_cast<std::size_t>(&surface - manifest_.surfaces.data()));
  put_id(Layer::material, surface.material);
  put_id(Layer::primitive, at.triangle);
}

}  // namespace vitrail
