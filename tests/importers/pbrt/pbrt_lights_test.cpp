// SPDX-License-Identifier: Apache-2.0
// What a pixel that sees a light shows, and where lights are, in v3 and v4.
#include <fmt/format.h>

#include <fstream>

#include "images/image_files.h"
#include "scene/geometry/pi.h"
#include "scene/spectra/color.h"
#include "scene/spectra/named_spectra.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "tests/importers/pbrt/pbrt_text.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::pbrt_lights_test {
namespace {

Spectrum infinite(const ImportedScene& imported) {
  return std::get<InfiniteLight>(imported.scene.lights.at(0).model).radiance;
}
Spectrum infinite_v4(const std::string& parameters) {
  return infinite(import_v4("LightSource \"infinite\" " + parameters));
}
Spectrum infinite_v3(const std::string& parameters) {
  return infinite(import_v3("LightSource \"infinite\" " + parameters));
}

void expect_color(const Spectrum& spectrum, RGB expected, double tolerance) {
  const RGB found = xyz_to_srgb(to_xyz(spectrum));
  EXPECT_NEAR(found.r, expected.r, tolerance);
  EXPECT_NEAR(found.g, expected.g, tolerance);
  EXPECT_NEAR(found.b, expected.b, tolerance);
}

TEST(PbrtEmission, OfRgbIsWhatThePixelShowsInBothVersions) {
  for (const char* type : {"rgb", "color"}) {
    const std::string parameters = std::string("\"") + type + " L\" [2 1 .5]";
    expect_color(infinite_v4(parameters), {2, 1, .5}, 2e-2);
    expect_color(infinite_v3(parameters), {2, 1, .5}, 2e-2);
  }
  EXPECT_NEAR(luminance(infinite_v4("\"rgb L\" [3 3 3]")), 3, 1e-3);
  EXPECT_NEAR(luminance(infinite_v4("")), 1, 1e-3);
  EXPECT_NEAR(luminance(infinite_v3("")), 1, 1e-3);
}

// v4 refuses others, as v3 takes longitude and latitude.
TEST(PbrtLights, ImagesOfAllDirectionsAreSquareInV4) {
  const TemporaryFolder folder;
  folder.write("wide.pfm", "PF\n2 1\n-1\n" + std::string(24, '\0'));
  folder.write("square.pfm", "PF\n1 1\n-1\n" + std::string(12, '\0'));
  const auto import = [&](const std::string& kind, const char* image, const char* film) {
    return read_pbrt(folder.write(
        "s.pbrt",
        fmt::format("{} WorldBegin\nLightSource \"{}\" \"string filename\" \"{}.pfm\"", film, kind, image)));
  };
  for (const char* const kind : {"infinite", "goniometric"}) {
    EXPECT_EQ(import(kind, "wide", "Film \"image\"").scene.lights.size(), 1u);
    for (const char* const film : {"Film \"rgb\"", ""}) {
      EXPECT_EQ(import(kind, "square", film).scene.lights.size(), 1u);
      try {
        import(kind, "wide", film);
        ADD_FAILURE() << kind << " " << film;
      } catch (const Error& error) {
        EXPECT_EQ(error.location.line, 2);
        EXPECT_THAT(error.what(), testing::HasSubstr("2 × 1 pixels"));
        EXPECT_THAT(error.what(), testing::HasSubstr("imgtool makeequiarea"));
        EXPECT_EQ(std::string(error.what()).find("WorldEnd") != std::string::npos, *film == '\0');
      }
    }
  }
}

TEST(PbrtEmission, OfXyzIsConverted) {
  expect_color(infinite_v3("\"xyz L\" [.95047 1 1.08883]"), {1, 1, 1}, 1e-2);
}

TEST(PbrtEmission, OfSpectraHasUnitLuminanceTimesScaleInV4) {
  for (const char* samples : {"[360 1 830 1]", "[360 7 830 7]", "[400 0 500 8 600 15.6 700 18.4]"})
    EXPECT_NEAR(luminance(infinite_v4(std::string("\"spectrum L\" ") + samples + " \"float scale\" 2.5")),
                2.5, 1e-5);
  EXPECT_NEAR(luminance(infinite_v4("\"spectrum L\" \"stdillum-D65\" \"float scale\" .5")), .5, 1e-5);
  EXPECT_NEAR(luminance(infinite_v4("\"blackbody L\" [5000 3]")), 1, 1e-5);
  EXPECT_NEAR(luminance(infinite_v4("\"float L\" 4")), 4, 1e-5);
}

TEST(PbrtEmission, OfFluorescentLampsIsTheirSpectrum) {
  const Spectrum lamp = infinite_v4("\"spectrum L\" \"stdillum-F11\"");
  const Spectrum f11 = *named_spectrum("stdillum-F11");
  for (const double nm : {435.0, 545.0, 560.0, 610.0})
    EXPECT_NEAR(evaluate(lamp, nm), evaluate(f11, nm), 1e-5) << nm;
}

TEST(PbrtEmission, OfSpectraIsAbsoluteInV3) {
  EXPECT_NEAR(luminance(infinite_v3("\"spectrum L\" [360 7 830 7]")), 7, 1e-5);
  EXPECT_NEAR(luminance(infinite_v3("\"spectrum L\" [830 7 360 7]")), 7, 1e-5) << "v3 sorts samples";
  EXPECT_NEAR(luminance(infinite_v3("\"blackbody L\" [5000 3]")), 3 * luminance(blackbody(5000)), 1e-4);
  EXPECT_NEAR(luminance(infinite_v3("\"rgb L\" [1 1 1] \"rgb scale\" [2 2 2]")), 2, 1e-3);
}

TEST(PbrtEmission, IsZeroOutsideOfSamplesInV4AndHeldInV3) {
  const std::string samples = "\"spectrum L\" [500 1 600 1]";
  EXPECT_EQ(evaluate(infinite_v4(samples), 450), 0);
  EXPECT_GT(evaluate(infinite_v4(samples), 550), 0);
  EXPECT_EQ(evaluate(infinite_v3(samples), 450), 1);
}

TEST(PbrtEmission, MayComeFromFiles) {
  const TemporaryFolder folder;
  folder.write("lamp.spd", "# nm value\n400 1\n700 three");
  EXPECT_THROW(read_pbrt(folder.write(
                   "s.pbrt", "Film \"rgb\" WorldBegin LightSource \"infinite\" \"spectrum L\" \"lamp.spd\"")),
               Error);
  folder.write("lamp.spd", "# nm value\n400 1\n700 3");
  const Spectrum v3 = infinite(read_pbrt(folder.write(
      "s.pbrt", "Film \"image\" WorldBegin LightSource \"infinite\" \"spectrum L\" \"lamp.spd\" WorldEnd")));
  EXPECT_NEAR(evaluate(v3, 550), 2, 1e-5);
}

TEST(PbrtEmission, OfAFileThatIsNeitherV3NorV4IsReported) {
  EXPECT_TRUE(mentions(
      import_text("WorldBegin LightSource \"infinite\" \"spectrum L\" [360 7 830 7] " + triangle).diagnostics,
      "nothing tells whether"));
}

TEST(PbrtEmission, OutsideOfSrgbIsReported) {
  EXPECT_TRUE(
      mentions(import_v4("ColorSpace \"rec2020\" LightSource \"infinite\" \"rgb L\" [0 1 0]").diagnostics,
               "outside linear sRGB"));
  EXPECT_FALSE(mentions(
      import_v4("ColorSpace \"rec2020\" LightSource \"infinite\" \"rgb L\" [1 1 1]").diagnostics, "outside"));
}

TEST(PbrtLights, PointsHaveThePowerTheyAreGiven) {
  const auto intensity = [](const std::string& parameters) {
    return luminance(
        std::get<PointLight>(import_v4("LightSource \"point\" " + parameters).scene.lights.at(0).model)
            .intensity);
  };
  EXPECT_NEAR(intensity("\"rgb I\" [2 2 2]"), 2, 1e-3);
  EXPECT_NEAR(intensity("\"blackbody I\" [2700] \"float power\" 40"), 40 / (4 * pi), 1e-5);
  EXPECT_NEAR(intensity("\"rgb I\" [2 2 2] \"float power\" 40 \"float scale\" 3"), 2 * 3 * 40 / (4 * pi),
              1e-2);
}

TEST(PbrtLights, PointsStandWhereTheirVersionPutsThem) {
  const std::string world = "Scale 2 2 2 Translate 10 0 0 LightSource \"point\" \"point3 from\" [1 0 0]";
  EXPECT_EQ(std::get<PointLight>(import_v4(world).scene.lights.at(0).model).position, (Point3d{22, 0, 0}));
  EXPECT_EQ(std::get<PointLight>(import_v3(world).scene.lights.at(0).model).position, (Point3d{21, 0, 0}));
}

TEST(PbrtLights, DistantOnesGoFromFromToTo) {
  const auto light = [](const std::string& world) {
    return std::get<DistantLight>(import_v4(world).scene.lights.at(0).model);
  };
  EXPECT_EQ(light("LightSource \"distant\"").direction, (Vector3d{0, 0, 1}));
  EXPECT_EQ(light("LightSource \"distant\" \"point3 from\" [0 5 0] \"point3 to\" [0 1 0]").direction,
            (Vector3d{0, -1, 0}));
  const Vector3d turned =
      light("Rotate 90 0 0 1 LightSource \"distant\" \"point3 from\" [-2 0 0] \"point3 to\" [0 0 0]")
          .direction;
  EXPECT_NEAR(turned.y, 1, 1e-12);
  EXPECT_NEAR(
      luminance(light("LightSource \"distant\" \"spectrum L\" \"stdillum-D65\" \"float illuminance\" [.5]")
                    .irradiance),
      .5, 1e-5);
  EXPECT_NEAR(luminance(light("LightSource \"distant\" \"rgb L\" [2 2 2] \"float scale\" 3").irradiance), 6,
              1e-2);
}

TEST(PbrtLights, InfiniteOnesHaveTheIlluminanceTheyAreGiven) {
  EXPECT_NEAR(luminance(infinite_v4("\"float illuminance\" 2")), 2 / pi, 1e-3);
}

TEST(PbrtLights, ImagesOfEnvironmentsAreKept) {
  const ImportedScene imported = import_v4(
      "Rotate 90 0 0 1 LightSource \"infinite\" \"string filename\" \"sky.exr\" \"float scale\" 2 \"float "
      "illuminance\" 7");
  const auto& light = std::get<EnvironmentLight>(imported.scene.lights.at(0).model);
  EXPECT_EQ(light.projection, EnvironmentLight::Projection::equal_area);
  EXPECT_EQ(light.scale, Spectrum{ConstantSpectrum{2}});
  EXPECT_EQ(light.illuminance, 14.0f) << "pbrt-v4 shows twice what is asked for";
  EXPECT_EQ(*light.light_to_world, rotate(pi / 2, {0, 0, 1}));
  EXPECT_EQ(std::filesystem::path(light.filename).filename(), "sky.exr");
  const auto v3 = import_v3("LightSource \"infinite\" \"string mapname\" \"sky.exr\" \"rgb L\" [2 2 2]");
  const auto& old = std::get<EnvironmentLight>(v3.scene.lights.at(0).model);
  EXPECT_EQ(old.projection, EnvironmentLight::Projection::latitude_longitude);
}

TEST(PbrtLights, PortalsStandWhereTheTransformPutsThem) {
  const ImportedScene imported = import_v4(
      "Translate 10 20 30 LightSource \"infinite\" \"string filename\" \"sky.exr\" "
      "\"point3 portal\" [1 2 3 4 5 6 7 8 9 10 11 12]");
  EXPECT_EQ(std::get<EnvironmentLight>(imported.scene.lights.at(0).model).portal->value(),
            (std::array<Point3d, 4>{{{11, 22, 33}, {14, 25, 36}, {17, 28, 39}, {20, 31, 42}}}));
}

TEST(PbrtLights, ProjectionsKeepPowerAndScaleApart) {
  const ImportedScene imported = import_v4(
      "LightSource \"projection\" \"string filename\" \"slide.exr\" \"float power\" 50 \"float scale\" 3");
  const auto& light = std::get<ProjectionLight>(imported.scene.lights.at(0).model);
  EXPECT_EQ(light.power, 50.0f);
  EXPECT_EQ(light.scale, Spectrum{ConstantSpectrum{3}});
}

// They are lit by D65; v3's L is an rgb that multiplies them.
TEST(PbrtLights, ImagesAreLitOnce) {
  const auto scale = [](const std::string& parameters) {
    const ImportedScene imported =
        import_v3("LightSource \"infinite\" \"string mapname\" \"sky.exr\" " + parameters);
    return std::get<EnvironmentLight>(imported.scene.lights.at(0).model).scale;
  };
  EXPECT_EQ(scale(""), Spectrum{ConstantSpectrum{1}});
  EXPECT_EQ(scale("\"rgb L\" [1 1 1]"), Spectrum{ConstantSpectrum{1}});
  EXPECT_EQ(scale("\"rgb L\" [2 1 .5]"), unbounded_from_rgb({2, 1, 0.5}));
  EXPECT_EQ(scale("\"rgb scale\" [2 1 .5]"), unbounded_from_rgb({2, 1, 0.5}));
  const Spectrum warm = scale("\"blackbody L\" [3000 1]");
  const RGB seen = xyz_to_srgb(to_xyz(product(warm, NamedSpectrum{"stdillum-D65"}))),
            direct = xyz_to_srgb(to_xyz(infinite_v3("\"blackbody L\" [3000 1]")));
  EXPECT_NEAR(seen.g / seen.r, direct.g / direct.r, 0.02);
}

TEST(PbrtLights, SpotsKeepTheirCone) {
  const ImportedScene imported = import_v4(
      "LightSource \"spot\" \"point3 from\" [1 2 3] \"point3 to\" [1 2 9] \"rgb I\" [2 2 2] \"float "
      "coneangle\" 40 "
      "\"float conedeltaangle\" 10");
  expect_no_diagnostics(imported);
  const auto& spot = std::get<SpotLight>(imported.scene.lights.at(0).model);
  EXPECT_EQ(*spot.light_to_world, translate({1, 2, 3})) << "along +z the frame is the identity, bit for bit";
  EXPECT_EQ(spot.cutoff_deg, 40);
  EXPECT_EQ(spot.beam_deg, 30);
  EXPECT_EQ(spot.intensity, Spectrum{emission_from_rgb({2, 2, 2})});
  const auto turned = import_v4("LightSource \"spot\" \"point3 from\" [1 2 3] \"point3 to\" [-1 5 2.5]");
  const Transform& t = std::get<SpotLight>(turned.scene.lights.at(0).model).light_to_world;
  const Vector3d z = transform_vector(t, {0, 0, 1}), way = normalize(Vector3d{-2, 3, -.5});
  EXPECT_NEAR(length(z - way), 0, 1e-15);
  EXPECT_NEAR(determinant3(t), 1, 1e-14);
}

// Every pbrt reads "conedeltaangle" alone, and without it takes 5 degrees.
TEST(PbrtLights, NoOtherNameHasTheWidthOfASpotsEdge) {
  const ImportedScene imported = import_v3("LightSource \"spot\" \"float conedelta\" 20");
  EXPECT_EQ(std::get<SpotLight>(imported.scene.lights.at(0).model).beam_deg, 25);
  EXPECT_TRUE(mentions(imported.diagnostics, "conedelta"));
}

TEST(PbrtLights, UnknownKindsAreReported) {
  const ImportedScene unknown = import_v4("LightSource \"pont\"");
  EXPECT_TRUE(unknown.scene.lights.empty());
  EXPECT_TRUE(mentions(unknown.diagnostics, "did you mean \"point\""));
}

// ---- Area lights
// ----------------------------------------------------------------------------------------------------

const std::string square =
    "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 1 1 0 0 1 0] \"integer indices\" [0 1 2 0 2 3]\n";

double area_radiance(const ImportedScene& imported) {
  return luminance(std::get<Spectrum>(
      imported.scene.area_lights.at(imported.scene.shapes.at(0).area_light.value().value).radiance));
}

TEST(PbrtAreaLights, AreSharedByTheShapesThatFollow) {
  const ImportedScene imported =
      import_v3("AreaLightSource \"area\" \"rgb L\" [17 12 4] \"integer nsamples\" 4 " + square + square);
  expect_no_diagnostics(imported);
  ASSERT_EQ(imported.scene.area_lights.size(), 1u);
  EXPECT_EQ(imported.scene.shapes[1].area_light, imported.scene.shapes[0].area_light);
  expect_color(std::get<Spectrum>(imported.scene.area_lights[0].radiance), {17, 12, 4}, .2);
  EXPECT_FALSE(imported.scene.area_lights[0].two_sided);
}

TEST(PbrtAreaLights, DivideTheirPowerByTheirArea) {
  const std::string light =
      "Scale 3 3 3 AreaLightSource \"diffuse\" \"blackbody L\" [4000] \"float power\" 10 ";
  // pbrt makes two shapes of the square, each of half its area and with the whole power.
  EXPECT_NEAR(area_radiance(import_v4(light + square)), 10 / (pi * 9 / 2), 1e-4);
  EXPECT_NEAR(area_radiance(import_v4(light + "\"bool twosided\" true " + square)), 10 / (2 * pi * 9 / 2),
              1e-4);
  EXPECT_NEAR(
      area_radiance(import_v4(light + "Shape \"bilinearmesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0 1 1 0]")),
      10 / (pi * 9), 1e-4);
  EXPECT_NEAR(area_radiance(import_v4(light + "Shape \"disk\"")) / (10 / (pi * pi * 9)), 1, 1e-4);
  EXPECT_NEAR(
      area_radiance(import_v4(light + "Shape \"curve\" \"string type\" \"ribbon\" \"normal N\" [0 0 1 0 0 1] "
                                      "\"point3 P\" [0 0 0 1 0 0 2 0 0 3 0 0] \"float width\" 2")),
      10 / (pi * 9 * 6), 1e-4);
  const ImportedScene several = import_v4(light + square + "Shape \"disk\"");
  EXPECT_EQ(several.scene.area_lights.size(), 2u);
}

// By the mean of all of its pixels, as in pbrt-v4: one of 40 × 30 is bright.
TEST(PbrtAreaLights, DivideTheirPowerByTheMeanOfTheirImage) {
  const test::TemporaryDirectory directory;
  Image image{40, 30, 3, std::vector<float>(40 * 30 * 3, 0.0f)};
  for (std::size_t c = 0; c < 3; ++c) image.values[3 * (17 * 40 + 23) + c] = 5;
  write_exr_image(directory / "lamp.exr", image);
  const ImportedScene imported =
      import_v4("Scale 3 3 3 AreaLightSource \"diffuse\" \"string filename\" \"" +
                (directory / "lamp.exr").string() + "\" \"float power\" 10 \"float scale\" 2 Shape \"disk\"");
  const double mean = 5.0 / (40 * 30);
  EXPECT_NEAR(static_cast<double>(imported.scene.area_lights.at(0).scale) / (2 * 10 / (pi * pi * 9) / mean),
              1, 1e-4);
}

TEST(PbrtAreaLights, DoNotShineOnInterfaces) {
  const ImportedScene imported = import_v4("Material \"interface\" AreaLightSource \"diffuse\" " + square);
  EXPECT_FALSE(imported.scene.shapes[0].area_light);
  EXPECT_TRUE(mentions(imported.diagnostics, "does not shine"));
}

}  // namespace
}  // namespace vitrail::pbrt_lights_test
