// SPDX-License-Identifier: Apache-2.0
#include "tracer/prepared/render_scene.h"

#include <algorithm>

#include "bundle/texture_file.h"
#include "scene/geometry/portable_math.h"
#include "scene/models/paraxial_lens.h"
#include "tracer/rays/domain_tree.h"
#include "tracer/rays/ray_records.h"

namespace vitrail {

namespace {

double pixel_angle(const Manifest& m) {
  const auto angle = [&](const PerspectiveCamera& c) { return (c.screen.y1 - c.screen.y0) / m.film.height; };
  if (const auto* perspective = std::get_if<PerspectiveCamera>(&m.camera)) return angle(*perspective);
  if (const auto* realistic = std::get_if<RealisticCamera>(&m.camera))
    return angle(view_of(*realistic, m.film));
  return 0;
}

RenderScene::Pixel pixel_of(const Manifest& m) {
  if (std::holds_alternative<SphericalCamera>(m.camera)) return {0, pi / m.film.height};
  if (const auto* wide = std::get_if<WideCamera>(&m.camera)) {
    const bool along = wide->projection == WideCamera::Projection::panoramic ||
                       wide->projection == WideCamera::Projection::upright_cylinder;
    return {0, (along ? wide->above : wide->above * (pi / 180)) * 2 / m.film.height};
  }
  const auto* parallel = std::get_if<OrthographicCamera>(&m.camera);
  if (!parallel) return {0, pixel_angle(m)};
  const double per_unit = length(transform_vector(parallel->camera_to_world, {0, 1, 0}));
  return {per_unit * (parallel->screen.y1 - parallel->screen.y0) / m.film.height, 0};
}

const Transform& camera_to_bundle(const Manifest& m) {
  return std::visit([](const auto& camera) -> const Transform& { return camera.camera_to_world; }, m.camera);
}

LightScene light_scene(const Manifest& m, const Textures& textures) {
  return {.area_lights = m.area_lights,
          .triangles = m.emissive_triangles,
          .attributes = m.emissive_attributes,
          .opacities = m.emissive_opacities,
          .quadrics = m.emissive_quadrics,
          .lights = m.lights,
          .textures = &textures,
          .texture_records = m.textures,
          .bounds = core_of(m),
          .refracts = m.requirements.refraction,
          .bands = m.settings.rgb == RgbMethod::bands};
}

}  // namespace

RenderScene::RenderScene(Manifest the_manifest, const std::filesystem::path& bundle,
                         std::uint64_t texture_bytes, std::uint64_t the_seed,
                         const SamplingChoices& the_sampling)
    : manifest(std::move(the_manifest)),
      domain_tree(vitrail::domain_tree(manifest)),
      cell_ways(manifest),
      interiors(manifest),
      camera(manifest.camera, manifest.camera_motion, manifest.film),
      filter(manifest.film.filter, the_sampling.splat),
      textures(manifest.textures, bundle, texture_bytes, manifest.settings.rgb),
      materials(manifest, textures),
      media(prepare(manifest.media)),
      lights(make_light_sampler(light_scene(manifest, textures), bundle, the_sampling.lights)),
      lanes(manifest, textures, interiors, materials, lights),
      bundle_to_camera(inverse(camera_to_bundle(manifest))),
      pixel_angle(vitrail::pixel_angle(manifest)),
      pixel(pixel_of(manifest)),
      seed(the_seed, the_sampling.one_sequence),
      sampling(the_sampling),
      uvs_show(!manifest.textures.empty() || manifest.film.layers.has(Layer::uv)),
      mattes(matte_ids(manifest, bundle)) {
  for (const TextureFileEntry& t : manifest.texture_files)
    check_texture(t, TextureFile(bundle / t.name), bundle / t.name);
}

const Surface& surface_of(const Manifest& manifest, const DomainView& domain, const Hit& hit) {
  std::span<const Surface> surfaces = scene_surfaces(manifest);
  std::uint32_t triangle = hit.triangle;
  if (hit.depth > 0) {
    const DomainView* at = &domain;
    std::uint32_t object = 0;
    for (std::uint32_t i = 0; i < hit.depth; ++i) {
      object = at->instances[hit.chain[i]].object;
      at = domain.objects[object];
    }
    surfaces = surfaces_of(manifest, manifest.objects[object]);
    triangle = at->quadric ? 0 : at->clusters[hit.cluster].id[hit.lane];
  }
  const auto behind =
      std::upper_bound(surfaces.begin(), surfaces.end(), triangle,
                       [](std::uint32_t id, const Surface& surface) { return id < surface.first_triangle; });
  return *(behind - 1);
}

}  // namespace vitrail
