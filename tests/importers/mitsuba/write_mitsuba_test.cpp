// SPDX-License-Identifier: Apache-2.0
// The text that the Mitsuba writer makes. What Mitsuba makes of it: mitsuba_oracle.h.
#include "importers/mitsuba/write/write_mitsuba.h"

#include <gmock/gmock.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>

#include "importers/mitsuba/read/mitsuba.h"
#include "importers/mitsuba/write/write_camera.h"
#include "tests/importers/curve_records.h"
#include "tests/importers/mitsuba/write_mitsuba_fixture.h"
#include "tests/importers/temporary_folder.h"
#include "tests/importers/written_scenes.h"

namespace vitrail::write_mitsuba_test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

// ---- The file

TEST_F(WriteMitsuba, HeaderOrderAndFiles) {
  Scene scene = square_scene({});
  scene.lights.push_back({PointLight{{1, 2, 3}, ConstantSpectrum{1}}, {}});
  const auto root = write(scene);
  EXPECT_THAT(text_, HasSubstr("written by Vitrail 0."));
  std::vector<std::string> tags;
  for (const auto child : root) tags.emplace_back(child.name());
  EXPECT_THAT(tags, ElementsAre("integrator", "sensor", "bsdf", "emitter", "shape"));
  EXPECT_STREQ(root.attribute("version").value(), "3.0.0");
  EXPECT_EQ(value(root.child("shape"), "filename"), "scene-meshes/000000.ply");
  EXPECT_TRUE(std::filesystem::exists(folder_ / "scene-meshes/000000.ply"));
  EXPECT_THAT(diagnostics_, IsEmpty());
}

TEST_F(WriteMitsuba, EqualScenesGiveEqualFiles) {
  const Scene scene = square_scene({});
  write(scene);
  const std::string first = text_;
  write(scene);
  EXPECT_EQ(text_, first);
}

TEST_F(WriteMitsuba, NamesAreEscapedAndUnique) {
  const std::string name = "a <b> & \"c\" 'd' ü\n\t";
  Scene scene = square_scene({});
  scene.materials[0].name = name;
  scene.shapes[0].name = name;
  const auto root = write(scene);
  EXPECT_EQ(root.child("bsdf").attribute("id").value(), name);
  EXPECT_EQ(reference(root.child("shape"), "bsdf"), name);
  EXPECT_EQ(root.child("shape").attribute("id").value(), name + "_2");
  EXPECT_THAT(diagnostics_, approximates("another record has it already"));
  scene.materials[0].name = "$x";
  EXPECT_THAT(write(scene).child("bsdf").attribute("id").value(), StartsWith("_unnamed_"));
}

TEST_F(WriteMitsuba, DiagnosticsSayWhere) {
  Scene scene = square_scene({});
  scene.files = {"a.pbrt"};
  scene.materials[0].model = CoatedDiffuseMaterial{};
  scene.materials[0].origin = {0, 7, 3};
  write(scene);
  ASSERT_THAT(diagnostics_, SizeIs(1));
  EXPECT_EQ(to_string(diagnostics_[0].location), "a.pbrt:7:3");
  EXPECT_EQ(to_string(diagnostics_[0].item), "a.pbrt:7:3");
}

// ---- Numbers

TEST_F(WriteMitsuba, NumbersAreBitExact) {
  Scene scene = square_scene({});
  const double awkward = 0.1 + 0.2, tiny = 4.9e-324;
  scene.shapes[0].object_to_world.m[0] = {awkward, tiny, -1.0 / 3, 1e300};
  scene.lights.push_back({PointLight{{awkward, -0.0, 1e-17}, ConstantSpectrum{0.1f}}, {}});
  const auto root = write(scene);
  std::istringstream matrix(
      root.child("shape").child("transform").child("matrix").attribute("value").value());
  for (const double expected : scene.shapes[0].object_to_world.m[0]) {
    std::string word;
    matrix >> word;
    EXPECT_EQ(std::strtod(word.c_str(), nullptr), expected) << word;
  }
  EXPECT_EQ(root.child("emitter").child("point").attribute("x").as_double(), awkward);
  EXPECT_EQ(value(root.child("emitter"), "intensity"), "0.1");
}

