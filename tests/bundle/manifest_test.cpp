// SPDX-License-Identifier: Apache-2.0
#include "bundle/manifest.h"

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>

#include "bundle/binary_records.h"
#include "bundle/checked_json.h"
#include "bundle/checksum.h"
#include "scene/system/diagnostics.h"
#include "tests/bundle/sample_bundle.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::manifest_test {

namespace {

using test::sample_manifest;

class ManifestFile : public ::testing::Test {
 protected:
  test::TemporaryDirectory directory;
  Manifest written_and_read(const Manifest& m) {
    write_manifest(directory.path(), m);
    return read_manifest(directory.path());
  }
};

std::vector<std::byte> lights_of(const Manifest& m) {
  std::vector<std::byte> all;
  encode_lights(m, [&](std::span<const std::byte> part) { all.insert(all.end(), part.begin(), part.end()); });
  return all;
}

TEST_F(ManifestFile, ComesBackAsItWas) {
  const Manifest m = sample_manifest(), r = written_and_read(m);
  EXPECT_EQ(r.triangles, m.triangles);
  EXPECT_EQ(r.cut_triangles, m.cut_triangles);
  EXPECT_EQ(r.offset, m.offset);
  EXPECT_EQ(r.bounds, m.bounds);
  EXPECT_EQ(r.scale, m.scale);
  EXPECT_EQ(r.kd_nodes, m.kd_nodes);
  EXPECT_EQ(r.domains, m.domains);
  EXPECT_EQ(r.surfaces, m.surfaces);
  EXPECT_EQ(r.materials, m.materials);
  EXPECT_EQ(r.area_lights, m.area_lights);
  EXPECT_EQ(lights_of(r), lights_of(m));
  EXPECT_EQ(r.lights, m.lights);
  EXPECT_EQ(r.camera, m.camera);
  EXPECT_EQ(r.film, m.film);
  EXPECT_EQ(r.settings, m.settings);
  EXPECT_EQ(r.requirements, m.requirements);
  EXPECT_EQ(r.scene_hash, m.scene_hash);
}

// A program that does not know of it would render another one.
TEST_F(ManifestFile, Masking) {
  Manifest m = sample_manifest();
  ConductorMaterial metal{PerfectReflector{}};
  metal.roughness = {0.25f, 0.5f, Roughness::Distribution::beckmann};
  m.materials.push_back(Material{metal});
  EXPECT_EQ(features_of(m).required & required_feature::masking, 0u);
  metal.roughness.masking = Masking::correlated;
  m.materials.push_back(Material{metal});
  EXPECT_NE(features_of(m).required & required_feature::masking, 0u);
  EXPECT_EQ(written_and_read(m).materials, m.materials);
}

TEST_F(ManifestFile, WhatPovRayHas) {
  using namespace required_feature;
  Manifest m = sample_manifest();
  const std::size_t bytes = lights_of(m).size();
  EXPECT_EQ(features_of(m).required & (fadings | glows | patterns), 0u);
  m.lights.push_back({PointLight{{1, 2, 3}, ConstantSpectrum{1}, std::nullopt}, {}});
  EXPECT_EQ(features_of(m).required & fadings, 0u);
  const std::size_t plain = lights_of(m).size() - bytes;
  m.lights.push_back({PointLight{{1, 2, 3}, ConstantSpectrum{1}, Fading{4, 2}}, {}});
  EXPECT_EQ(lights_of(m).size(), bytes + 2 * plain + 9);  // a bool and two floats
  SpotLight spot;
  spot.intensity = ConstantSpectrum{1};
  m.lights.push_back({spot, {}});
  spot.tightness = 7;
  m.lights.push_back({spot, {}});
  m.area_lights.push_back({ConstantSpectrum{1}, 1, true, true, false, {}});
  PatternTexture pattern;
  pattern.kind = PatternTexture::Kind::wood;
  pattern.turbulence.amount = {1, 2, 3};
  pattern.by_uv = true;
  pattern.map = {{0, ConstantSpectrum{0}}, {0.5f, Id<Texture>{0}}};
  m.textures.push_back({pattern});
  EXPECT_EQ(features_of(m).required & (fadings | glows | patterns), fadings | glows | patterns);
  const Manifest r = written_and_read(m);
  EXPECT_EQ(r.lights, m.lights);
  EXPECT_EQ(r.area_lights, m.area_lights);
  EXPECT_EQ(r.textures, m.textures);
  EXPECT_NE(hash_of_records(r), hash_of_records(sample_manifest()));
  m.lights.back() = {PointLight{{1, 2, 3}, ConstantSpectrum{1}, Fading{-1, 2}}, {}};
  EXPECT_THROW(written_and_read(m), Error);
}

TEST_F(ManifestFile, Skies) {
  using required_feature::skies;
  Manifest m = sample_manifest();
  m.lights.push_back({SkyLight{}, {}});
  EXPECT_EQ(features_of(m).required & skies, 0u);
  SkyLight sky;
  sky.ground = 0.25f;
  m.lights.push_back({sky, {}});
  EXPECT_EQ(features_of(m).required & skies, skies);
  sky.limb_darkening = false;
  *sky.distribution = SkyDistribution{.a = 4, .b = -0.7, .diffuse_lx = 1e4};
  m.lights.push_back({sky, {}});
  sky.ground = 0, sky.color_temperature_k = 5000;
  m.lights.push_back({sky, {}});
  EXPECT_EQ(written_and_read(m).lights, m.lights);
  for (const float wrong : {-0.1f, 1.1f, std::numeric_limits<float>::quiet_NaN()}) {
    sky.ground = wrong;
    m.lights.back() = {sky, {}};
    EXPECT_THROW(written_and_read(m), Error) << wrong;
  }
  sky.ground = 0, sky.color_temperature_k = 100;
  m.lights.back() = {sky, {}};
  EXPECT_THROW(written_and_read(m), Error);
}

TEST_F(ManifestFile, Formulas) {
  using Op = PatternStep::Op;
  Manifest m = sample_manifest();
  PatternTexture formula;
  formula.kind = PatternTexture::Kind::formula;
  formula.steps = {{Op::pick, 2}, {Op::constant, 0, 0.25}, {Op::multiply}};
  formula.fractals = {{PatternFractal::Kind::magnet2, true, {0.5, -0.25}, 3, 20}};
  formula.patterns.resize(2);
  formula.patterns[1].kind = PatternTexture::Kind::wood;
  formula.patterns[1].map = {{0, ConstantSpectrum{0}}, {0.5f, ConstantSpectrum{3}}};
  m.textures.push_back({formula});
  EXPECT_EQ(features_of(m).required & (required_feature::formulas | required_feature::globes),
            required_feature::formulas);
  EXPECT_EQ(written_and_read(m).textures, m.textures);
  // Of other kinds nothing of a formula is kept.
  std::get<PatternTexture>(m.textures.back().model).kind = PatternTexture::Kind::onion;
  EXPECT_EQ(features_of(m).required & required_feature::formulas, 0u);
  const Manifest r = written_and_read(m);
  EXPECT_TRUE(std::get<PatternTexture>(r.textures.back().model).steps.empty());
}

TEST_F(ManifestFile, ImagesAroundGlobes) {
  Manifest m = sample_manifest();
  for (Texture& texture : m.textures)
    if (auto* image = std::get_if<ImageTexture>(&texture.model))
      image->mapping = GlobeMapping{scale({1, 2, 3})};
  EXPECT_NE(features_of(m).required & required_feature::globes, 0u);
  EXPECT_EQ(written_and_read(m).textures, m.textures);
}

// A reflector with one coefficient a pair, and measurements of nothing in particular.
ScatteringTable fourier_table() {
  return FourierTable{
      1.5f, 1, {-1, 0, 0, 1}, std::vector<std::uint32_t>(16), std::vector<std::uint32_t>(16, 1), {0.25f}};
}
ScatteringTable adaptive_table() {
  const SquareTable square{2, 2, {1, 2, 3, 4}};
  return AdaptiveTable{{0}, {0.5f}, {500}, square, square, square, square, square, true};
}

TEST_F(ManifestFile, Tables) {
  Manifest m = sample_manifest();
  using Format = TabulatedMaterial::Format;
  m.tables = {fourier_table(), adaptive_table()};
  m.materials.push_back(Material{TabulatedMaterial{Format::adaptive, "", {1}}});
  m.materials.push_back(Material{SlabMaterial{ConstantSpectrum{1}, ConstantSpectrum{2}, 3, 0.5f}});
  EXPECT_EQ(features_of(m).required & (required_feature::tables | required_feature::slabs),
            required_feature::tables | required_feature::slabs);
  const Manifest r = written_and_read(m);
  EXPECT_EQ(r.tables, m.tables);
  EXPECT_EQ(r.materials, m.materials);

  const auto refused = [&](auto&& spoil) {
    Manifest bad = m;
    spoil(bad);
    EXPECT_THROW(write_manifest(directory.path(), bad), Error);
  };
  const auto fourier = [](Manifest& bad) -> FourierTable& { return std::get<FourierTable>(bad.tables[0]); };
  const auto adaptive = [](Manifest& bad) -> AdaptiveTable& {
    return std::get<AdaptiveTable>(bad.tables[1]);
  };
  using Material = TabulatedMaterial;
  const auto tabulated = [&](Manifest& bad) -> Material& {
    return std::get<Material>(bad.materials[bad.materials.size() - 2].model);
  };
  refused([&](Manifest& bad) { tabulated(bad).table.value = 2; });
  refused([&](Manifest& bad) { tabulated(bad).table.value = 0; });  // of the other format
  refused([&](Manifest& bad) { fourier(bad).first[3] = 1; });
  refused([&](Manifest& bad) { fourier(bad).orders[15] = 0x7fffffff; });
  refused([&](Manifest& bad) { fourier(bad).mu = {-1, 0, 0, 0}; });
  refused([&](Manifest& bad) { fourier(bad).mu = {-1, 0.5f, 0, 1}; });
  refused([&](Manifest& bad) { fourier(bad).eta = 0; });
  refused([&](Manifest& bad) { fourier(bad).channels = 2; });
  refused([&](Manifest& bad) { adaptive(bad).theta_i = {}; });
  refused([&](Manifest& bad) { adaptive(bad).theta_i = {0.5f, 0.5f}; });
  refused([&](Manifest& bad) { adaptive(bad).luminance.values = {0, 0, 0, 0}; });
  refused([&](Manifest& bad) { adaptive(bad).visible_normals.values[1] = -1; });
  refused([&](Manifest& bad) { adaptive(bad).spectra.values.pop_back(); });
  refused([&](Manifest& bad) { adaptive(bad).normals.rows = 1; });
  refused([&](Manifest& bad) { std::get<SlabMaterial>(bad.materials.back().model).g = 1; });
}

TEST_F(ManifestFile, OpacitiesOfWhatShines) {
  Manifest m = sample_manifest();
  m.emissive_opacities.assign(m.emissive_triangles.size(), 0.25f);
  EXPECT_EQ(written_and_read(m).emissive_opacities, m.emissive_opacities);
  m.emissive_attributes.clear();
  const Manifest r = written_and_read(m);
  EXPECT_EQ(r.emissive_opacities, m.emissive_opacities);
  EXPECT_TRUE(r.emissive_attributes.empty());
}

TEST_F(ManifestFile, EveryFilterAndCamera) {
  Manifest m = sample_manifest();
  m.camera = PerspectiveCamera{scale({1e-7, 2, 3}), {-0.1, 0.2, -0.3, 0.4}};
  for (const Filter filter :
       {Filter{BoxFilter{0.1, 0.2}}, Filter{TriangleFilter{1, 2}}, Filter{GaussianFilter{}}}) {
    m.film.filter = filter;
    const Manifest r = written_and_read(m);
    EXPECT_EQ(r.film, m.film);
    EXPECT_EQ(r.camera, m.camera);
  }
  using Projection = SphericalCamera::Projection;
  for (const Projection projection : {Projection::equal_area, Projection::latitude_longitude}) {
    m.camera = SphericalCamera{translate({1, 2, 3}), projection};
    EXPECT_EQ(written_and_read(m).camera, m.camera);
  }
}

TEST_F(ManifestFile, NearAndFarPlanes) {
  Manifest m = sample_manifest();
  constexpr float infinite = ClipRange{}.far;
  for (const ClipRange clip :
       {ClipRange{}, ClipRange{0.1f, infinite}, ClipRange{0, 4}, ClipRange{0.1f, 1e4f}})
    for (const Camera& camera :
         {Camera{PerspectiveCamera{{}, {}, {}, clip}}, Camera{OrthographicCamera{{}, {}, {}, clip}}}) {
      m.camera = camera;
      EXPECT_EQ(written_and_read(m).camera, camera);
      EXPECT_EQ((features_of(m).required & required_feature::clips) != 0, clip != ClipRange{});
    }
}

// Domains 0 and 1 share a cell, where 1 is met in two places.
TEST_F(ManifestFile, ACellThatDomainsShare) {
  constexpr std::uint32_t leaf = KdNode::leaf_bit;
  Manifest m = sample_manifest();
  m.kd_nodes = {{0.1f, 0, 1, leaf | 2},
                {2, KdNode::no_axis, leaf | 0, 2},
                {0.3f, 1, leaf | 1, 3},
                {0.2f, 2, leaf | 1, leaf | 0}};
  EXPECT_EQ(written_and_read(m).kd_nodes, m.kd_nodes);
  m.kd_nodes[3].above = leaf | 2;  // which is not of the cell
  EXPECT_THROW(written_and_read(m), std::exception);
}

TEST_F(ManifestFile, TheHashOfRecordsSeesEachOfThem) {
  const std::uint64_t hash = hash_of_records(sample_manifest());
  EXPECT_EQ(hash_of_records(sample_manifest()), hash);
  const std::vector<std::function<void(Manifest&)>> changes{
      [](Manifest& m) { m.materials.push_back(m.materials[0]); },
      [](Manifest& m) { m.lights.pop_back(); },
      [](Manifest& m) { m.area_lights[0].scale += 1; },
      [](Manifest& m) { m.media[0].scale += 1; },
      [](Manifest& m) { std::get<OrthographicCamera>(m.camera).camera_to_world.m[0][3] += 1; },
      [](Manifest& m) { m.film.width += 1; },
      [](Manifest& m) { m.texture_files.at(0).hash += 1; },
  };
  for (std::size_t i = 0; i < changes.size(); ++i) {
    Manifest m = sample_manifest();
    changes[i](m);
    EXPECT_NE(hash_of_records(m), hash) << "change " << i;
  }
  Manifest moving = sample_manifest();
  moving.requirements.motion = true;
  const std::uint64_t hash_of_moving = hash_of_records(moving);
  moving.shutter.close_s += 1;
  EXPECT_NE(hash_of_records(moving), hash_of_moving);
}

TEST_F(ManifestFile, WithoutAnyTriangle) {
  Manifest m;
  m.domains.resize(1);
  const Manifest r = written_and_read(m);
  EXPECT_TRUE(r.bounds.empty());
  EXPECT_TRUE(r.kd_nodes.empty());
}

TEST_F(ManifestFile, MissingBundle) {
  EXPECT_THROW(read_manifest(directory.path()), Error);
  EXPECT_THROW(read_manifest(directory.path() / "nowhere"), Error);
}

// A manifest that cannot be rendered is refused when it is written and would be when it is read.
TEST_F(ManifestFile, WrongContentIsFound) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr std::uint32_t leaf = KdNode::leaf_bit;
  const std::vector<std::function<void(Manifest&)>> harms{
      [](Manifest& m) { m.kd_nodes[0].below = 0; },         // a loop
      [](Manifest& m) { m.kd_nodes[0].below = leaf | 0; },  // a domain twice, a node never
      [](Manifest& m) { m.kd_nodes[1].above = leaf | 3; },
      [](Manifest& m) { m.kd_nodes[1].axis = KdNode::no_axis + 1; },
      [](Manifest& m) { m.kd_nodes[0].split = std::numeric_limits<float>::infinity(); },
      [](Manifest& m) { m.kd_nodes.pop_back(); },
      // Cells that domains share: of one domain alone, of more than there are, with another below, with
      // others.
      [](Manifest& m) {
        m.kd_nodes[1] = {1, KdNode::no_axis, leaf | 0, leaf | 1};
      },
      [](Manifest& m) {
        m.kd_nodes[1] = {4, KdNode::no_axis, leaf | 0, leaf | 1};
      },
      [](Manifest& m) {
        m.kd_nodes[1] = {2, KdNode::no_axis, leaf | 1, leaf | 0};
      },
      [](Manifest& m) {
        m.kd_nodes[0] = {3, KdNode::no_axis, 1, leaf | 2};
      },
      [](Manifest& m) { m.domains.clear(); },
      [](Manifest& m) { m.domains[0].tight_bounds.lower.x = std::numeric_limits<float>::quiet_NaN(); },
      [](Manifest& m) { m.domains[0].tight_bounds.upper.y = std::numeric_limits<float>::infinity(); },
      [](Manifest& m) {
        m.domains[0].tight_bounds = {{1, 0, 0}, {0, 1, 1}};
      },
      [](Manifest& m) { m.triangles = (1ull << 62) + 1; },
      [](Manifest& m) { m.cut_triangles = 12; },
      [](Manifest& m) { m.surfaces[0].first_triangle = 1; },
      [](Manifest& m) { m.surfaces[2].first_triangle = 4; },
      [](Manifest& m) { m.surfaces[2].first_triangle = 11; },
      [](Manifest& m) { m.surfaces[1].material = 3; },
      [](Manifest& m) { m.surfaces[1].area_light = 2; },
      [](Manifest& m) { m.surfaces[1].area_light = -2; },
      [](Manifest& m) { m.surfaces[0].interior = 2; },
      [](Manifest& m) { m.surfaces[0].opacity = Id<Texture>{2}; },
      [](Manifest& m) { m.emissive_opacities.resize(m.emissive_triangles.size() + 1); },
      [](Manifest& m) { m.camera_medium = 2; },
      [](Manifest& m) { m.materials[0].normal_map = Id<Texture>{2}; },
      [](Manifest& m) { std::get<BlendMaterial>(m.materials[2].model).first = {2}; },  // itself
      [](Manifest& m) { std::get<CheckerboardTexture>(m.textures[1].model).odd = Id<Texture>{1}; },
      [](Manifest& m) { m.media[0].g = 1; },
      [](Manifest& m) { std::get<Grid>(std::get<ExtinctionAlbedo>(m.media[1].coefficients).sigma_t).nx = 3; },
      [](Manifest& m) { m.attributes = max_attributes + 1; },
      [](Manifest& m) { m.emissive_triangles[0].triangle = 11; },
      [](Manifest& m) { m.emissive_triangles[0].area_light = 2; },
      [](Manifest& m) { m.emissive_quadrics.push_back({{Quadric{.low = 0.5, .high = 0.25}}}); },
      [](Manifest& m) { m.offset.y = nan; },
      [](Manifest& m) { std::get<PointLight>(m.lights[0].model).position.x = nan; },
      [](Manifest& m) { std::get<OrthographicCamera>(m.camera).camera_to_world.m[1][1] = nan; },
      [](Manifest& m) { m.film.crop.x1 = 641; },
      [](Manifest& m) {
        m.film.filter = BoxFilter{0, 1};
      },
      [](Manifest& m) {
        m.film.filter = BoxFilter{1, 1e300};
      },
      [](Manifest& m) { std::get<ImageTexture>(m.textures[0].model).filename = "/etc/passwd"; },
      [](Manifest& m) { std::get<ImageTexture>(m.textures[0].model).filename = "textures/000001.tex"; },
      [](Manifest& m) { m.domains[1].bytes = ~std::uint64_t{0}; },
      [](Manifest& m) { m.settings.samples_per_pixel = 0; },
      [](Manifest& m) { m.settings.photons->photons = 0; },
      [](Manifest& m) { m.settings.photons->first_radius = -1; },
      [](Manifest& m) { m.settings.photons->alpha = 1; },
      [](Manifest& m) { m.film.working_gamma = -1; },
      [](Manifest& m) { m.film.working_gamma = nan; },
      [](Manifest& m) { m.film.imaging_ratio = nan; },
      [](Manifest& m) { m.film.spectrum.count = -1; },
      [](Manifest& m) {
        m.film.filter = MitchellFilter{2, 2, nan, 0.3};
      },
      [](Manifest& m) {
        m.film.filter = MitchellFilter{2, 2, 0.3, nan};
      },
      [](Manifest& m) {
        m.film.filter = SincFilter{4, 4, 0};
      },
      [](Manifest& m) {
        m.film.filter = SincFilter{4, 4, nan};
      },
      [](Manifest& m) { m.materials[0].model = MeasuredMaterial{}; },
      [](Manifest& m) {
        m.materials[0].model =
            MeasuredMaterial{"", MeasuredSheet{{400, 700}, {0, 1}, {0, 0, 0, 0}, {0, 0, 0}}};
      },
      [](Manifest& m) {
        m.materials[0].model =
            MeasuredMaterial{"", MeasuredSheet{{700, 400}, {0, 1}, {0, 0, 0, 0}, {0, 0, 0, 0}}};
      },
  };
  for (std::size_t i = 0; i < harms.size(); ++i) {
    Manifest m = sample_manifest();
    harms[i](m);
    EXPECT_THROW(write_manifest(directory.path(), m), Error) << "harm " << i;
  }
}

