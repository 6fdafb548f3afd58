// SPDX-License-Identifier: Apache-2.0
// Cameras, films and integrators from Mitsuba's sensors: by the definition of each parameter, and back from
// what write_mitsuba writes.
#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <random>

#include "importers/mitsuba/read/index_of_refraction.h"
#include "importers/mitsuba/read/mitsuba.h"
#include "importers/mitsuba/write/write_mitsuba.h"
#include "tests/importers/mitsuba/mitsuba_objects.h"
#include "tests/importers/temporary_folder.h"
#include "tests/importers/written_scenes.h"

namespace vitrail::mitsuba::mitsuba_sensor_test {
namespace {

using testing::Contains;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;

struct Reading {
  Scene scene;
  Diagnostics diagnostics;
};

Reading read(const Object& root) {
  TestBuilder test;
  test.scene.files = {"scene.xml"};
  read_all(test.builder, root);
  return {test.scene, test.report.take()};
}
Reading read_text(const std::string& xml) { return read(load_objects_of_text(xml)); }

Reading written_and_read(const Scene& scene) {
  const TemporaryFolder folder;
  write_mitsuba(scene, folder / "scene.xml");
  return read(load_objects(folder / "scene.xml"));
}

auto says(const std::string& text) { return Contains(Field(&Diagnostic::message, HasSubstr(text))); }

// The sensor of `type`, of a film of width × height pixels.
std::string sensor(const std::string& type, const std::string& properties, int width = 8, int height = 4) {
  return "<sensor type='" + type + "'>" + properties + "<film type='hdrfilm'><integer name='width' value='" +
         std::to_string(width) + "'/><integer name='height' value='" + std::to_string(height) +
         "'/></film></sensor>";
}

// Of 0.6: (sin φ sin θ, cos θ, −cos φ sin θ) at (φ/2π, θ/π) of the image.
TEST(SphericalSensor, LooksWhere06Looks) {
  const Reading reading =
      read_text(sensor("spherical", "<transform name='to_world'><translate x='3'/></transform>"));
  EXPECT_THAT(reading.diagnostics, IsEmpty());
  const auto& camera = std::get<SphericalCamera>(reading.scene.camera);
  EXPECT_EQ(camera.projection, SphericalCamera::Projection::latitude_longitude);
  EXPECT_EQ(transform_point(camera.camera_to_world, {0, 0, 0}), (Point3d{3, 0, 0}));
  for (const double phi : {0.3, 2.0, 5.0})
    for (const double theta : {0.2, 1.8}) {
      // SphericalCamera: by latitude and longitude around +y
      const Vector3d ours{std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
      const Vector3d d = transform_vector(camera.camera_to_world, ours);
      EXPECT_NEAR(d.x, std::sin(phi) * std::sin(theta), 1e-12);
      EXPECT_NEAR(d.y, std::cos(theta), 1e-12);
      EXPECT_NEAR(d.z, -std::cos(phi) * std::sin(theta), 1e-12);
    }
}

ScreenWindow screen_of(const Scene& scene) { return std::get<PerspectiveCamera>(scene.camera).screen; }

struct AxisCase {
  const char* axis;
  int width, height;
  double expected_width;  // of the half screen at 50 degrees, over tan 25°
};

class FovAxis : public testing::TestWithParam<AxisCase> {};

TEST_P(FovAxis, MeasuresTheField) {
  const auto [axis, width, height, expected] = GetParam();
  const std::string text =
      "<float name='fov' value='50'/><string name='fov_axis' value='" + std::string(axis) + "'/>";
  const Reading reading = read_text(sensor("perspective", text, width, height));
  const double x = expected * std::tan(25 * std::numbers::pi / 180), y = x * height / width;
  const ScreenWindow screen = screen_of(reading.scene);
  EXPECT_NEAR(screen.x1, x, 1e-15);
  EXPECT_NEAR(screen.x0, -x, 1e-15);
  EXPECT_NEAR(screen.y0, -y, 1e-15);
  EXPECT_NEAR(screen.y1, y, 1e-15);
  EXPECT_THAT(reading.diagnostics, IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Axes, FovAxis,
                         testing::Values(AxisCase{"x", 16, 8, 1}, AxisCase{"y", 16, 8, 2},
                                         AxisCase{"smaller", 16, 8, 2}, AxisCase{"larger", 16, 8, 1},
                                         AxisCase{"diagonal", 16, 8, 2 / std::sqrt(5)},
                                         AxisCase{"x", 8, 16, 1}, AxisCase{"y", 8, 16, 0.5},
                                         AxisCase{"smaller", 8, 16, 1}, AxisCase{"larger", 8, 16, 0.5},
                                         AxisCase{"diagonal", 8, 16, 1 / std::sqrt(5)},
                                         AxisCase{"smaller", 8, 8, 1}, AxisCase{"larger", 8, 8, 1}));

TEST(MitsubaSensor, FocalLengthIsOnTheDiagonalOf35mmFilm) {
  const double half_diagonal = std::sqrt(36 * 36 + 24 * 24) / (2 * 35);
  for (const char* text :
       {"<string name='focal_length' value='35mm'/>", "<float name='focal_length' value='35'/>",
        "<string name='focal_length' value='35'/>"}) {
    const ScreenWindow screen = screen_of(read_text(sensor("perspective", text)).scene);
    EXPECT_NEAR(std::hypot(screen.x1, screen.y1), half_diagonal, 1e-15);
    EXPECT_NEAR(screen.x1, 2 * screen.y1, 1e-15);
  }
  // Mitsuba 3.9.1's first ray without any property, 16 × 8 pixels: (0.386988372, 0.193494186, 1).
  EXPECT_NEAR(screen_of(read_text(sensor("perspective", "")).scene).x1, 0.386988372, 1e-7);
}

// Mitsuba 3.9.1, 16 × 8 pixels, fov 50: the ray through the upper left corner is (0.373046118, 0.139892322,
// 1) and that through the lower right one (−0.559569069, −0.326415302, 1), with +x on the left.
TEST(MitsubaSensor, PrincipalPoint) {
  const ScreenWindow screen =
      screen_of(read_text(sensor("perspective",
                                 "<float name='fov' value='50'/>"
                                 "<float name='principal_point_offset_x' value='0.1'/>"
                                 "<float name='principal_point_offset_y' value='0.2'/>"))
                    .scene);
  EXPECT_NEAR(screen.x0, -0.373046118, 3e-7);
  EXPECT_NEAR(screen.y1, 0.139892322, 3e-7);
  EXPECT_NEAR(screen.x1, 0.559569069, 3e-7);
  EXPECT_NEAR(screen.y0, -0.326415302, 3e-7);
}

TEST(MitsubaSensor, OrthographicScreenIsTwoUnitsWide) {
  const Scene scene =
      read_text(
          sensor("orthographic", "<transform name='to_world'><scale x='3' y='3' z='3'/></transform>", 8, 16))
          .scene;
  const auto& camera = std::get<OrthographicCamera>(scene.camera);
  EXPECT_EQ(camera.screen, (ScreenWindow{-1, 1, -2, 2}));
  EXPECT_EQ(camera.camera_to_world, scale({-3, 3, 3}));
}

TEST(MitsubaSensor, Defaults) {
  const Scene scene = read_text("<sensor type='perspective'/><integrator type='path'/>").scene;
  EXPECT_EQ(scene.film, (FilmSettings{768, 576, {0, 768, 0, 576}, GaussianFilter{2, 2, 0.5}, 1}));
  EXPECT_EQ(scene.settings, (RenderSettings{4, unlimited_depth, false}));
  EXPECT_EQ(std::get<PerspectiveCamera>(scene.camera).lens, Lens{});
}

// ---- Back from the writer

class WrittenCameras : public testing::Test {
 protected:
  double uniform(double low, double high) { return std::uniform_real_distribution(low, high)(random_); }
  Transform rigid() {
    return snapped(translate({uniform(-100, 100), uniform(-1, 1), uniform(-5, 5)}) *
                   rotate(uniform(0, 6), {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}));
  }
  Scene scene() {
    Scene scene = empty_scene();
    scene.film.width = static_cast<int>(uniform(1, 3000));
    scene.film.height = static_cast<int>(uniform(1, 3000));
    scene.film.crop = {0, scene.film.width, 0, scene.film.height};
    return scene;
  }
  // As pbrt's reader makes it: the angle is on the shorter axis.
  ScreenWindow natural(const FilmSettings& film, double scale) {
    const double aspect = static_cast<double>(film.width) / film.height;
    if (aspect > 1) return {-aspect * scale, aspect * scale, -scale, scale};
    return {-scale, scale, -1 / aspect * scale, 1 / aspect * scale};
  }
  std::mt19937 random_{7};
};

TEST_F(WrittenCameras, PerspectiveComesBackToTheBit) {
  for (int i = 0; i < 50; ++i) {
    Scene original = scene();
    const double fov = i == 0 ? 90 : uniform(1, 170);
    const double half = fov == 90 ? 1 : std::tan(fov / 2 * std::numbers::pi / 180);
    PerspectiveCamera camera{rigid(), natural(original.film, half), {}};
    if (i % 3 == 0) camera.lens = {uniform(0.01, 1), uniform(1, 100)};
    original.camera = camera;
    const Reading reading = written_and_read(original);
    EXPECT_EQ(reading.scene.camera, original.camera) << "camera " << i;
    EXPECT_EQ(reading.scene.film, original.film);
    EXPECT_THAT(reading.diagnostics, IsEmpty());
  }
}

TEST_F(WrittenCameras, OffCentreWindowsComeBack) {
  int exact = 0;
  constexpr int count = 60;
  for (int i = 0; i < count; ++i) {
    Scene original = scene();
    const ScreenWindow whole = natural(original.film, uniform(0.1, 2));
    const double x = uniform(-1.5, 1.5) * whole.x1, y = uniform(-1.5, 1.5) * whole.y1;
    const ScreenWindow moved{whole.x0 + x, whole.x1 + x, whole.y0 + y, whole.y1 + y};
    original.camera = PerspectiveCamera{rigid(), moved, {}};
    const Scene again = written_and_read(original).scene;
    const ScreenWindow found = screen_of(again);
    exact += found == moved;
    const double tolerance = 1e-14 * (std::abs(whole.x1) + std::abs(whole.y1) + std::abs(x) + std::abs(y));
    EXPECT_NEAR(found.x0, moved.x0, tolerance);
    EXPECT_NEAR(found.x1, moved.x1, tolerance);
    EXPECT_NEAR(found.y0, moved.y0, tolerance);
    EXPECT_NEAR(found.y1, moved.y1, tolerance);
    // What has been read once comes back to the bit.
    EXPECT_EQ(written_and_read(again).scene.camera, again.camera) << "camera " << i;
  }
  EXPECT_GT(exact, count / 2);  // four edges, each rounded by itself, follow from three numbers
}

TEST_F(WrittenCameras, Orthographic) {
  for (int i = 0; i < 15; ++i) {
    Scene original = scene();
    const double aspect = static_cast<double>(original.film.width) / original.film.height;
    original.camera = OrthographicCamera{rigid(), {-1, 1, -1 / aspect, 1 / aspect}, {}};
    EXPECT_EQ(written_and_read(original).scene.camera, original.camera) << "camera " << i;
  }
}

TEST_F(WrittenCameras, FilmsFiltersAndSettings) {
  for (const Filter& filter :
       {Filter{BoxFilter{}}, Filter{TriangleFilter{1.7, 1.7}}, Filter{GaussianFilter{1.2, 1.2, 0.3}},
        Filter{MitchellFilter{2, 2, 0.1, 0.7}}, Filter{SincFilter{4, 4, 4}}}) {
    Scene original = scene();
    original.film.width = 300, original.film.height = 200;
    original.film.crop = {2, 260, 1, 30};
    original.film.filter = filter;
    original.settings = {77, 9, false};
    std::get<PerspectiveCamera>(original.camera).screen = natural(original.film, 0.5);
    const Reading reading = written_and_read(original);
    EXPECT_EQ(reading.scene.film, original.film);
    EXPECT_EQ(reading.scene.settings, original.settings);
    EXPECT_EQ(reading.scene.camera, original.camera);
    EXPECT_THAT(reading.diagnostics, IsEmpty());
  }
  Scene original = scene();
  for (const RenderSettings& settings :
       {RenderSettings{1, unlimited_depth, false}, RenderSettings{5, 1, true}, RenderSettings{5, 0, false}}) {
    original.settings = settings;
    EXPECT_EQ(written_and_read(original).scene.settings, settings);
  }
}

TEST_F(WrittenCameras, TheCamerasMedium) {
  Scene original = scene();
  original.media.push_back({"fog", ExtinctionAlbedo{}});
  original.media.push_back({"", ExtinctionAlbedo{ConstantSpectrum{2}, ConstantSpectrum{0.5f}}});
  original.camera_medium = Id<Medium>{1};
  const Scene again = written_and_read(original).scene;
  EXPECT_EQ(again.media, original.media);
  EXPECT_EQ(again.camera_medium, original.camera_medium);
}

TEST(MitsubaFilm, PixelsThatAreNotRedGreenAndBlueAreReported) {
  const auto notes = [](const std::string& format) {
    return read_text("<sensor type='perspective'><film type='hdrfilm'><string name='pixel_format' value='" +
                     format + "'/><rfilter type='box'/></film></sensor>")
        .diagnostics;
  };
  for (const char* kept : {"rgb", "rgba"}) EXPECT_THAT(notes(kept), IsEmpty()) << kept;
  for (const char* other : {"luminance", "luminance_alpha", "xyz", "xyza"})
    EXPECT_THAT(notes(other), Contains(Field(&Diagnostic::message, HasSubstr("red, green and blue"))))
        << other;
}

// ---- Integrators

RenderSettings integrator(const std::string& xml) { return read_text(xml).scene.settings; }

TEST(MitsubaIntegrator, DepthCountsTheEyesRay) {
  const auto depth = [](int value) {
    return integrator("<integrator type='path'><integer name='max_depth' value='" + std::to_string(value) +
                      "'/></integrator>")
        .max_depth;
  };
  EXPECT_EQ(depth(-1), unlimited_depth);
  EXPECT_EQ(depth(8), 7);
  EXPECT_EQ(depth(1), 0);
  EXPECT_EQ(depth(0), 0);
  EXPECT_EQ(depth(std::numeric_limits<int>::max()), unlimited_depth);
  EXPECT_THROW(depth(-2), Error);
}

TEST(MitsubaIntegrator, WrappersShowTheirInside) {
  const Reading reading = read_text(
      "<integrator type='aov'><string name='aovs' value='dd:depth'/><integrator type='moment'>"
      "<integrator type='direct'/></integrator></integrator>");
  EXPECT_TRUE(reading.scene.settings.direct_only);
  EXPECT_EQ(names_of(reading.scene.film.layers), "depth");
}

// Before and after the film is read, which knows nothing of them.
TEST(MitsubaIntegrator, AovsAreLayersOfTheFilm) {
  const std::string aov =
      "<integrator type='aov'><string name='aovs' value='a:albedo, dd.y:depth,p:position,uv:uv ,"
      "n:geo_normal,s:sh_normal,i:prim_index,j:shape_index'/><integrator type='path'/></integrator>";
  for (const std::string& text : {aov + sensor("perspective", ""), sensor("perspective", "") + aov}) {
    const Reading reading = read_text(text);
    EXPECT_EQ(names_of(reading.scene.film.layers),
              "albedo,position,geo_normal,sh_normal,uv,depth,shape_index,prim_index");
    EXPECT_FALSE(reading.scene.film.layers.in_camera_space);
    EXPECT_THAT(reading.diagnostics, says("normals face the camera"));
  }
  const auto aovs = [](const std::string& names) {
    return read_text("<integrator type='aov'><string name='aovs' value='" + names +
                     "'/><integrator type='path'/></integrator>");
  };
  EXPECT_THAT(aovs("p:position,t:uv").diagnostics, IsEmpty());
  EXPECT_EQ(names_of(aovs(",p:position, ,t:uv,").scene.film.layers), "position,uv");
  EXPECT_THAT(aovs("p:position,q:dp_du").diagnostics, says("\"q:dp_du\""));
  EXPECT_EQ(names_of(aovs("p:position,q:dp_du").scene.film.layers), "position");
}

TEST(MitsubaIntegrator, AovsAreWritten) {
  Scene scene = read_text(sensor("perspective", "") + "<integrator type='path'/>").scene;
  scene.film.layers.bits = all_layers;
  for (const Layer layer :
       {Layer::material, Layer::alpha, Layer::motion, Layer::crypto_object, Layer::crypto_material})
    scene.film.layers.remove(layer);
  EXPECT_EQ(written_and_read(scene).scene.film.layers, scene.film.layers);
  EXPECT_EQ(written_and_read(scene).scene.settings, scene.settings);
  scene.film.layers.add(Layer::material);
  scene.film.layers.in_camera_space = true;
  const TemporaryFolder folder;
  const Diagnostics written = write_mitsuba(scene, folder / "scene.xml");
  EXPECT_THAT(written, says("no index of materials"));
  EXPECT_THAT(written, says("are the world's"));
  scene.film.layers = {};
  scene.film.layers.add(Layer::alpha), scene.film.layers.add(Layer::crypto_object);
  EXPECT_THAT(write_mitsuba(scene, folder / "scene.xml"), says("Mitsuba has not: crypto_object"));
  std::ifstream file(folder / "scene.xml");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_THAT(text, ::testing::HasSubstr("value=\"rgba\""));
  scene.film.layers.remove(Layer::crypto_object);
  EXPECT_EQ(written_and_read(scene).scene.film.layers, scene.film.layers);
}

TEST(MitsubaIntegrator, PhotonMappersOfOldTracePhotons) {
  const auto of = [](const std::string& type, const std::string& inside) {
    return integrator("<integrator type='" + type + "'>" + inside + "</integrator>");
  };
  EXPECT_EQ(of("sppm", "").photons, (PhotonSettings{{}, {}, 0.7}));
  const RenderSettings ppm =
      of("ppm",
         "<integer name='photon_count' value='300'/><float name='alpha' value='0.5'/>"
         "<float name='initial_radius' value='2'/><integer name='max_passes' value='9'/>");
  EXPECT_EQ(ppm.photons, (PhotonSettings{300, 2, 0.5}));
  EXPECT_EQ(ppm.samples_per_pixel, 9);
  EXPECT_EQ(of("photonmapper", "<integer name='global_photons' value='400'/>").photons,
            (PhotonSettings{400, {}, {}}));
  EXPECT_THAT(read_text("<integrator type='photonmapper'/>").diagnostics, says("progressive photon mapping"));
  EXPECT_EQ(of("path", "").photons, std::nullopt);
}

TEST(MitsubaIntegrator, OthersSayWhatTheyMiss) {
  const std::string mirror = "<bsdf type='conductor'/>";
  for (const char* const type : {"bdpt", "mlt", "pssmlt", "erpt", "ptracer"}) {
    const std::string text = std::string("<integrator type='") + type + "'/>";
    EXPECT_THAT(read_text(text).diagnostics, IsEmpty()) << type;
    EXPECT_THAT(read_text(text + mirror).diagnostics, says("from small lamps is missed")) << type;
  }
  for (const char* const type : {"path", "volpath", "volpathmis", "direct", "prb", "emission"})
    EXPECT_THAT(read_text(std::string("<integrator type='") + type + "'/>" + mirror).diagnostics, IsEmpty())
        << type;
  EXPECT_THAT(read_text("<integrator type='prb_basic'/><emitter type='point'/>").diagnostics,
              says("lamps that no ray meets"));
}

TEST(MitsubaIntegrator, HidesEmitters) {
  const Reading hidden =
      read_text("<integrator type='path'><boolean name='hide_emitters' value='true'/></integrator>");
  EXPECT_TRUE(hidden.scene.settings.hides_emitters);
  EXPECT_TRUE(hidden.diagnostics.empty());
  EXPECT_FALSE(read_text("<integrator type='path'/>").scene.settings.hides_emitters);
}

TEST(MitsubaIntegrator, WhatItLeavesOutIsSaid) {
  EXPECT_THAT(read_text("<integrator type='depth'/>").diagnostics, says("becomes a path tracer"));
  EXPECT_THAT(read_text("<integrator type='volpaht'/>").diagnostics, says("did you mean \"volpath\""));
  EXPECT_THAT(read_text("<integrator type='moment'/>").diagnostics, says("has none inside"));
}

// ---- What cannot be, or not exactly

TEST(MitsubaSensor, MistakesAreErrorsWithTheirPlace) {
  const std::string lens = "<float name='aperture_radius' value='1'/>";
  for (const std::string& text :
       {sensor("perspective", "<transform name='to_world'><scale x='0' y='1' z='1'/></transform>"),
        sensor("perspective", "<float name='fov' value='180'/>"),
        sensor("perspective", "<float name='fov' value='0'/>"),
        sensor("perspective", "<float name='fov' value='nan'/>"),
        sensor("perspective", "<float name='fov' value='50'/><string name='focal_length' value='50mm'/>"),
        sensor("perspective", "<string name='focal_length' value='50cm'/>"),
        sensor("perspective", "<string name='focal_length' value='-1mm'/>"),
        sensor("perspective", "<float name='fov' value='50'/><string name='fov_axis' value='z'/>"),
        sensor("perspective", "<string name='focal_length' value='1e-320'/>"),
        sensor("perspective", "<float name='principal_point_offset_x' value='inf'/>"), sensor("thinlens", ""),
        sensor("thinlens", lens + "<float name='focus_distance' value='0'/>"),
        sensor("perspective",
               "<sampler type='independent'><integer name='sample_count' value='0'/></sampler>"),
        sensor("perspective", "", 0, 4), sensor("perspective", "", 1 << 30, 4), sensor("batch", "")}) {
    try {
      read_text(text);
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_GT(error.location.column, 1) << text;
      EXPECT_EQ(error.location.file, "scene.xml");
    }
  }
}

TEST(MitsubaFilm, TheCropLiesInside) {
  const auto film = [](const std::string& crop) {
    return read_text("<sensor type='perspective'><film type='hdrfilm'><integer name='width' value='8'/>" +
                     crop + "</film></sensor>")
        .scene.film.crop;
  };
  EXPECT_EQ(film("<integer name='crop_offset_x' value='4'/><integer name='crop_width' value='4'/>"),
            (PixelRect{4, 8, 0, 576}));
  EXPECT_THROW(film("<integer name='crop_offset_x' value='4'/>"), Error);
  EXPECT_THROW(film("<integer name='crop_offset_x' value='-1'/><integer name='crop_width' value='2'/>"),
               Error);
  EXPECT_THROW(film("<integer name='crop_width' value='0'/>"), Error);
  EXPECT_THROW(film("<integer name='crop_offset_y' value='2147483647'/>"), Error);
}

TEST(MitsubaSensor, OtherSensorsBecomeTheNearest) {
  EXPECT_THAT(read_text(sensor("radiancemeter", "")).diagnostics, says("0.01 degrees"));
  for (const bool down : {false, true}) {
    const Reading meter = read_text(sensor(
        "radiancemeter", std::string("<point name='origin' x='1' y='2' z='3'/><vector name='direction' ") +
                             (down ? "x='0' y='-2' z='0'/>" : "x='0' y='3' z='4'/>")));
    EXPECT_EQ(meter.diagnostics.size(), 1u) << "where it is and looks is used";
    const Transform& place = std::get<PerspectiveCamera>(meter.scene.camera).camera_to_world;
    EXPECT_EQ(transform_point(place, {0, 0, 0}), (Point3d{1, 2, 3}));
    const Vector3d along = transform_vector(place, {0, 0, 1});
    EXPECT_LT(length(along - (down ? Vector3d{0, -1, 0} : Vector3d{0, .6, .8})), 1e-12);
  }
  EXPECT_THAT(read_text(sensor("irradiancemeter", "")).diagnostics, says("90 degrees"));
  EXPECT_THAT(read_text(sensor("distant", "")).diagnostics, says("an orthographic camera"));
  EXPECT_THAT(read_text(sensor("perspectiv", "")).diagnostics, says("did you mean \"perspective\""));
  const Reading batch = read_text(sensor(
      "batch", sensor("thinlens", "<float name='aperture_radius' value='1'/>") + sensor("perspective", "")));
  EXPECT_THAT(batch.diagnostics, says("all but the first of the 2"));
  EXPECT_EQ(std::get<PerspectiveCamera>(batch.scene.camera).lens, (Lens{1, 1e4}));
}

Reading with_bands(const std::string& bands) {
  return read_text("<sensor type='perspective'><film type='specfilm'>" + bands + "</film></sensor>");
}

TEST(MitsubaFilm, BandsSideBySideAreBins) {
  const Reading bins = with_bands(
      "<spectrum name='b' value='500:.01, 600:.01'/><spectrum name='a' value='400:.01, 500:.01'/>"
      "<spectrum name='c' value='600:.01, 700:.01'/>");
  EXPECT_EQ(bins.scene.film.spectrum, (SpectralBins{3, 400, 700}));
  EXPECT_THAT(bins.diagnostics, IsEmpty());
  const Reading sums = with_bands("<spectrum name='a' value='400:1, 500:1'/>");
  EXPECT_EQ(sums.scene.film.spectrum, (SpectralBins{1, 400, 500}));
  EXPECT_THAT(sums.diagnostics, says("100 times"));
  const Reading infrared = with_bands("<spectrum name='a' value='800:.01, 900:.01'/>");
  EXPECT_EQ(infrared.scene.film.spectrum, (SpectralBins{1, 800, 900}));
  EXPECT_THAT(infrared.diagnostics, says("black when they are rendered"));
}

TEST(MitsubaFilm, OtherBandsAreSumsOfNarrowBins) {
  const Reading curve = with_bands(
      "<spectrum name='a' value='400:0, 450:1, 500:0'/><spectrum name='b' type='regular'>"
      "<string name='values' value='1, 2, 1'/><float name='wavelength_min' value='480'/>"
      "<float name='wavelength_max' value='605'/></spectrum>");
  EXPECT_EQ(curve.scene.film.spectrum, (SpectralBins{21, 400, 605}));
  EXPECT_THAT(curve.diagnostics, says("21 intervals of 9.762 nm"));
  EXPECT_THAT(with_bands("").diagnostics, says("without bands"));
}

// As many and as wide, to the bit.
TEST(MitsubaFilm, BinsComeBack) {
  for (const SpectralBins& bins :
       {SpectralBins{47, 360, 830}, SpectralBins{7, 400.1, 699.7}, SpectralBins{1, 500, 501}}) {
    Scene scene;
    scene.film.spectrum = bins;
    const Reading back = written_and_read(scene);
    EXPECT_EQ(back.scene.film.spectrum, bins);
    EXPECT_THAT(back.diagnostics, IsEmpty());
  }
}

TEST(MitsubaFilm, UnknownFilters) {
  const Reading reading =
      read_text("<sensor type='perspective'><film type='hdrfilm'><rfilter type='gausian'/></film></sensor>");
  EXPECT_THAT(reading.diagnostics, says("did you mean \"gaussian\""));
  EXPECT_EQ(reading.scene.film.filter, (Filter{GaussianFilter{2, 2, 0.5}}));
}

TEST(MitsubaFilm, FiltersHaveTheirDefaults) {
  const std::vector<std::pair<std::string, Filter>> filters{
      {"box", BoxFilter{}},
      {"tent", TriangleFilter{1, 1}},
      {"gaussian", GaussianFilter{2, 2, 0.5}},
      {"mitchell", MitchellFilter{2, 2, 1.0 / 3, 1.0 / 3}},
      {"lanczos", SincFilter{3, 3, 3}}};
  for (const auto& [type, filter] : filters)
    EXPECT_EQ(read_text("<sensor type='perspective'><film type='hdrfilm'><rfilter type='" + type +
                        "'/></film></sensor>")
                  .scene.film.filter,
              filter)
        << type;
}

TEST(MitsubaFilm, CatmullRomIsMitchells) {
  const Scene scene =
      read_text(
          "<sensor type='perspective'><film type='hdrfilm'><rfilter type='catmullrom'/></film></sensor>")
          .scene;
  EXPECT_EQ(scene.film.filter, (Filter{MitchellFilter{2, 2, 0, 0.5}}));
}

TEST(SnappedTransform, TwiceIsOnce) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> small(-1e-6, 1e-6);
  for (int i = 0; i < 200; ++i) {
    const Transform t = rotate(small(random), {1, 1, 0.3}) * translate({1 - 1e-14, small(random), 0});
    EXPECT_EQ(snapped(snapped(t)), snapped(t));
  }
}

// By Walsh's closed form of the reflectance from outside, and that both sides let through the same.
TEST(IndexOfRefraction, WhatDiffuseLightMeetsWithin) {
  EXPECT_NEAR(internal_reflectance(1.33), 0.471949149, 3e-6);
  EXPECT_NEAR(internal_reflectance(1.5), 0.596345760, 3e-6);
  EXPECT_NEAR(internal_reflectance(2), 0.790149159, 3e-6);
}

}  // namespace
}  // namespace vitrail::mitsuba::mitsuba_sensor_test