TEST_F(WriteMitsuba, EverythingIsFinite) {
  Scene scene = square_scene({});
  auto& camera = std::get<PerspectiveCamera>(scene.camera);
  camera.lens = {0.1, std::numeric_limits<double>::infinity()};
  write(scene);
  EXPECT_EQ(text_.find("inf"), std::string::npos);
  EXPECT_EQ(text_.find("nan"), std::string::npos);
}

TEST_F(WriteMitsuba, AnglesOfViewComeBackExactly) {
  const auto half_width = [](double fov) { return std::tan(fov / 2 * std::numbers::pi / 180); };
  for (const double fov : {90.0, 45.0, 39.3077, 1e-3, 179.5, 20.114292}) {
    EXPECT_EQ(mitsuba_writer::field_of_view_deg(half_width(fov)), fov);
  }
  int exact = 0;
  for (int i = 1; i <= 1000; ++i) {
    const double fov = 0.1739 * i;
    exact += half_width(mitsuba_writer::field_of_view_deg(half_width(fov))) == half_width(fov);
  }
  EXPECT_EQ(exact, 1000);
}

// ---- Spectra

TEST_F(WriteMitsuba, Spectra) {
  const auto reflectance = [&](const Spectrum& spectrum) {
    return write_material(DiffuseMaterial{spectrum}).find_child_by_attribute("name", "reflectance");
  };
  EXPECT_STREQ(reflectance(ConstantSpectrum{0.25f}).attribute("value").value(), "0.25");
  EXPECT_STREQ(reflectance(reflectance_from_rgb({0.1, 0.2, 0.3})).name(), "rgb");
  EXPECT_STREQ(reflectance(reflectance_from_rgb({0.1, 0.2, 0.3})).attribute("value").value(), "0.1 0.2 0.3");
  EXPECT_STREQ(reflectance(unbounded_from_rgb({0.5, 1, 0.25})).name(), "rgb");
  EXPECT_STREQ(reflectance(unbounded_from_rgb({0.5, 1.5, 0.25})).name(), "spectrum");  // <rgb> ends at 1
  const std::vector<std::array<double, 2>> samples{{360, 0.25}, {500, 0.5}, {830, 1}};
  EXPECT_STREQ(reflectance(tabulate(samples, true)).attribute("value").value(), "360:0.25, 500:0.5, 830:1");
  // A line of .2 nm is what was read, not a table of 1 nm.
  EXPECT_STREQ(
      reflectance(tabulate({{400, 0.1}, {546.05, 0.1}, {546.15, 0.9}, {546.25, 0.1}, {700, 0.1}}, false))
          .attribute("value")
          .value(),
      "400:0.1, 546.05:0.1, 546.15:0.9, 546.25:0.1, 700:0.1");
}

// Reading the list gives the same 471 values.
TEST_F(WriteMitsuba, TablesComeBackBitForBit) {
  std::vector<std::array<double, 2>> samples;
  for (int i = 0; i < 30; ++i) samples.push_back({350.5 + 17.3 * i, 0.1 + 0.03 * ((i * 7) % 13)});
  for (const TabulatedSpectrum& table :
       {tabulate(samples, true), blackbody(4000), tabulate({{400, 1}, {700, 2}}, false)}) {
    const auto element =
        write_material(DiffuseMaterial{Spectrum{table}}).find_child_by_attribute("name", "reflectance");
    std::vector<std::array<double, 2>> found;
    std::istringstream list(element.attribute("value").value());
    for (std::string pair; std::getline(list, pair, ',');) {
      const std::size_t colon = pair.find(':');
      found.push_back({std::stod(pair.substr(0, colon)), std::stod(pair.substr(colon + 1))});
    }
    EXPECT_EQ(tabulate(found, false), table);
  }
}

