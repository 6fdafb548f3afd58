// SPDX-License-Identifier: Apache-2.0
#include "tests/tracer/lanes/fixtures.h"

#include <bit>
#include <cmath>

#include "tests/tracer/lanes/arguments.h"
#include "tracer/lights/baked_light_image.h"
#include "tracer/textures/tile_cache.h"

namespace vitrail::lane_tests {

namespace {

Point3f point(Random& random, double extent) {
  const auto x = [&] { return static_cast<float>(uniform(random, -extent, extent)); };
  return {x(), x(), x()};
}

// Small and large ones, near and far, some flat on an axis, one without area.
void corners(Random& random, std::uint32_t number, Point3f p[3]) {
  const Point3f center = point(random, std::exp2(uniform(random, -3, 12)));
  const double extent = std::exp2(uniform(random, -8, 8));
  for (int k = 0; k < 3; ++k) p[k] = center + (point(random, extent) - Point3f{});
  if (number % 4 == 0)
    for (int k = 0; k < 3; ++k) p[k][number / 4 % 3] = center[number / 4 % 3];
  if (number == 5) p[2] = p[1];
}

DomainContent domain(bool normals, bool uvs) {
  Random random(3);
  DomainContent content;
  content.clusters.resize(fixture_clusters);
  if (normals) content.normals.resize(fixture_clusters);
  if (uvs) content.uvs.resize(fixture_clusters);
  for (std::uint32_t i = 0; i < fixture_clusters * cluster_width; ++i) {
    const std::uint32_t cluster = i / cluster_width, lane = i % cluster_width;
    Point3f p[3];
    corners(random, i, p);
    content.clusters[cluster].id[lane] = i;
    const Vector3d across = cross(cast<double>(p[1] - p[0]), cast<double>(p[2] - p[0]));
    for (int k = 0; k < 3; ++k) {
      for (int axis = 0; axis < 3; ++axis) content.clusters[cluster].vertex[k][axis][lane] = p[k][axis];
      const Vector3d n = normalize(normalize(across) + cast<double>(point(random, 0.7) - Point3f{}));
      // None, all alike, or one a corner; some on the other side.
      const std::uint32_t code = encode_normal(to_normal(i % 7 == 3 ? -n : n));
      if (normals) {
        std::uint32_t* const of_lane = content.normals[cluster].normal[lane];
        of_lane[k] = cluster % 3 == 0 || i % 5 == 0 ? no_normal
                     : cluster % 3 == 1 && k > 0    ? of_lane[0]
                                                    : code;
      }
      if (uvs)  // some without extent
        for (int c = 0; c < 2; ++c)
          content.uvs[cluster].uv[lane][k][c] =
              i % 6 == 0 ? 0.5f : static_cast<float>(uniform(random, -2, 2));
    }
  }
  return content;
}

// Where a sphere may stand: round or stretched askew, some mirrored, one flat.
Affine place(Random& random, std::uint32_t number) {
  Affine a{};
  const double size = std::exp2(uniform(random, -4, 4));
  const Point3f center = point(random, 4);
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j)
      a.m[i][j] = number % 4 == 0 ? (i == j ? size : 0) : uniform(random, -size, size);
    a.m[i][3] = static_cast<double>(center[i]);
  }
  if (number == 7)
    for (double& x : a.m[2]) x = 0;
  return a;
}

// Some far off in a bunch, which are alike from here.
std::vector<LightBounds> light_bounds(std::size_t count) {
  Random random(9);
  std::vector<LightBounds> lights(count);
  for (std::size_t i = 0; i < count; ++i) {
    const bool bunch = i % 2 == 0;
    Point3d center = cast<double>(point(random, bunch ? 1 : 20));
    if (bunch) center = center + Vector3d{500, 0, 0};
    extend(lights[i].box, center);
    extend(lights[i].box, center + cast<double>(point(random, i % 3 == 0 ? 0.1 : 1) - Point3f{}));
    lights[i].axis = bunch ? Vector3d{-1, 0, 0} : normalize(cast<double>(point(random, 1) - Point3f{}));
    lights[i].theta_o_rad = i % 5 == 0 ? uniform(random, 0, 3) : 0;
    lights[i].theta_e_rad = i % 7 == 0 ? 0 : 1.5707963;
    lights[i].power = i % 11 == 0 ? 0 : uniform(random, 0.5, 2);
    lights[i].two_sided = i % 4 == 1;
  }
  return lights;
}

// Of several tiles, dark here and there.
std::shared_ptr<const LightImage> spotted_image(Random& random, TexelFormat format,
                                                const std::filesystem::path& file) {
  write_texture_file(file, {format, 80, 40, 1}, [&](std::uint32_t, std::uint32_t x, std::uint32_t y) {
    const auto value = static_cast<float>(x % 3 == 0 ? 0 : uniform(random, 0, 5));
    if (format == TexelFormat::number) return TexelWords{std::bit_cast<std::uint32_t>(value)};
    const float tint = static_cast<float>(y) / 20 - 1;
    return pack({{tint, static_cast<float>(uniform(random, -2, 2)), -tint}, value});
  });
  return open_light_image(file, std::make_shared<TileCache>(1 << 20));
}

}  // namespace