TEST_F(ManifestFile, KdTreeMayNotBeTooDeep) {
  const auto chain = [](std::uint32_t levels) {
    Manifest m;
    m.domains.resize(levels + 1);
    for (std::uint32_t i = 0; i < levels; ++i)
      m.kd_nodes.push_back({0, 0, i + 1 < levels ? i + 1 : KdNode::leaf_bit | levels, KdNode::leaf_bit | i});
    return m;
  };
  EXPECT_NO_THROW(write_manifest(directory.path(), chain(max_kd_depth)));
  EXPECT_THROW(write_manifest(directory.path(), chain(max_kd_depth + 1)), Error);
}

TEST_F(ManifestFile, ObjectsComeBackAsTheyWere) {
  Manifest m = sample_manifest();
  test::add_objects(m);
  write_manifest(directory.path(), m);
  const Manifest r = read_manifest(directory.path());
  EXPECT_EQ(r.objects, m.objects);
  EXPECT_EQ(r.domains, m.domains);
  EXPECT_EQ(r.surfaces, m.surfaces);
  EXPECT_EQ(scene_surfaces(r).size(), 3u);
  EXPECT_EQ(surfaces_of(r, r.objects[1]).size(), 2u);
}

TEST_F(ManifestFile, WrongObjectsAreFound) {
  const std::vector<std::function<void(Manifest&)>> harms{
      [](Manifest& m) { m.objects[0].objects = {0}; },      // holds itself
      [](Manifest& m) { m.objects[0].objects = {1}; },      // a loop
      [](Manifest& m) { m.objects[1].triangles = 16; },     // more than the scene
      [](Manifest& m) { m.objects[1].triangles = 1; },      // a surface beyond its triangles
      [](Manifest& m) { m.objects[1].surface_count = 3; },  // surfaces that are not there
      [](Manifest& m) { m.objects[1].first_surface = 2; },  // one of the scene's
      [](Manifest& m) { m.objects[0].first_surface = 7; },  // behind the last
      [](Manifest& m) { m.domains[0].objects = {1}; },      // not all that it needs
      [](Manifest& m) {
        m.domains[0].objects = {0, 1, 2};
      },  // no such object
      [](Manifest& m) {
        m.domains[0].objects = {1, 0};
      },
  };
  for (std::size_t i = 0; i < harms.size(); ++i) {
    Manifest m = sample_manifest();
    test::add_objects(m);
    harms[i](m);
    EXPECT_THROW(write_manifest(directory.path(), m), Error) << "harm " << i;
  }
}

