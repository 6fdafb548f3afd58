// SPDX-License-Identifier: Apache-2.0
// pbrt → Scene → pbrt → Scene gives an equal Scene.
#include "importers/pbrt/write/write_pbrt.h"

#include <fstream>

#include "images/image_files.h"
#include "importers/images/environment_images.h"

#include "scene/shapes/tessellate.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "tests/conformance/gate/pbrt_grammar.h"
#include "tests/importers/curve_records.h"
#include "tests/importers/pbrt/pbrt_text.h"
#include "tests/support/equal_scenes.h"

namespace vitrail {
namespace {

struct RoundTrip {
  ImportedScene first, second;
  Diagnostics written;
  std::string text;
  std::vector<std::string> complaints;
};
RoundTrip round_trip(const std::string& text) {
  const TemporaryFolder folder;
  RoundTrip result;
  result.first = read_pbrt(folder.write("scene.pbrt", text));
  const std::filesystem::path out = folder / "out.pbrt";
  result.written = write_pbrt(result.first.scene, out);
  std::ifstream file(out);
  result.text.assign(std::istreambuf_iterator<char>(file), {});
  result.second = read_pbrt(out);
  result.complaints = test::pbrt_complaints(out);
  return result;
}

// Nothing is lost in writing, pbrt takes what is written, and what is read again is the same.
void expect_exact(const std::string& text) {
  const RoundTrip trip = round_trip(text);
  EXPECT_THAT(test::pbrt_complaints(trip.text, ""), testing::IsEmpty()) << trip.text;
  for (const Diagnostic& d : trip.written) ADD_FAILURE() << d.message;
  EXPECT_EQ(test::difference(trip.first.scene, trip.second.scene), "") << text << "\n became\n" << trip.text;
}
void expect_exact_world(const std::string& world) { expect_exact("Film \"rgb\"\nWorldBegin\n" + world); }
void expect_exact_material(const std::string& directives) { expect_exact_world(directives + " " + triangle); }

// What is written of it passes pbrt's grammar, and the report mentions it.
RoundTrip expect_reported(const std::string& world, const char* report) {
  RoundTrip trip = round_trip("Film \"rgb\"\nWorldBegin\n" + world);
  EXPECT_THAT(test::pbrt_complaints(trip.text, ""), testing::IsEmpty()) << trip.text;
  EXPECT_TRUE(mentions(trip.written, report)) << trip.text;
  return trip;
}

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
      "ObjectEnd AttributeBegin ActiveTransform EndTime Rotate 50 1 2 3 Translate 1 2 3 ActiveTransform All "
      "Scale "
      "2 1 1 ObjectInstance \"a\" AttributeEnd AttributeBegin ActiveTransform StartTime Translate 0 0 7.1 "
      "ActiveTransform All " +
      triangle + triangle + " AttributeEnd " + triangle;
  expect_exact(camera + "Film \"rgb\" \"float iso\" 250 " + world);
  expect_exact("Film \"rgb\" " + world);
  expect_exact(camera + "Film \"rgb\" WorldBegin " + triangle);
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

TEST(WritePbrt, Materials) {
  for (const char* material :
       {"Material \"diffuse\" \"rgb reflectance\" [.1 .2 .3]",
        "Material \"diffuse\" \"spectrum reflectance\" [400 .2 700 .8]",
        "Material \"diffuse\" \"float reflectance\" .3",
        "Material \"dielectric\" \"spectrum eta\" \"glass-BK7\"",
        "Material \"dielectric\" \"float eta\" 1.31 \"float uroughness\" .2 \"float vroughness\" .3",
        "Material \"thindielectric\" \"float eta\" 1.31", "Material \"conductor\" \"float roughness\" .1",
        "Material \"conductor\" \"spectrum eta\" \"metal-Au-eta\" \"spectrum k\" \"metal-Au-k\"",
        "Material \"conductor\" \"rgb reflectance\" [.9 .8 .7]",
        "Material \"coateddiffuse\" \"rgb reflectance\" [.9 .8 .7] \"float thickness\" .3 \"rgb albedo\" [.1 "
        ".2 .3]",
        "Material \"coatedconductor\" \"float conductor.roughness\" .3 \"float interface.roughness\" .1",
        "Material \"diffusetransmission\" \"rgb transmittance\" [.1 .4 .3] \"float scale\" .7",
        "Material \"subsurface\" \"string name\" \"Skin1\"",
        "Material \"subsurface\" \"rgb sigma_a\" [.1 2 3]",
        "Material \"subsurface\" \"rgb mfp\" [1 2 3] \"rgb reflectance\" [.1 .2 .3]",
        "Material \"measured\" \"string filename\" \"paper.bsdf\"", "Material \"interface\"",
        "MakeNamedMaterial \"a \\\"b\\\"\" \"string type\" \"diffuse\" MakeNamedMaterial \"c\" \"string "
        "type\" \"conductor\" "
        "Material \"mix\" \"string materials\" [\"a \\\"b\\\"\" \"c\"] \"float amount\" .3",
        "Material \"diffuse\" \"string normalmap\" \"n.png\""})
    expect_exact_material(material);
}

// The rest of what it reflects is black.
TEST(WritePbrt, MetalsTimesAFactor) {
  const TemporaryFolder folder;
  Scene scene = read_pbrt(folder.write("scene.pbrt", "Film \"rgb\"\nWorldBegin\n" + triangle)).scene;
  ConductorMaterial metal;
  metal.metal = ComplexIndex{NamedSpectrum{"metal-Au-eta"}, NamedSpectrum{"metal-Au-k"}};
  metal.roughness = {.alpha_u = 0.2f, .alpha_v = 0.2f, .masking = Masking::correlated};
  metal.reflectance_factor = reflectance_from_rgb({0.25, 0.25, 0.25});
  scene.materials = {{metal}};
  scene.materials[0].name = "gold";
  EXPECT_THAT(write_pbrt(scene, folder / "out.pbrt"), testing::IsEmpty());
  const Scene again = read_pbrt(folder / "out.pbrt").scene;
  const auto& blend = std::get<BlendMaterial>(again.materials[again.shapes[0].material.value].model);
  EXPECT_NEAR(std::get<float>(blend.amount), 0.25, 1e-6);
  EXPECT_EQ(again.materials[blend.first.value].model,
            MaterialModel(DiffuseMaterial{.reflectance = ConstantSpectrum{0}}));
  metal.reflectance_factor = ConstantSpectrum{1};
  EXPECT_EQ(again.materials[blend.second.value].model, MaterialModel(metal));
  metal.reflectance_factor = reflectance_from_rgb({0.25, 0.5, 0.25});
  scene.materials[0].model = metal;
  EXPECT_TRUE(mentions(write_pbrt(scene, folder / "out.pbrt"), "becomes grey"));
}

// Mitsuba's facets are darker.
TEST(WritePbrt, MaskingThatPbrtDoesNotHaveIsSaid) {
  const TemporaryFolder folder;
  Scene scene = read_pbrt(folder.write("scene.pbrt", "Film \"rgb\"\nWorldBegin\n" + triangle)).scene;
  DielectricMaterial glass;
  scene.materials = {{glass}};
  EXPECT_THAT(write_pbrt(scene, folder / "out.pbrt"), testing::IsEmpty()) << "smooth";
  glass.roughness = {0.2f, 0.2f};
  scene.materials = {{glass}};
  EXPECT_TRUE(mentions(write_pbrt(scene, folder / "out.pbrt"), "masking of its facets"));
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

TEST(WritePbrt, HairIsExactAndMeantForCurves) {
  for (const char* material :
       {"Material \"hair\" \"rgb reflectance\" [.1 .2 .3]", "Material \"hair\" \"float eumelanin\" .7"}) {
    const RoundTrip trip = expect_reported(material + (" " + triangle), "meant for curves");
    EXPECT_EQ(test::difference(trip.first.scene, trip.second.scene), "");
  }
  Scene scene = round_trip("Film \"rgb\"\nWorldBegin\n" + triangle).first.scene;
  HairMaterial hair;
  hair.along_v = true;
  scene.materials.at(0).model = hair;
  const TemporaryFolder folder;
  EXPECT_TRUE(mentions(write_pbrt(scene, folder / "out.pbrt"), "runs along u"));
}

TEST(WritePbrt, CurvesStayCurves) {
  const std::string type = "Shape \"curve\" \"string type\" \"cylinder\" ";
  const std::string bent = type + "\"point3 P\" [0 0 0 1 .3 0 2 1 .7 3 1 0 4 1 -.7 5 0 0 6 .1 .2] ";
  const std::string taper = "\"float width0\" .1 \"float width1\" 0 ";
  for (const std::string& world :
       {bent + "\"float width\" .3", bent + taper + "\"string basis\" \"bspline\" \"float alpha\" .5",
        "Scale 2 2 -2 " + bent + taper + bent, "ReverseOrientation " + bent + "ReverseOrientation " + bent,
        "Material \"hair\" \"float eumelanin\" 1 Scale 1 -1 1 " + bent + taper, "Scale 1 2 1 " + bent + taper,
        "ObjectBegin \"a\" " + bent + taper +
            "ObjectEnd ObjectInstance \"a\" Scale 1 2 3 ObjectInstance \"a\""}) {
    SCOPED_TRACE(world);
    const RoundTrip trip = round_trip("Film \"rgb\"\nWorldBegin\n" + world);
    EXPECT_THAT(trip.complaints, testing::IsEmpty()) << trip.text;
    for (const Diagnostic& d : trip.written) ADD_FAILURE() << d.message;
    const Scene &first = trip.first.scene, &second = trip.second.scene;
    ASSERT_EQ(first.prototypes.size(), second.prototypes.size());
    const bool in_object = !first.prototypes.empty();
    const std::vector<Shape>& before = in_object ? first.prototypes[0].shapes : first.shapes;
    const std::vector<Shape>& after = in_object ? second.prototypes[0].shapes : second.shapes;
    ASSERT_FALSE(before.empty());
    test::expect_near(test::curves_of(first, before), test::curves_of(second, after), 1e-6);
    EXPECT_EQ(before[0].opacity, after[0].opacity);
  }
}

TEST(WritePbrt, CurvesThatPbrtDoesNotHave) {
  const TemporaryFolder folder;
  const std::vector<CurvePoint> points{{{0, 0, 0}, .2}, {{1, 0, 0}, .1}, {{2, 1, 0}, .3}, {{3, 1, 1}, .1}};
  const auto written = [&](const std::vector<PlacedCurve>& curves, const char* report) {
    Scene scene = round_trip("Film \"rgb\"\nWorldBegin\n" + triangle).first.scene;
    scene.shapes = {test::add_curves(scene, curves, QuadricUv::mitsuba)};
    const Diagnostics diagnostics = write_pbrt(scene, folder / "out.pbrt");
    EXPECT_EQ(diagnostics.size(), 1u);
    EXPECT_TRUE(mentions(diagnostics, report)) << report;
    const Scene again = read_pbrt(folder / "out.pbrt").scene;
    return test::curves_of(again, again.shapes);
  };
  // Radii that are cubic: in 4 parts each, where the radius is the same within 1 %.
  const std::vector<PlacedCurve> cubic = placed_curves(bspline_segments(points), 0, 1, false, false);
  const std::vector<PlacedCurve> parts = written(cubic, "radii that are cubic");
  ASSERT_GT(parts.size(), 1u);
  CurveSegment first, second;
  halve(segment_of(cubic[0]), first, second);
  double greatest = 0, nearest = 1, radius = 0;
  for (const PlacedCurve& part : parts) {
    for (const float r : part.radius) greatest = std::max(greatest, double{r});
    const double away = length(part.origin - second[0].position);
    if (away >= nearest) continue;
    nearest = away;
    radius = double{part.radius[0]};
  }
  EXPECT_LT(nearest, 1e-6);
  EXPECT_NEAR(radius, second[0].radius, .002);
  EXPECT_NEAR(greatest, .2, .04);
  const std::vector<PlacedCurve> straight = placed_curves(linear_segments(points), 0, 1, true, true);
  const std::vector<PlacedCurve> bezier = written(straight, "in a mitre");
  ASSERT_EQ(bezier.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(bezier[i].to[2], straight[i].to[2]);
    EXPECT_EQ(bezier[i].radius[3], straight[i].radius[3]);
  }
}

TEST(WritePbrt, CurvesThatShineAreTubes) {
  expect_reported(
      "AreaLightSource \"diffuse\" Shape \"curve\" \"string type\" \"cylinder\" \"point3 P\" "
      "[0 0 0 1 0 0 2 1 0 3 1 0]",
      "tubes of triangles");
}

TEST(WritePbrt, NamesOfMaterialsSurvive) {
  const RoundTrip trip = round_trip(
      "Film \"rgb\" WorldBegin MakeNamedMaterial \"brick wall\" \"string type\" \"diffuse\" "
      "NamedMaterial \"brick wall\" " +
      triangle + "Material \"diffuse\" " + triangle);
  const Scene& scene = trip.second.scene;
  EXPECT_EQ(scene.materials.at(scene.shapes.at(0).material.value).name, "brick wall");
  EXPECT_NE(scene.materials.at(scene.shapes.at(1).material.value).name, "brick wall");
}

TEST(WritePbrt, Textures) {
  const std::string use = " Material \"diffuse\" \"texture reflectance\" \"t\" " + triangle;
  for (const char* texture :
       {"Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"tex/a b.png\" \"float uscale\" 3.3 "
        "\"string "
        "encoding\" \"gamma 1.9\"",
        "Texture \"t\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [.1 .2 .3] \"float vdelta\" .1",
        "Rotate 30 1 2 3 Texture \"t\" \"spectrum\" \"checkerboard\" \"integer dimension\" 3",
        "Translate 1 2 3 Texture \"t\" \"spectrum\" \"marble\" \"float variation\" .3 Identity",
        "Scale 3 3 3 Texture \"t\" \"spectrum\" \"bilerp\" \"string mapping\" \"spherical\" \"rgb v00\" [1 0 "
        "0]",
        "Texture \"t\" \"spectrum\" \"dots\" \"string mapping\" \"planar\" \"vector3 v1\" [1 2 3] \"float "
        "udelta\" .7",
        "Texture \"f\" \"float\" \"fbm\" Texture \"t\" \"spectrum\" \"mix\" \"rgb tex1\" [.3 .2 .1] "
        "\"texture "
        "amount\" \"f\"",
        "Texture \"f\" \"float\" \"wrinkled\" Texture \"f\" \"float\" \"scale\" \"texture tex\" \"f\" "
        "\"float scale\" 2 "
        "Texture \"t\" \"spectrum\" \"scale\" \"rgb tex\" [.3 .2 .1] \"texture scale\" \"f\"",
        "Texture \"t\" \"spectrum\" \"directionmix\" \"vector3 dir\" [1 2 3]",
        "Texture \"t\" \"spectrum\" \"ptex\" \"string filename\" \"a.ptx\""})
    expect_exact_world(texture + use);
  expect_exact_material(
      "Texture \"r\" \"float\" \"imagemap\" \"string filename\" \"r.png\" Material \"conductor\" \"texture "
      "uroughness\" \"r\" \"float vroughness\" .25 \"texture displacement\" \"r\"");
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

TEST(WritePbrt, ShapesAndInstances) {
  expect_exact_world(
      "Scale -1 1 1 " + triangle + "ReverseOrientation " + triangle +
      "Shape \"sphere\" Rotate 33 1 2 3 Shape \"loopsubdiv\" \"integer indices\" [0 1 2 0 2 3 0 3 1 1 3 2] "
      "\"point3 P\" [0 0 0 1 0 0 0 1 0 0 0 1]");
  expect_exact_world(
      "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1e-3 0.1 0 0 1 .33] \"normal N\" [0 0 1 0 1 1 0 0 3] "
      "\"point2 uv\" [.1 .2 .3 .4 .5 .6] \"float alpha\" .3");
  expect_exact_world("Shape \"trianglemesh\" \"point3 P\" [1e6 1e6 0 1000001 1e6 0 1e6 1000001.25 0]");
  expect_exact_world("ObjectBegin \"o\" Translate 1 2 3 " + triangle +
                     "Shape \"disk\" ObjectEnd ObjectInstance \"o\" "
                     "Scale -1 2 3 ObjectInstance \"o\"");
}

TEST(WritePbrt, QuadricsStayQuadrics) {
  const std::string light = "AreaLightSource \"diffuse\" ";
  for (const std::string shape :
       {"Shape \"sphere\" \"float radius\" .3", "Shape \"sphere\" \"float zmax\" .3 \"float phimax\" 77.7",
        "Shape \"disk\" \"float height\" 3 \"float radius\" .7 \"float innerradius\" .1",
        "Shape \"cylinder\" \"float radius\" .7 \"float zmin\" -.3 \"float zmax\" 1.1 \"float phimax\" 123"})
    for (const std::string placed : {"", "Translate 1 2 3 ", "Rotate 33 1 2 3 Scale .1 .1 .1 ",
                                     "Scale 1 2 3 Rotate 33 1 2 3 ", "Scale 1 -1 1 Rotate 40 0 1 0 "})
      for (const std::string side : {"", "ReverseOrientation "}) expect_exact_world(placed + side + shape);
  for (const std::string shape :
       {"Shape \"sphere\" \"float radius\" .3", "Shape \"disk\" \"float radius\" .7",
        "Shape \"cylinder\" \"float radius\" .7 \"float zmin\" 0 \"float phimax\" 123"})
    expect_exact_world("Translate 1 2 3 Rotate 90 1 0 0 " + light + "ReverseOrientation " + shape);
}

// pbrt samples lights before it transforms them.
TEST(WritePbrt, ShiningQuadricsHaveTheirOwnSize) {
  const auto written = [](const std::string& world) {
    return round_trip("Film \"rgb\"\nWorldBegin\nAreaLightSource \"diffuse\" " + world);
  };
  EXPECT_THAT(
      written("Translate 1 2 3 Scale 2 2 2 Shape \"sphere\" \"float radius\" 3").text,
      testing::HasSubstr("Transform [ 1 0 0 0 0 1 0 0 0 0 1 0 1 2 3 1 ]\n    Shape \"sphere\" \"float "
                         "radius\" [ 6 ]"));
  EXPECT_THAT(written("Scale 2 2 5 Shape \"cylinder\" \"float zmin\" 0").text,
              testing::HasSubstr("\"float radius\" [ 2 ] \"float zmin\" [ 0 ] \"float zmax\" [ 5 ]"));
  for (const char* world : {"Scale 1 2 1 Shape \"sphere\"", "Shape \"sphere\" \"float zmin\" 0",
                            "Shape \"disk\" \"float innerradius\" .5"}) {
    const RoundTrip trip = written(world);
    EXPECT_TRUE(mentions(trip.written, "becomes triangles, 256 for a full turn")) << world;
    EXPECT_FALSE(trip.second.scene.meshes.at(0).quadric) << world;
  }
}

TEST(WritePbrt, ConesAndParaboloidsBecomeTriangles) {
  const RoundTrip trip =
      round_trip("Film \"rgb\"\nWorldBegin\nShape \"cone\" Scale 2 2 2 Shape \"cone\" Shape \"paraboloid\"");
  ASSERT_EQ(trip.written.size(), 3u);
  EXPECT_TRUE(mentions(trip.written, "a cone becomes triangles, 256 for a full turn"));
  EXPECT_EQ(trip.second.scene.meshes.size(), 2u);
  EXPECT_GT(trip.second.scene.meshes.at(0).triangles.size(), 255u);
}

// What a mirrored sphere shows of a texture is what an unmirrored one of the other convention does.
TEST(WritePbrt, SpheresOfMitsubaKeepTheirTextures) {
  const TemporaryFolder folder;
  Scene scene =
      import_v4(
          "Texture \"t\" \"spectrum\" \"checkerboard\" Material \"diffuse\" \"texture reflectance\" "
          "\"t\" Shape \"sphere\" Shape \"disk\"")
          .scene;
  for (TriangleMesh& mesh : scene.meshes) mesh.quadric->uv = QuadricUv::mitsuba;
  scene.meshes[0].quadric->high = 0.5;
  const Diagnostics diagnostics = write_pbrt(scene, folder / "out.pbrt");
  EXPECT_EQ(diagnostics.size(), 1u);
  EXPECT_TRUE(mentions(diagnostics, "a disk becomes triangles"));
  const Scene again = read_pbrt(folder / "out.pbrt").scene;
  EXPECT_EQ(again.meshes.at(0).quadric, (Quadric{.kind = QuadricKind::sphere, .low = -0.5}));
  EXPECT_EQ(again.shapes.at(0).object_to_world, vitrail::scale({1, 1, -1}));
  EXPECT_TRUE(again.shapes.at(0).flip_orientation);
  EXPECT_EQ(again.meshes.at(1).uvs, tessellate(*scene.meshes[1].quadric).uvs);
  // Where no texture shows, they are what they are.
  scene.shapes[0].material = scene.shapes[1].material = Id<Material>{1};
  scene.materials.push_back({DiffuseMaterial{}});
  EXPECT_TRUE(write_pbrt(scene, folder / "out.pbrt").empty());
  EXPECT_EQ(read_pbrt(folder / "out.pbrt").scene.shapes.at(0).object_to_world, Transform{});
}

TEST(WritePbrt, OpacitiesOfShapes) {
  const std::string leaf = "Texture \"leaf\" \"float\" \"checkerboard\" ",
                    light = "AreaLightSource \"diffuse\" ";
  expect_exact_world(leaf + triangle + "\"texture alpha\" \"leaf\" Material \"interface\" " + triangle +
                     "\"float alpha\" .25 " + light + "Material \"diffuse\" " + triangle +
                     "\"float alpha\" 0");
}

// What masks take away is the alpha of the shape, wherever they stand.
class WrittenMasks : public testing::Test {
 protected:
  Id<Material> add(MaterialModel model) {
    scene_.materials.push_back(Material{std::move(model)});
    return {static_cast<std::uint32_t>(scene_.materials.size() - 1)};
  }
  Id<Texture> add_board() {
    scene_.textures.push_back({CheckerboardTexture{ConstantSpectrum{1}, ConstantSpectrum{0}}, true, "", {}});
    return {static_cast<std::uint32_t>(scene_.textures.size() - 1)};
  }
  // As it is read again.
  Shape written(Id<Material> material) {
    scene_.shapes[0].material = material;
    diagnostics_ = write_pbrt(scene_, folder_ / "out.pbrt");
    std::ifstream file(folder_ / "out.pbrt");
    text_.assign(std::istreambuf_iterator<char>(file), {});
    again_ = read_pbrt(folder_ / "out.pbrt").scene;
    return again_.shapes.at(0);
  }
  template <class Model>
  Model model_of(const Shape& shape) {
    return std::get<Model>(again_.materials.at(shape.material.value).model);
  }
  int mixes() const {
    int count = 0;
    for (auto at = text_.find("\"mix\""); at != std::string::npos; at = text_.find("\"mix\"", at + 1))
      ++count;
    return count;
  }
  float constant_opacity(const Shape& shape) { return std::get<float>(shape.opacity); }

  TemporaryFolder folder_;
  Scene scene_ = import_v4(triangle).scene, again_;
  Diagnostics diagnostics_;
  std::string text_;
  const Id<Material> dark_ = add(DiffuseMaterial{ConstantSpectrum{0.25f}}),
                     bright_ = add(DiffuseMaterial{ConstantSpectrum{0.75f}}),
                     half_ = add(MaskMaterial{0.5f, dark_});
};

TEST_F(WrittenMasks, WithinBlends) {
  scene_.settings.straight_counts = false;
  const Shape half = written(half_);
  EXPECT_EQ(constant_opacity(half), 0.5f);
  EXPECT_EQ(model_of<DiffuseMaterial>(half).reflectance, SpectrumParameter{ConstantSpectrum{0.25f}});
  EXPECT_TRUE(diagnostics_.empty());

  // ¾·½ of the dark one and ¼ of the bright one are there: 5/8, of which 2/5 are bright.
  const Shape blend = written(add(BlendMaterial{half_, bright_, 0.25f}));
  EXPECT_FLOAT_EQ(constant_opacity(blend), 0.625f);
  EXPECT_FLOAT_EQ(std::get<float>(model_of<BlendMaterial>(blend).amount), 0.4f);
  EXPECT_TRUE(diagnostics_.empty());

  // A texture that chooses between something and nothing is an alpha.
  const Id<Texture> board = add_board();
  const Id<Material> nothing = add(InterfaceMaterial{});
  const Shape cut = written(add(BlendMaterial{nothing, dark_, board}));
  EXPECT_EQ(model_of<DiffuseMaterial>(cut).reflectance, SpectrumParameter{ConstantSpectrum{0.25f}});
  EXPECT_EQ(cut.opacity, FloatParameter{board});
  EXPECT_TRUE(diagnostics_.empty());
  EXPECT_EQ(mixes(), 1) << "that of the first blend: pbrt refuses a mix with an interface";

  written(add(BlendMaterial{half_, bright_, board}));
  EXPECT_TRUE(mentions(diagnostics_, "masks within a blend by textures"));
}

TEST_F(WrittenMasks, TimesTheShapesOwnOpacity) {
  scene_.shapes[0].opacity = 0.5f;
  EXPECT_EQ(constant_opacity(written(half_)), 0.25f);
  scene_.shapes[0].opacity = add_board();
  const Shape both = written(half_);
  const auto& product =
      std::get<ProductTexture>(again_.textures.at(std::get<Id<Texture>>(both.opacity).value).model);
  EXPECT_EQ(product.second, SpectrumParameter{ConstantSpectrum{0.5f}});
}

TEST_F(WrittenMasks, CountForNoDepthInPbrt) {
  written(half_);
  EXPECT_TRUE(mentions(diagnostics_, "the depth"));
  scene_.settings.max_depth = unlimited_depth;
  written(half_);
  EXPECT_FALSE(mentions(diagnostics_, "the depth"));
  scene_.settings.max_depth = 5;
  scene_.settings.straight_counts = false;
  written(half_);
  EXPECT_FALSE(mentions(diagnostics_, "the depth"));
  add(ThinDielectricMaterial{});
  written(half_);
  EXPECT_TRUE(mentions(diagnostics_, "going straight through thin sheets"));
  EXPECT_FALSE(mentions(diagnostics_, "without extent"));
  scene_.lights.push_back({PointLight{}, {}});
  written(half_);
  EXPECT_TRUE(mentions(diagnostics_, "lights without extent do not shine through thin sheets"));
}

TEST_F(WrittenMasks, BlendsWithNothingCountForNoDepthInPbrt) {
  scene_.materials.at(half_.value).model = DiffuseMaterial{};
  const Id<Material> nothing = add(InterfaceMaterial{});
  const Shape blend = written(add(BlendMaterial{nothing, dark_, 0.5f}));
  EXPECT_EQ(constant_opacity(blend), 0.5f);
  EXPECT_TRUE(mentions(diagnostics_, "the depth"));
}

// A mask leaves the light of a surface alone, an alpha does not; and pbrt drops the lights of interfaces.
TEST_F(WrittenMasks, OfWhatShines) {
  scene_.settings.max_depth = unlimited_depth;
  scene_.settings.straight_counts = false;
  scene_.area_lights.push_back({ConstantSpectrum{1}});
  scene_.shapes[0].area_light = Id<AreaLight>{0};
  const Shape nothing = written(add(InterfaceMaterial{}));
  EXPECT_EQ(constant_opacity(nothing), 1);
  EXPECT_TRUE(nothing.area_light);
  EXPECT_EQ(model_of<ThinDielectricMaterial>(nothing).eta, Spectrum{ConstantSpectrum{1}});
  const Shape half = written(half_);
  EXPECT_EQ(constant_opacity(half), 1);
  const auto mix = model_of<BlendMaterial>(half);
  EXPECT_EQ(mix.amount, FloatParameter{0.5f});
  EXPECT_TRUE(std::holds_alternative<ThinDielectricMaterial>(again_.materials.at(mix.first.value).model));
  EXPECT_TRUE(diagnostics_.empty());
  scene_.settings.max_depth = 5;
  written(half_);
  EXPECT_TRUE(mentions(diagnostics_, "counts for the depth"));
  scene_.lights.push_back({PointLight{}, {}});
  written(half_);
  EXPECT_TRUE(mentions(diagnostics_, "lights without extent"));
}

TEST_F(WrittenMasks, BumpsOfWhatIsMadeOfOthersAreReported) {
  const Id<Material> blend = add(BlendMaterial{dark_, bright_, 0.25f});
  scene_.materials[blend.value].displacement = Id<Texture>{add_board()};
  written(blend);
  EXPECT_TRUE(mentions(diagnostics_, "bumps"));
  EXPECT_EQ(text_.find("displacement"), std::string::npos) << "pbrt refuses a mix with one";
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
  expect_exact(
      "MediumInterface \"\" \"fog\" Camera \"perspective\" Film \"rgb\" MakeNamedMedium \"fog\" \"string "
      "type\" "
      "\"homogeneous\" WorldBegin " +
      triangle);
}

TEST(WritePbrt, WhatV4CannotSayIsReported) {
  const RoundTrip trip = round_trip("Film \"image\" WorldBegin Material \"matte\" \"float sigma\" 20\n" +
                                    triangle + "Material \"mirror\" " + triangle +
                                    "Material \"glass\" \"rgb Kt\" [.5 1 1] " + triangle + "WorldEnd");
  EXPECT_TRUE(mentions(trip.written, "sigma"));
  EXPECT_TRUE(mentions(trip.written, "mirror"));
  EXPECT_TRUE(mentions(trip.written, "factors of reflection"));
  for (const Diagnostic& d : trip.written) EXPECT_GT(d.location.line, 0) << d.message;
}

TEST(WritePbrt, MaterialsHaveOnlyWhatPbrtTakesOfThem) {
  expect_reported(
      "Texture \"h\" \"float\" \"windy\" Material \"hair\" \"texture displacement\" \"h\" " + triangle,
      "bumps of hair");
  const RoundTrip wax =
      expect_reported("Material \"subsurface\" \"spectrum eta\" \"glass-BK7\" " + triangle, "dispersion");
  EXPECT_NEAR(evaluate(std::get<SubsurfaceMaterial>(wax.second.scene.materials.at(0).model).eta, 500), 1.5168,
              1e-3);
  Scene scene = round_trip("Film \"rgb\"\nWorldBegin\n" + triangle).first.scene;
  PrincipledMaterial sheet;
  sheet.thin = true, sheet.spec_trans = 1.0f;
  scene.materials.at(0).model = sheet;
  const TemporaryFolder folder;
  EXPECT_TRUE(mentions(write_pbrt(scene, folder / "out.pbrt"), "thin glass"));
  EXPECT_THAT(test::pbrt_complaints(folder / "out.pbrt"), testing::IsEmpty());
}

// pbrt has noise of numbers and marble of colours: a colour by noise is a mix of black and white.
TEST(WritePbrt, NoiseIsOfTheKindThatPbrtHas) {
  expect_exact_material(
      "Texture \"w\" \"float\" \"windy\" Material \"conductor\" \"texture roughness\" \"w\"");
  for (const char* kind : {"fbm", "wrinkled", "windy"}) {
    const RoundTrip trip =
        round_trip("Film \"rgb\"\nWorldBegin\nTranslate 1 2 3 Texture \"t\" \"spectrum\" \"" +
                   std::string(kind) + "\" Material \"diffuse\" \"texture reflectance\" \"t\" " + triangle);
    EXPECT_THAT(trip.written, testing::IsEmpty());
    EXPECT_THAT(test::pbrt_complaints(trip.text, ""), testing::IsEmpty()) << trip.text;
    const std::vector<Texture>& textures = trip.second.scene.textures;
    ASSERT_EQ(textures.size(), 2u);
    EXPECT_EQ(textures[0].model, trip.first.scene.textures.at(0).model) << kind;
    EXPECT_EQ(std::get<MixTexture>(textures[1].model).amount, FloatParameter{Id<Texture>{0}});
  }
  expect_reported(
      "Texture \"m\" \"float\" \"marble\" Material \"conductor\" \"texture roughness\" \"m\" " + triangle,
      "marble of numbers");
}

TEST(WritePbrt, TexturesHaveOnlyWhatPbrtTakesOfThem) {
  const std::string use = " Material \"diffuse\" \"texture reflectance\" \"t\" " + triangle;
  const RoundTrip bright =
      expect_reported("Texture \"t\" \"spectrum\" \"mix\" \"rgb tex1\" [3 2 1]" + use, "colours above 1");
  const auto& mix = std::get<MixTexture>(bright.second.scene.textures.at(0).model);
  EXPECT_NEAR(
      luminance(std::get<Spectrum>(mix.first)),
      luminance(std::get<Spectrum>(std::get<MixTexture>(bright.first.scene.textures.at(0).model).first)),
      1e-4);
  expect_reported(
      "Texture \"f\" \"spectrum\" \"dots\" Texture \"t\" \"spectrum\" \"bilerp\" \"texture v00\" \"f\"" + use,
      "corner");
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
}

// pbrt leaves out area lights in objects.
TEST(WritePbrt, WhatShinesInAnObjectIsWrittenWithEveryInstance) {
  Scene scene = round_trip("Film \"rgb\"\nWorldBegin\nObjectBegin \"o\" " + triangle + triangle +
                           "ObjectEnd ObjectInstance \"o\" Scale -1 2 1 ObjectInstance \"o\"")
                    .first.scene;
  scene.area_lights.push_back({Spectrum{emission_from_rgb({1, 1, 1})}});
  scene.prototypes.at(0).shapes.at(1).area_light = Id<AreaLight>{0};
  const TemporaryFolder folder;
  EXPECT_TRUE(mentions(write_pbrt(scene, folder / "out.pbrt"), "instances no area lights"));
  EXPECT_THAT(test::pbrt_complaints(folder / "out.pbrt"), testing::IsEmpty());
  const Scene again = read_pbrt(folder / "out.pbrt").scene;
  EXPECT_EQ(again.prototypes.at(0).shapes.size(), 1u);
  ASSERT_EQ(again.shapes.size(), 2u);
  EXPECT_TRUE(again.shapes[0].area_light && again.shapes[1].area_light);
  EXPECT_EQ(again.shapes[1].object_to_world, scale({-1, 2, 1}));
  EXPECT_TRUE(again.shapes[1].flip_orientation);  // its front stays where it was in the object
}

}  // namespace
}  // namespace vitrail
