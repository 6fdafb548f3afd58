// SPDX-License-Identifier: Apache-2.0
#include "tracer/transport/generate.h"

#include "scene/records/pixel_place.h"

namespace vitrail {

CameraRay camera_ray(const Tracing& tracing, const CameraPath& path, int x, int y) {
  const RenderScene& scene = tracing.scene;
  const Point2d offset = scene.filter.sample(path.film.camera[0], path.film.camera[1]).offset;
  Point2d lens;
  if (scene.camera.has_lens()) {
    const std::array<float, 4> point = sample_4d(path.key, sample_set::lens);
    lens = {static_cast<double>(point[0]), static_cast<double>(point[1])};
  }
  return scene.camera.ray({x + 0.5 + offset.x, y + 0.5 + offset.y}, lens, path.time_s);
}

void set_sample(const Tracing& tracing, CameraPath& path, int x, int y, std::uint32_t sample) {
  const Film& film = tracing.film;
  path.film.pixel =
      static_cast<std::uint32_t>(pixel_place(x - film.crop().x0, y - film.crop().y0, film.width()));
  path.film.sample = sample;
  path.key = key_of(tracing, path.film.pixel, sample);
}

int column_of(const Tracing& tracing, const FilmSample& film) {
  return tracing.film.crop().x0 +
         static_cast<int>(film.pixel % static_cast<std::uint32_t>(tracing.film.width()));
}
int row_of(const Tracing& tracing, const FilmSample& film) {
  return tracing.film.crop().y0 +
         static_cast<int>(film.pixel / static_cast<std::uint32_t>(tracing.film.width()));
}

bool begin(Tracing& tracing, CameraPath& path, Given given) {
  Film& film = tracing.film;
  FilmSample& of = path.film;
  if (given == Given::nothing)
    begin(tracing, path, of);
  else
    path.time_s = time_of(tracing, path.key);
  double weight = 1;
  if (given != Given::ray) {
    const CameraRay ray = camera_ray(tracing, path, column_of(tracing, of), row_of(tracing, of));
    weight = ray.weight;
    path.direction = ray.direction;
    path.ray = {ray.origin, decode_direction(ray.direction), no_triangle};
    path.hit.t = ray.end;
    if (ray.before > 0) widen_cone(tracing, path, of.sample, ray.before);
    path.random = hash_of_ray(path);
  }
  path.unrecorded = film.layers().any();
  path.pdf = CameraPath::unscattered;
  path.throughput = filled(static_cast<float>(weight));
  if (tracing.scene.sampling.one_wavelength) path.disperse();
  path.inside = tracing.scene.interiors.state_in(tracing.manifest().camera_medium);
  if (tracing.sums)
    tracing.sums->count_sample(of.pixel, of.sample);
  else
    film.count_sample(of.pixel, of.sample, footprint_of(tracing, of.pixel, of.sample));
  ++tracing.counters.rays_camera;
  return weight > 0;
}

void pack(const Tracing&, const CameraPath& path, bool resolved, RayRecord& record) {
  PathRecord& r = record.path;
  static_cast<RayRecordHead&>(r) = head_of(path, RayRecordKind::path, resolved);
  if (path.passed) r.kind_and_flags |= ray_passed;
  if (path.unrecorded) r.kind_and_flags |= ray_unrecorded;
  if (path.connected) r.kind_and_flags |= ray_connected;
  if (path.pane.is_known()) r.kind_and_flags |= ray_in_pane;
  r.sample = SampleRecord::of(path.film.pixel, path.film.sample, path.numbered_depth());
  r.cone = path.cone;
  if (path.pane.is_known()) {  // then its density is 0, and so is its way since
    r.pane = path.pane.record();
  } else {
    r.scattered.pdf = pdf_code(path.pdf);
    r.scattered.travelled = distance_code(static_cast<float>(path.travelled));
  }
}

void unpack(const Tracing& tracing, const PathRecord& record, CameraPath& path) {
  path.film.pixel = record.sample.pixel;
  path.film.sample = record.sample.sample();
  begin(tracing, path, path.film);
  path.set_numbered_depth(record.sample.all_depth());
  unpack_head(record, path);
  path.passed = record.is(ray_passed);
  path.unrecorded = record.is(ray_unrecorded);
  path.connected = record.is(ray_connected);
  path.cone = record.cone;
  if (record.is(ray_in_pane)) {
    path.pane = PaneState::of(record.pane);
  } else {
    path.pdf = pdf_value(record.scattered.pdf);
    path.travelled = static_cast<double>(distance_value(record.scattered.travelled));
  }
}

}  // namespace vitrail