TEST_F(ManifestFile, InstancesMayNotBeTooDeep) {
  const auto chain = [](std::size_t levels) {  // each object holds the one before it
    Manifest m = sample_manifest();
    test::add_objects(m);
    const ObjectInfo first = m.objects[0], holder = m.objects[1];
    m.objects = {first};
    m.surfaces.resize(4);
    for (std::uint32_t i = 1; i < levels; ++i) {
      m.objects.push_back(holder);
      m.objects[i].first_surface = 4;
      m.objects[i].surface_count = 0;
      m.objects[i].triangles = first.triangles;
      m.objects[i].objects = {i - 1};
    }
    for (DomainInfo& d : m.domains) {
      d.objects.clear();
      for (std::uint32_t i = 0; i < levels; ++i) d.objects.push_back(i);
    }
    return m;
  };
  EXPECT_NO_THROW(write_manifest(directory.path(), chain(max_instance_depth)));
  EXPECT_THROW(write_manifest(directory.path(), chain(max_instance_depth + 1)), Error);
}

// What reading the sample says with other words in it, their checksum right.
std::string message_with(const std::filesystem::path& bundle, const char* before, const char* after) {
  write_manifest(bundle, sample_manifest());
  const auto file = bundle / "manifest.json";
  std::string text = test::read_text(file);
  text.replace(text.find(before), std::strlen(before), after);
  const std::string rest = text.substr(text.find('\n') + 1);
  char line[64];
  std::snprintf(line, sizeof line, "{\"checksum\": \"%016llx\",\n",
                static_cast<unsigned long long>(checksum(std::as_bytes(std::span(rest)))));
  test::write_text(file, line + rest);
  try {
    read_manifest(bundle);
  } catch (const Error& e) {
    return e.what();
  }
  return "";
}

