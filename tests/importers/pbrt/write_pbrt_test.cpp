// SPDX-License-Identifier: Apache-2.0
// pbrt → Scene → pbrt → Scene gives an equal Scene: cameras, films, lights, media.
#include <sstream>

#include "images/image_files.h"
#include "importers/images/environment_images.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "tests/importers/pbrt/pbrt_round_trip.h"

namespace vitrail::write_pbrt_test {
namespace {

TEST(WritePbrt, Cameras) {
  for (const char* camera :
       {"LookAt 1 2 3 4 5.5 6 0 0 1 Camera \"perspective\" \"float fov\" 36.7",
        "Scale -1 1 1 LookAt .1 .2 .3 4 5 6 0 1 0 Camera \"perspective\"",
        "Rotate 33 1 2 3 Camera \"perspective\" \"float screenwindow\" [-1 .5 -.25 .75] \"float fov\" 60",
        "Translate 1e6 2e5 .3 Rotate 10 0 1 .1 Camera \"perspective\" \"float lensradius\" .01 \"float "
        "focaldistance\" 4",
        "Camera \"perspective\" \"float frameaspectratio\" 3",
        "Camera \"orthographic\" \"float screenwindow\" [-3 3 -2 2]", "Camera \"orthographic\"",
        "Camera \"spherical\" \"string mapping\" \"equirectangular\""})
    for (const char* film : {"\"integer xresolution\" 300 \"integer yresolution\" 700", ""})
      expect_exact(std::string(camera) + " Film \"rgb\" " + film + " WorldBegin " + triangle);
}

TEST(WritePbrt, Motion) {
  const std::string camera =
      "TransformTimes .25 2.5 ActiveTransform StartTime LookAt 1 2 3 4 5.5 6 0 0 1 ActiveTransform EndTime "
      "LookAt 1 2 4 4 5.5 7 0 .1 1 ActiveTransform All Camera \"perspective\" \"float shutteropen\" .5 "
      "\"float "
      "shutterclose\" .7 ";
  const std::string world =
      "WorldBegin ObjectBegin \"a\" " + triangle +
      "ObjectEnd AttributeBegin ActiveTransform EndTime Translate 1 2 3 ActiveTransform All Scale 2 1 1 "
      "ObjectInstance \"a\" AttributeEnd AttributeBegin ActiveTransform StartTime Translate 0 0 7.1 "
      "ActiveTransform All " +
      triangle + triangle + " AttributeEnd " + triangle;
  expect_exact(camera + "Film \"rgb\" \"float iso\" 250 " + world);
  expect_exact("Film \"rgb\" " + world);
  expect_exact(camera + "Film \"rgb\" WorldBegin " + triangle);
}

// pbrt moves a shape that turns as it is moved here, and an instance about its camera: a shape stays one.
TEST(WritePbrt, MotionThatTurns) {
  const std::string turning =
      "AttributeBegin ActiveTransform StartTime Translate -1 0 0 ActiveTransform EndTime Translate 1 0 0 "
      "Rotate 40 0 1 0 ActiveTransform All ";
  expect_exact_world(turning + triangle + " AttributeEnd " + turning +
                     " Shape \"sphere\" \"float radius\" .8 AttributeEnd");
  const RoundTrip shapes = round_trip("Film \"rgb\" WorldBegin " + turning + triangle +
                                      " Shape \"sphere\" \"float radius\" .8 AttributeEnd");
  EXPECT_THAT(shapes.text, testing::Not(testing::HasSubstr("Object")));
  const RoundTrip instance = expect_reported(
      "ObjectBegin \"a\" " + triangle + "ObjectEnd " + turning + "ObjectInstance \"a\" AttributeEnd",
      "pbrt turns it about its camera");
  EXPECT_TRUE(mentions(instance.first.diagnostics, "pbrt turns it about its camera"));
  EXPECT_EQ(test::difference(instance.first.scene, instance.second.scene), "");
}

// Keyframes of other times are looked up at those that are written.
TEST(WritePbrt, MotionOfMoreKeyframes) {
  Scene scene = import_v4("ActiveTransform EndTime Translate 1 0 0 " + triangle).scene;
  scene.motions[0] = Motion({{0, {}}, {1, translate({3, 0, 0})}, {4, translate({4, 0, 0})}});
  scene.shutter = {0, 4};
  const TemporaryFolder folder;
  const Diagnostics written = write_pbrt(scene, folder / "out.pbrt");
  EXPECT_TRUE(mentions(written, "two keyframes"));
  const Scene again = read_pbrt(folder / "out.pbrt").scene;
  const std::vector<Keyframe> keys{{0, {}}, {4, translate({4, 0, 0})}};
  ASSERT_EQ(again.motions.size(), 1u);
  EXPECT_EQ(again.motions[0].keys(), keys);
}

TEST(WritePbrt, FilmsFiltersAndSettings) {
  for (const char* settings :
       {"Film \"rgb\" \"integer pixelbounds\" [10 20 30 50] \"float iso\" 150 PixelFilter \"box\"",
        "Film \"rgb\" PixelFilter \"mitchell\" \"float B\" .3 \"float xradius\" 1.7 Sampler \"sobol\" "
        "\"integer "
        "pixelsamples\" 77",
        "Film \"rgb\" PixelFilter \"sinc\" Integrator \"volpath\" \"integer maxdepth\" 17",
        "Film \"rgb\" PixelFilter \"gaussian\" \"float sigma\" .7", "Film \"rgb\" PixelFilter \"triangle\""})
    expect_exact(std::string(settings) + " WorldBegin " + triangle);
}

TEST(WritePbrt, LayersOfFirstSurfaces) {
  for (const char* space : {"camera", "world"})
    expect_exact("Film \"gbuffer\" \"string coordinatesystem\" \"" + std::string(space) + "\" WorldBegin " +
                 triangle);
  Scene scene = round_trip("Film \"rgb\" WorldBegin " + triangle).first.scene;
  const auto written = [&](FilmLayers layers, int bins) {
    scene.film.layers = layers;
    scene.film.spectrum.count = bins;
    const TemporaryFolder folder;
    std::string said;
    for (const Diagnostic& d : write_pbrt(scene, folder / "out.pbrt")) said += d.message + "\n";
    return std::pair(read_pbrt(folder / "out.pbrt").scene.film.layers, said);
  };
  FilmLayers depth, two;
  depth.add(Layer::depth);
  two.add(Layer::albedo), two.add(Layer::shape);
  EXPECT_THAT(written(depth, 0).second, testing::HasSubstr("\"rgb\" has not: depth"));
  EXPECT_FALSE(written(depth, 0).first.any());
  EXPECT_THAT(written(two, 0).second, testing::HasSubstr("has not: shape_index"));
  EXPECT_TRUE(written(two, 0).first.has(Layer::albedo));
  EXPECT_THAT(written(two, 16).second, testing::HasSubstr("\"spectral\" has not: albedo,shape_index"));
}

TEST(WritePbrt, PhotonsOfSppm) {
  const TemporaryFolder folder;
  Scene scene = read_pbrt(folder.write("scene.pbrt", "Film \"rgb\"\nWorldBegin\n" + triangle)).scene;
  scene.settings.photons = PhotonSettings{1000, 0.25, {}};
  EXPECT_THAT(write_pbrt(scene, folder / "out.pbrt"), testing::IsEmpty());
  EXPECT_EQ(read_pbrt(folder / "out.pbrt").scene.settings, scene.settings);
  scene.settings.photons = PhotonSettings{{}, {}, 0.5};
  EXPECT_TRUE(mentions(write_pbrt(scene, folder / "out.pbrt"), "pbrt's own share"));
}

TEST(WritePbrt, Lights) {
  for (const char* light :
       {"LightSource \"point\" \"rgb I\" [1 2 3] \"point3 from\" [.1 .2 .3] \"float scale\" .7",
        "LightSource \"point\" \"blackbody I\" 5000 \"float power\" 77",
        "LightSource \"point\" \"spectrum I\" [400 1 700 3]",
        "LightSource \"point\" \"spectrum I\" [400 .1 546.05 .1 546.15 9 546.25 .1 700 .1] \"float scale\" 7",
        "LightSource \"point\" \"spectrum I\" \"stdillum-D65\" \"float scale\" 3",
        "LightSource \"point\" \"spectrum I\" [300 2 900 2] \"float scale\" .3",
        "Rotate 20 1 2 3 LightSource \"spot\" \"point3 from\" [1 2 3] \"point3 to\" [3 3 3] \"float "
        "coneangle\" 33.3",
        "Scale 2 2 2 LightSource \"distant\" \"point3 from\" [1 2 3] \"point3 to\" [3 4 7] \"float "
        "illuminance\" 3",
        "LightSource \"infinite\" \"rgb L\" [.1 .2 .3]",
        "Rotate 20 1 2 3 LightSource \"infinite\" \"string filename\" \"sky.exr\" \"float scale\" .3 \"float "
        "illuminance\" 9",
        "Translate 1 2 3 LightSource \"projection\" \"string filename\" \"slide.png\" \"float fov\" 33 "
        "\"float power\" 9",
        "Translate 1 2 3 LightSource \"goniometric\" \"string filename\" \"lamp.exr\" \"rgb I\" [3 2 1]"})
    expect_exact_world(light + std::string(" ") + triangle);
}

// With equal angles pbrt-v4 finds no light.
TEST(WritePbrt, AHardSpotKeepsItsLight) {
  Scene scene;
  SpotLight spot;
  spot.intensity = ConstantSpectrum{1};
  spot.beam_deg = spot.cutoff_deg = 30;
  scene.lights.push_back({spot});
  const TemporaryFolder folder;
  write_pbrt(scene, folder / "out.pbrt");
  const SpotLight again = std::get<SpotLight>(read_pbrt(folder / "out.pbrt").scene.lights.at(0).model);
  EXPECT_LT(again.beam_deg, again.cutoff_deg);
  EXPECT_GT(again.beam_deg, 29.9f);
}

// pbrt looks at lights at whole nanometres: a line between them is written as what these have of it, a smooth
// spectrum as it was read.
TEST(WritePbrt, LinesOfLightsAreSeenAtWholeNanometres) {
  const auto text_of = [](const std::vector<SpectrumSample>& samples) {
    const TemporaryFolder folder;
    Scene scene;
    scene.lights.push_back(Light{PointLight{{0, 0, 0}, tabulate(samples, false)}, {}});
    write_pbrt(scene, folder / "out.pbrt");
    std::ostringstream text;
    text << std::ifstream(folder / "out.pbrt").rdbuf();
    return text.str();
  };
  const std::string line = text_of({{400, 0}, {546.1, 0}, {546.3, 1}, {546.5, 0}, {700, 0}});
  EXPECT_THAT(line, testing::Not(testing::HasSubstr("546.3")));
  EXPECT_THAT(line, testing::HasSubstr(" 545 0 546 0."));
  EXPECT_THAT(text_of({{400.5, 1}, {550.5, 2}, {700.5, 1}}),
              testing::HasSubstr("[ 400.5 1 550.5 2 700.5 1 ]"));
}

// pbrt-v4 reads equal-area maps alone: one bright patch stays where it is.
TEST(WritePbrt, EnvironmentsByLatitudeAreResampled) {
  using enum EnvironmentLight::Projection;
  const TemporaryFolder folder;
  Image sky = black_image(64, 32, 3);
  for (int y = 4; y < 12; ++y)
    for (int x = 8; x < 20; ++x)
      for (int c = 0; c < 3; ++c) sky.values[static_cast<std::size_t>((y * 64 + x) * 3 + c)] = 2;
  write_exr_image(folder / "sky.exr", sky);
  Scene scene = read_pbrt(folder.write("in.pbrt", "Film \"rgb\" WorldBegin " + triangle)).scene;
  EnvironmentLight light;
  light.filename = (folder / "sky.exr").string();
  light.projection = latitude_longitude;
  scene.lights = {{light}};
  EXPECT_TRUE(mentions(write_pbrt(scene, folder / "out.pbrt"), "resampled"));
  const auto again = std::get<EnvironmentLight>(read_pbrt(folder / "out.pbrt").scene.lights.at(0).model);
  EXPECT_EQ(again.projection, equal_area);
  const Image image = read_linear_image(again.filename);
  const auto shown = [&](double x, double y) {
    return environment_lookup(image, equal_area,
                              point_of(equal_area, direction_of(latitude_longitude, {x, y})), 0);
  };
  EXPECT_NEAR(shown(14 / 64.0, 8 / 32.0), 2, 0.05) << "in the patch";
  EXPECT_NEAR(shown(50 / 64.0, 8 / 32.0), 0, 0.05) << "across from it";
  EXPECT_NEAR(shown(14 / 64.0, 24 / 32.0), 0, 0.05) << "below it";
}

TEST(WritePbrt, AreaLights) {
  for (const char* light : {"AreaLightSource \"diffuse\" \"rgb L\" [3 2 1] \"bool twosided\" true",
                            "AreaLightSource \"diffuse\" \"blackbody L\" 3000",
                            "AreaLightSource \"diffuse\" \"spectrum L\" [400 1 700 3] \"float power\" 30",
                            "AreaLightSource \"diffuse\" \"string filename\" \"sign.png\" \"float scale\" 4"})
    expect_exact_world(light + std::string(" ") + triangle + "Translate 1 2 3 " + triangle);
}

TEST(WritePbrt, Media) {
  const std::string use = "MediumInterface \"m\" \"\" Material \"interface\" " + triangle;
  for (const char* medium :
       {"\"string type\" \"homogeneous\" \"rgb sigma_a\" [.1 .2 .3] \"rgb sigma_s\" [3 2 1] \"float g\" .3 "
        "\"float scale\" 7",
        "\"string type\" \"homogeneous\" \"string preset\" \"Ketchup\" \"rgb Le\" [1 2 3] \"float Lescale\" "
        "3",
        "\"string type\" \"uniformgrid\" \"integer nx\" 2 \"integer ny\" 1 \"integer nz\" 1 \"float "
        "density\" [.1 .2] \"point3 "
        "p1\" [2 3 4]",
        "\"string type\" \"cloud\" \"float density\" 3",
        "\"string type\" \"nanovdb\" \"string filename\" \"fire.nvdb\"",
        "\"string type\" \"rgbgrid\" \"rgb sigma_s\" [1 2 3] \"rgb sigma_a\" [.3 .2 .1]"})
    expect_exact_world("Translate 1 2 3 MakeNamedMedium \"m\" " + std::string(medium) + " " + use);
  const std::string in_fog =
      "MediumInterface \"\" \"fog\" Camera \"perspective\" Film \"rgb\" MakeNamedMedium \"fog\" \"string "
      "type\" "
      "\"homogeneous\" WorldBegin LightSource \"point\" " +
      triangle;
  expect_exact(in_fog);
  // pbrt is killed where the light stands in a vacuum and all else in a fog.
  const std::string written = round_trip(in_fog).text;
  const std::size_t world = written.find("WorldBegin"),
                    fog = written.find("MediumInterface \"\" \"fog\"", world);
  EXPECT_LT(fog, written.find("LightSource", world)) << written;
}

TEST(WritePbrt, WhatV4CannotSayIsReported) {
  const RoundTrip trip = round_trip("Film \"image\" WorldBegin Material \"matte\" \"float sigma\" 20\n" +
                                    triangle + "Material \"mirror\" " + triangle +
                                    "Material \"glass\" \"rgb Kt\" [.5 1 1] " + triangle + "WorldEnd");
  EXPECT_TRUE(mentions(trip.written, "sigma"));
  EXPECT_TRUE(mentions(trip.written, "mirror"));
  EXPECT_TRUE(mentions(trip.written, "factor of its transmission"));
  for (const Diagnostic& d : trip.written) EXPECT_GT(d.location.line, 0) << d.message;
}

// pbrt divides by the brightness of a light's spectrum: black has to be an rgb.
TEST(WritePbrt, BlackLightsAreColors) {
  const RoundTrip trip =
      round_trip("Film \"rgb\"\nWorldBegin\nLightSource \"point\" \"spectrum I\" [300 0 900 0] " + triangle);
  EXPECT_NE(trip.text.find("\"rgb I\" [ 0 0 0 ]"), std::string::npos) << trip.text;
}

TEST(WritePbrt, KindsOfMedia) {
  const std::string use = " MediumInterface \"m\" \"\" Material \"interface\" " + triangle;
  for (const char* medium :
       {"\"homogeneous\" \"rgb sigma_a\" [1 2 3] \"rgb sigma_s\" [3 2 1] \"float scale\" 2 \"float g\" .3",
        "\"homogeneous\" \"string preset\" \"Wholemilk\"",
        "\"homogeneous\" \"rgb Le\" [1 2 3] \"float Lescale\" 4",
        "\"uniformgrid\" \"integer nx\" 2 \"float density\" [1 2] \"float temperature\" [900 1000] \"float "
        "temperaturescale\" 2",
        "\"uniformgrid\" \"integer nx\" 2 \"float density\" [1 2] \"float temperature\" [900 1000] \"float "
        "Lescale\" [2 3]",
        "\"uniformgrid\" \"integer nx\" 2 \"float density\" [1 2] \"rgb Le\" [1 2 3] \"float Lescale\" [.5 "
        ".7]",
        "\"rgbgrid\" \"integer nx\" 2 \"rgb sigma_a\" [1 2 3 4 5 6] \"rgb sigma_s\" [6 5 4 3 2 1] \"float "
        "scale\" 3",
        "\"uniformgrid\" \"integer nx\" 2 \"float density\" [1 2] \"rgb Le\" [1 2 3]",
        "\"uniformgrid\" \"float density\" [1] \"rgb Le\" [1 2 3]",
        "\"rgbgrid\" \"integer nx\" 2 \"rgb sigma_a\" [1 2 3 4 5 6] \"rgb Le\" [1 2 3 4 5 6] \"float "
        "Lescale\" 2",
        "\"rgbgrid\" \"integer nx\" 2 \"rgb sigma_s\" [6 5 4 3 2 1]",
        "\"rgbgrid\" \"integer nx\" 2 \"rgb sigma_a\" [6 5 4 3 2 1]",
        "\"cloud\" \"float wispiness\" 3 \"rgb sigma_s\" [1 2 3]",
        "\"nanovdb\" \"string filename\" \"fire.nvdb\" \"float Lescale\" 3 \"float temperaturescale\" 100"})
    expect_exact_world("MakeNamedMedium \"m\" \"string type\" " + std::string(medium) + use);
}

TEST(WritePbrt, MediaHaveOnlyWhatPbrtTakesOfThem) {
  const std::string use = " MediumInterface \"m\" \"\" Material \"interface\" " + triangle;
  Scene scene = round_trip(
                    "Film \"rgb\"\nWorldBegin\nMakeNamedMedium \"m\" \"string type\" \"cloud\" \"rgb "
                    "sigma_a\" [1 2 3] " +
                    use)
                    .first.scene;
  const TemporaryFolder folder;
  const auto written = [&](auto&& change) {
    Scene changed = scene;
    change(changed.media.at(0));
    write_pbrt(changed, folder / "out.pbrt");
    EXPECT_THAT(test::pbrt_complaints(folder / "out.pbrt"), testing::IsEmpty());
    return read_pbrt(folder / "out.pbrt").scene.media.at(0);
  };
  const Medium thick = written([](Medium& m) { m.scale = 2; });
  const auto& sigma_a = std::get<AbsorptionScattering>(thick.coefficients).sigma_a;
  EXPECT_NEAR(
      luminance(std::get<Spectrum>(sigma_a)),
      2 * luminance(std::get<Spectrum>(std::get<AbsorptionScattering>(scene.media[0].coefficients).sigma_a)),
      1e-4);
  written([](Medium& m) { m.emission = ConstantSpectrum{1}; });
  written([](Medium& m) { m.coefficients = NamedMedium{"Skin1"}; });
  Grid cells;
  cells.nx = 2, cells.ny = cells.nz = 1;
  cells.values = {1, 2};
  cells.edge = GridEdge::zero;
  const Medium shining = written([&](Medium& m) {
    m.density = cells;
    m.emission = emission_from_rgb({1, 2, 3});
    m.emission_factor = 3;
  });
  EXPECT_EQ(shining.emission_scale->values, (std::vector<float>{3, 3}));
  // A coefficient that is one value beside one that is a grid.
  const Medium mixed = written([&](Medium& m) {
    m.density = {};
    m.coefficients = AbsorptionScattering{ConstantSpectrum{0.5f}, cells};
  });
  const auto& both = std::get<AbsorptionScattering>(mixed.coefficients);
  EXPECT_EQ(std::get<Grid>(both.sigma_a).values, std::vector<float>(6, 0.5f));
  EXPECT_EQ(std::get<Grid>(both.sigma_s).values, (std::vector<float>{1, 1, 1, 2, 2, 2}));
  cells.values = {-1, 2};  // which no renderer has a meaning for
  const Medium negative = written([&](Medium& m) {
    m.coefficients = AbsorptionScattering{ConstantSpectrum{0.5f}, cells};
  });
  EXPECT_EQ(std::get<Grid>(std::get<AbsorptionScattering>(negative.coefficients).sigma_s).values,
            (std::vector<float>{0, 0, 0, 2, 2, 2}));
}

}  // namespace
}  // namespace vitrail::write_pbrt_test