TEST_F(WriteMitsuba, Emission) {
  const auto radiance = [&](const Spectrum& spectrum) {
    Scene scene = square_scene({});
    scene.lights.push_back({InfiniteLight{spectrum}, {}});
    return write(scene).child("emitter").first_child();
  };
  EXPECT_STREQ(radiance(emission_from_rgb({3, 2, 1})).attribute("value").value(), "3 2 1");
  EXPECT_STREQ(radiance(ConstantSpectrum{3}).name(), "spectrum");  // <float> would be D65
  EXPECT_STREQ(radiance(reflectance_from_rgb({0.1, 0.2, 0.3})).name(), "spectrum");
  EXPECT_STREQ(radiance(NamedSpectrum{"stdillum-D65"}).attribute("type").value(), "d65");
  EXPECT_STREQ(radiance(BlackbodySpectrum{5000, 1}).attribute("type").value(), "");
}

// ---- Shapes, media, camera

TEST_F(WriteMitsuba, SidesAreReversedOnlyWhereTheyShow) {
  Scene scene = square_scene({}, true);
  scene.shapes[0].object_to_world = scale({-1, 1, 1});
  EXPECT_EQ(value(write(scene).child("shape"), "filename"), "scene-meshes/000000.ply");
  EXPECT_EQ(value(document_.child("scene").child("shape"), "flip_normals"), "false");
  scene.materials[0].two_sided = false;
  EXPECT_EQ(value(write(scene).child("shape"), "filename"), "scene-meshes/000000.sides.ply");
  EXPECT_EQ(value(document_.child("scene").child("shape"), "flip_normals"), "true");
}

TEST_F(WriteMitsuba, PrototypesComeInTheOrderOfTheirMeshes) {
  Scene scene = square_scene({});
  scene.meshes.push_back(square_mesh());
  scene.shapes[0].mesh = {1};
  Shape inner = scene.shapes[0];
  inner.mesh = {0};
  scene.prototypes.push_back({"group", {inner}, {}});
  scene.instances.push_back({{0}, {}, {}});
  std::vector<std::string> types;
  for (const auto shape : write(scene).children("shape")) types.emplace_back(shape.attribute("type").value());
  EXPECT_THAT(types, ElementsAre("shapegroup", "ply", "instance"));
}

// Bent curves of radii that end in 0, of which some go on smoothly and some do not, and straight ones.
TEST_F(WriteMitsuba, CurvesStayCurves) {
  const std::vector<CurvePoint> points{{{0, 0, 0}, .1},    {{1, .3, 0}, .07}, {{2, 1, .7}, .02},
                                       {{3, 1, 0}, 0},     {{4, 1, -.7}, .1}, {{5, 0, 0}, .2},
                                       {{1006, .1, 0}, .1}};
  const std::vector<PlacedCurve> smooth = placed_curves(bspline_segments(points), 0, 1, false, false),
                                 kinked = placed_curves(bezier_segments(points), 0, 1, false, false),
                                 straight = placed_curves(linear_segments(points), 0, 1, true, true);
  std::vector<PlacedCurve> all = smooth;
  all.insert(all.end(), kinked.begin(), kinked.end());
  Scene scene = square_scene({});
  scene.shapes = {test::add_curves(scene, all, QuadricUv::mitsuba)};
  scene.shapes.push_back(test::add_curves(scene, straight, QuadricUv::mitsuba));
  scene.shapes[1].object_to_world = rotate(1, {1, 2, 3}) * scale({2, 2, 2});
  all.insert(all.end(), straight.begin(), straight.end());
  scene.prototypes.push_back({"p", {test::add_curves(scene, all, QuadricUv::mitsuba)}, {}, {}});
  scene.instances.push_back({{0}, scale({1, 2, 1}), {}});
  const auto elements = write(scene);
  EXPECT_THAT(diagnostics_, IsEmpty());
  EXPECT_EQ(elements.select_nodes(".//shape[@type='bsplinecurve']").size(), 2u);
  EXPECT_EQ(elements.select_nodes(".//shape[@type='linearcurve']").size(), 2u);
  std::ifstream file(folder_ / "scene-meshes" / "000000.txt");
  const std::string text(std::istreambuf_iterator<char>(file), {});
  EXPECT_EQ(std::ranges::count(text, '\n'), 7 + 1 + 4 + 1 + 4) << text;
  const Scene again = read_mitsuba(folder_ / "scene.xml").scene;
  test::expect_near(test::curves_of(scene, scene.shapes), test::curves_of(again, again.shapes), 4e-6);
  test::expect_near(test::curves_of(scene, scene.prototypes.at(0).shapes),
                    test::curves_of(again, again.prototypes.at(0).shapes), 4e-6);
}