TEST_F(ManifestFile, AnotherVersionIsNamed) {
  const std::string message = message_with(directory.path(), "\"version\": 8", "\"version\": 9");
  EXPECT_NE(message.find("version 9"), std::string::npos) << message;
}

TEST_F(ManifestFile, UnknownFeaturesAreNamedOrIgnored) {
  const std::string message = message_with(directory.path(), "\"normals\"", "\"tea leaves\"");
  EXPECT_NE(message.find("it needs 'tea leaves'"), std::string::npos) << message;
  EXPECT_EQ(message_with(directory.path(), "\"pieces\"", "\"tea leaves\""), "");
}

// The sample's manifest with another number at a JSON pointer, its checksum right.
std::string message_of_number(const std::filesystem::path& bundle, const char* where, double number) {
  write_manifest(bundle, sample_manifest());
  const auto file = bundle / "manifest.json";
  nlohmann::ordered_json json = read_checked_json(file, "it");
  json.erase("checksum");
  json.at(nlohmann::ordered_json::json_pointer(where)) = number;
  write_checked_json(file, json);
  try {
    read_manifest(bundle);
  } catch (const Error& e) {
    EXPECT_NE(e.location.file.find("manifest.json"), std::string::npos);
    return e.what();
  }
  return "read";
}

TEST_F(ManifestFile, NumbersThatCannotBeAreNamed) {
  for (const char* where : {"/triangles", "/film/width_px", "/film/crop_px/0", "/settings/max_depth",
                            "/attributes", "/camera_medium", "/scale", "/bounds/1/2"})
    for (const double number : {-1e300, 1e300}) {
      const std::string message = message_of_number(directory.path(), where, number);
      EXPECT_NE(message.find("e+300, which is not a number that can stand there"), std::string::npos)
          << where << ": " << message;
    }
  const std::string message = message_of_number(directory.path(), "/film/width_px", 1.5);
  EXPECT_NE(message.find("width_px is 1.5"), std::string::npos) << message;
}