Fixtures::Fixtures() {
  Random random(5);
  for (std::vector<float>& table : tables)
    for (int i = 0; i < table_size; ++i) table.push_back(static_cast<float>(uniform(random, 0, 2)));
  area_lights = {{.radiance = Spectrum{ConstantSpectrum{1}}},
                 {.radiance = Spectrum{ConstantSpectrum{3}}, .two_sided = true}};
  for (std::uint32_t i = 0; i < fixture_lamps; ++i) {
    EmissiveTriangle t{.triangle = i, .area_light = i / 4 % 2};
    do corners(random, i == 5 ? 6 : i, t.p);
    while (length(cross(cast<double>(t.p[1] - t.p[0]), cast<double>(t.p[2] - t.p[0]))) == 0);
    triangles.push_back(t);
  }
  LightScene scene;
  scene.area_lights = area_lights;
  scene.triangles = triangles;
  lights = make_light_sampler(scene, ImageSource{});
  for (const LightSampler::Slot& slot : lights.slots) {
    two_sided[faces.size()] = area_lights[slot.area_light].two_sided;
    faces.push_back(lights.face(slot.light.index));
  }
  for (std::uint32_t i = 0; i < fixture_spheres; ++i) {
    spheres.push_back({{{.kind = QuadricKind::sphere}, i % 3 == 0}, place(random, i), i});
    placed_spheres.emplace_back(spheres[i].quadric, spheres[i].to_bundle);
  }
  for (std::uint32_t i = 0; i < fixture_domains; ++i) {
    contents[i] = domain((i & 1) != 0, (i & 2) != 0);
    views[i] = view_of(contents[i]);
    context.domain[i] = lanes::tables_of(views[i]);
  }
  trees[0] = LightTree(light_bounds(7), LightChoice::tree);
  trees[1] = LightTree(light_bounds(3000), LightChoice::tree);
  trees[2] = LightTree(light_bounds(300), LightChoice::power);
  trees[4] = LightTree(light_bounds(2), LightChoice::power);
  point_lights.reserve(2), spot_lights.reserve(fixture_emitters), fadings.reserve(fixture_emitters);
  for (std::uint32_t i = 0; i < fixture_emitters; ++i) {
    fadings.push_back({0.5f, i % 3 == 0 ? 0.0f : i % 3 == 1 ? 2.0f : 1.7f});
    if (i < 2) {
      point_lights.push_back({{1, 2, 3}, ConstantSpectrum{0.3f}});
      lights.emitters.push_back(make_emitter(point_lights.back()));
    } else {
      SpotLight& spot = spot_lights.emplace_back();
      spot.intensity = ConstantSpectrum{0.3f};
      spot.falloff = static_cast<SpotLight::Falloff>(i % 3);
      spot.cutoff_deg = 70, spot.beam_deg = i == 3 ? 70.0f : 20.0f;
      spot.tightness = i > 5 ? 2.5f : 0.0f;
      spot.light_to_world = translate({0.1 * i, 1, 2}) * rotate(0.7 * i, {1, 2, 3});
      lights.emitters.push_back(make_emitter(spot));
    }
    if (i % 2 == 1) lights.emitters.back().fading = &fadings.back();
  }
  context.emitters = lights.emitters.data();
  for (std::uint32_t i = 0; i < fixture_trees; ++i) context.trees[i] = &trees[i];
  for (const auto format : {TexelFormat::number, TexelFormat::reflectance, TexelFormat::unbounded,
                            TexelFormat::illuminant, TexelFormat::matrix_r_illuminant}) {
    const std::size_t i = environments.size();
    EnvironmentLight light;
    light.projection = i % 2 == 0 ? SphereProjection::equal_area : SphereProjection::latitude_longitude;
    light.light_to_world = rotate(1, {1, 2, 3});
    if (i == 3) light.scale = Spectrum{SigmoidSpectrum{0, 0.01f, -5}};
    const std::string name = std::to_string(i);
    environments.push_back(make_environment(light, spotted_image(random, format, directory / name)));
    context.images[i] = baked_image_of(environments.back());
  }
  SkyLight light;
  light.light_to_world = rotate(0.1, {1, 0, 0});
  light.to_sun = unit(Vector3d{0.3, 0.2, 0.8});
  light.sun_diameter_deg = 40;
  environments.push_back(make_environment(light));
  light.sky_scale = 0;
  environments.push_back(make_environment(light));
  some_wavelengths = sample_wavelengths(0.3f);
  context.environments = environments.data();
  context.some_wavelengths = &some_wavelengths;
  context.wavelengths = wavelength_tables();
  context.observer = cie_1931()[0].data();
  context.d65 = cie_d65().data();
  context.tables[0] = tables[0].data(), context.tables[1] = tables[1].data();
  const SigmoidSpectrum shape{1e-5f, -0.01f, 2};
  spectra = {ConstantSpectrum{0.3f}, shape, RgbUnboundedSpectrum{shape, 3}, RgbIlluminantSpectrum{shape, 7},
             TabulatedSpectrum{tables[0]}};
  for (const Spectrum& spectrum : spectra) flat_spectra.push_back(flat_spectrum(spectrum, fixture_factor));
  context.flat_spectra = flat_spectra.data();
  context.slots = lights.slots.data();
  context.faces = faces.data();
  context.two_sided = two_sided;
  context.spheres = placed_spheres.data();
}

const Fixtures& fixtures() {
  static const Fixtures all;
  return all;
}

}  // namespace vitrail::lane_tests