TEST_F(WriteMitsuba, CurvesThatMitsubaDoesNotHave) {
  const std::vector<CurvePoint> points{{{0, 0, 0}, .1}, {{1, .3, 0}, .1}, {{2, 1, .7}, .1}, {{3, 1, 0}, .1}};
  const auto written = [&](const Shape& of, Scene& scene, const char* report) {
    scene.shapes = {of};
    const auto elements = write(scene);
    EXPECT_THAT(diagnostics_, Contains(Field(&Diagnostic::message, HasSubstr(report))));
    return std::string(elements.child("shape").attribute("type").value());
  };
  Scene scene = square_scene({});
  const Shape open =
      test::add_curves(scene, placed_curves(linear_segments(points), 0, 1, true, false), QuadricUv::mitsuba);
  EXPECT_EQ(written(open, scene, "half balls"), "linearcurve");
  Shape bent =
      test::add_curves(scene, placed_curves(bezier_segments(points), 0, 1, false, false), QuadricUv::pbrt);
  scene.film.layers.add(Layer::uv);
  EXPECT_EQ(written(bent, scene, "(u,v) of curves"), "bsplinecurve");
  bent.object_to_world = vitrail::scale({1, 1, 2});
  EXPECT_EQ(written(bent, scene, "tubes of triangles"), "ply");
  bent.object_to_world = {};
  bent.flip_orientation = true;  // its front is inside
  scene.materials[0].two_sided = false;
  EXPECT_EQ(written(bent, scene, "tubes of triangles"), "ply");
}

TEST_F(WriteMitsuba, Media) {
  Scene scene = square_scene({});
  Medium medium;
  medium.coefficients = ExtinctionAlbedo{Spectrum{ConstantSpectrum{2}}, Spectrum{ConstantSpectrum{0.5f}}};
  medium.g = 0.25f;
  medium.emission = ConstantSpectrum{1};
  scene.media = {medium};
  scene.shapes[0].exterior = scene.camera_medium = Id<Medium>{0};
  const auto root = write(scene);
  EXPECT_EQ(value(root.child("medium"), "sigma_t"), "2");
  EXPECT_EQ(value(root.child("medium").child("phase"), "g"), "0.25");
  const std::string id = root.child("medium").attribute("id").value();
  EXPECT_EQ(reference(root.child("shape"), "exterior"), id);
  EXPECT_EQ(reference(root.child("sensor"), "medium"), id);
  EXPECT_THAT(diagnostics_, drops("emission of a medium"));
  Grid grid;
  grid.nx = grid.ny = grid.nz = 1;
  grid.values = {5};
  scene.media[0].density = grid;
  write(scene);
  EXPECT_EQ(std::filesystem::file_size(folder_ / "scene-volumes/000000.vol"), 52u);
}

TEST_F(WriteMitsuba, WhatCamerasAndFilmsCannotSay) {
  Scene scene = square_scene({});
  scene.film.filter = GaussianFilter{1.5, 1.5, 0.5};
  scene.settings.max_depth = unlimited_depth;
  EXPECT_EQ(value(write(scene).child("integrator"), "max_depth"), "-1");
  EXPECT_THAT(diagnostics_, approximates("4σ"));
  scene.camera = SphericalCamera{};
  write(scene);
  EXPECT_THAT(diagnostics_, drops("all directions"));
  scene.camera = PerspectiveCamera{{}, {-1, 1, -1, 1}, {}};  // the film is 8 × 4
  write(scene);
  EXPECT_THAT(diagnostics_, approximates("square"));
}

TEST_F(WriteMitsuba, UnwritableFolders) {
  folder_.write("file", "");
  EXPECT_THROW(write_mitsuba(square_scene({}), folder_ / "file" / "scene.xml"), MachineError);
}

}  // namespace
}  // namespace vitrail::write_mitsuba_test