TEST_F(ManifestFile, BoundsBeginBeforeTheyEnd) {
  const std::string message = message_of_number(directory.path(), "/bounds/0/0", 1e30);
  EXPECT_NE(message.find("end before they begin"), std::string::npos) << message;
}

// 40 · 429509837 · 2147418113 is 8 in 64 bits.
TEST_F(ManifestFile, AGridWhoseCellsCannotBeCountedIsNone) {
  Manifest m = sample_manifest();
  Medium medium;
  Grid grid;
  grid.nx = 40, grid.ny = 429509837, grid.nz = 2147418113;
  grid.values.resize(8, 1.0f);
  medium.density = grid;
  m.media.push_back(medium);
  EXPECT_THROW(write_manifest(directory.path(), m), Error);
}

TEST_F(ManifestFile, Temperatures) {
  Manifest m = sample_manifest();
  EXPECT_EQ(features_of(m).required & required_feature::temperatures, 0u);
  m.media[0].temperature = Grid{"", "", 2, 1, 1, 1, {900, 1000}};
  m.media[0].temperature_scale = 2, m.media[0].temperature_offset = 100;
  EXPECT_NE(features_of(m).required & required_feature::temperatures, 0u);
  EXPECT_EQ(features_of(m).required & required_feature::media_grids, 0u);
  EXPECT_EQ(written_and_read(m).media, m.media);
  m.media[0].emission_scale = Grid{"", "", 1, 1, 2, 1, {3, 4}};
  m.media[0].veils = true;
  EXPECT_EQ(written_and_read(m).media, m.media);
  m.media[0].temperature->edge = GridEdge::zero;
  EXPECT_NE(features_of(m).required & required_feature::media_grids, 0u);
  EXPECT_EQ(written_and_read(m).media, m.media);
  m.media[0].temperature->nx = 3;
  EXPECT_THROW(write_manifest(directory.path(), m), Error);
}

TEST_F(ManifestFile, MaterialsThatDoubleAreRefused) {
  Manifest m = sample_manifest();
  for (int i = 0; i < 40; ++i) {
    const Id<Material> last{static_cast<std::uint32_t>(m.materials.size() - 1)};
    m.materials.push_back({BlendMaterial{last, last}});
  }
  EXPECT_THROW(write_manifest(directory.path(), m), Error);
}

}  // namespace

}  // namespace vitrail::manifest_test
