// SPDX-License-Identifier: Apache-2.0
// POV-Ray's scene language, and what its objects become. Values were printed by povray 3.7 where they are not
// obvious.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "importers/povray/read/povray.h"
#include "importers/povray/read/reader.h"
#include "tests/importers/temporary_folder.h"

namespace vitrail::read_povray_test {
namespace {

class ReadPovray : public ::testing::Test {
 protected:
  std::filesystem::path file(const std::string& text, const std::string& name = "scene.pov") {
    const auto path = folder_.path() / name;
    std::ofstream(path) << text;
    return path;
  }
  ImportedScene read(const std::string& text) { return read_povray(file(text)); }
  ImportedScene read_for_export(const std::string& text) {
    ImportOptions options;
    options.for_export = true;
    return read_povray(file(text), MeshMemory{}, options);
  }
  // What an expression gives, behind statements.
  pov::Numbers value(const std::string& expression, const std::string& before = "") {
    pov::Reader reader(file(before + "\n#declare Result_ = " + expression + ";\n"), {{folder_.path()}}, {});
    while (reader.next().kind != pov::TokenKind::end) {
    }
    return std::get<pov::Numbers>(*reader.symbols().find("Result_")->value());
  }
  double number(const std::string& expression, const std::string& before = "") {
    return value(expression, before).v[0];
  }
  Error error(const std::string& text) {
    try {
      read(text);
    } catch (const Error& e) {
      return e;
    }
    ADD_FAILURE() << "no error: " << text;
    return Error("");
  }
  TemporaryFolder folder_;
};

TEST_F(ReadPovray, Expressions) {
  EXPECT_DOUBLE_EQ(number("1 + 2*3 - 4/2"), 5);
  EXPECT_DOUBLE_EQ(number("-2*-2"), 4);
  EXPECT_DOUBLE_EQ(number("(0.5 < 1 ? 3 : 4)"), 3);
  EXPECT_DOUBLE_EQ(number("mod(-7,3)"), -1);
  EXPECT_DOUBLE_EQ(number("div(-7,3)"), -2);
  EXPECT_DOUBLE_EQ(number("vlength(<3,4,0>)"), 5);
  EXPECT_DOUBLE_EQ(number("vrotate(x,<0,0,90>).y"), 1);
  EXPECT_NEAR(number("vaxis_rotate(x,y,90).z"), -1, 1e-12);
  EXPECT_DOUBLE_EQ(number("(2*<1,2,3>+y).y"), 5);
  EXPECT_DOUBLE_EQ(number("strlen(concat(\"ab\",str(1/3,0,-1)))"), 10);
}

TEST_F(ReadPovray, ColoursAreOfFiveTerms) {
  const pov::Numbers c = value("rgbt <1,0.5,0.25,0.2>*0.5");
  EXPECT_TRUE(c.is_color);
  EXPECT_DOUBLE_EQ(c.v[1], 0.25);
  EXPECT_DOUBLE_EQ(c.v[3], 0);
  EXPECT_DOUBLE_EQ(c.v[4], 0.1);
}

TEST_F(ReadPovray, RandomNumbersAreThoseOfPovray) {
  const std::string before = "#declare S = seed(0); #declare A = rand(S);";
  EXPECT_DOUBLE_EQ(number("A*4294967295", before), 12345);
  EXPECT_DOUBLE_EQ(number("rand(S)*4294967295", before), 2003875766);
}

TEST_F(ReadPovray, LoopsAndBranches) {
  EXPECT_DOUBLE_EQ(
      number("I", "#declare I = 0; #while (I < 10) #declare I = I + 1; #if (I = 7) #break #end #end"), 7);
  EXPECT_DOUBLE_EQ(number("N", "#declare N = 0; #for (I, 1, 4) #for (J, 1, I) #declare N = N + 1; #end #end"),
                   10);
  EXPECT_DOUBLE_EQ(
      number("N",
             "#declare N = 0; #switch (1) #case (0) #declare N = N + 1; #case (1) #declare N = N + "
             "10; #case (2) #declare N = N + 100; #break #else #declare N = 1000; #end"),
      110);
  EXPECT_DOUBLE_EQ(
      number(
          "N",
          "#ifdef (Q) #declare N = 1; #else #if (no) #declare N = 2; #elseif (1) #declare N = 3; #end #end"),
      3);
}

// As povray 3.7 decides: = is within 1e-10, < and > are exact, and what is smaller than 1e-10 is false.
TEST_F(ReadPovray, NearlyEqualNumbers) {
  const std::string count =
      "#declare I = 0; #declare N = 0; #while (I < 1) #declare I = I + .1; #declare N = N + 1; #end";
  EXPECT_DOUBLE_EQ(number("N", count), 11);
  for (const auto& [condition, wanted] : std::map<std::string, double>{{"1 - 1e-11 < 1", 1},
                                                                       {"1 > 1 - 1e-11", 1},
                                                                       {"1 <= 1 - 1e-11", 1},
                                                                       {"1 - 1e-11 >= 1", 1},
                                                                       {"1 - 1e-11 = 1", 1},
                                                                       {"1 - 1e-11 != 1", 0},
                                                                       {"1 - 1e-9 = 1", 0},
                                                                       {"9e-11", 0},
                                                                       {"-9e-11", 0},
                                                                       {"1.1e-10", 1},
                                                                       {"!1e-11", 1},
                                                                       {"1e-11 & 1", 0},
                                                                       {"1e-11 | 0", 0},
                                                                       {"1e-11 > 0", 1}}) {
    EXPECT_DOUBLE_EQ(number("N", "#declare N = 0; #if (" + condition + ") #declare N = 1; #end"), wanted)
        << condition;
    EXPECT_DOUBLE_EQ(number("((" + condition + ") ? 1 : 0)"), wanted) << condition;
  }
}

TEST_F(ReadPovray, MacrosChangeWhatTheyAreGiven) {
  const std::string before =
      "#macro P(X) #declare X = 3; #end #macro F(N) (N > 0 ? 1 : 0) #end #declare A = 1; P(A) P(New)";
  EXPECT_DOUBLE_EQ(number("A + New + F(2)", before), 7);
  EXPECT_DOUBLE_EQ(number("A", before + "#macro L() #local A = 9; #end L()"), 3);
}

// POV-Ray's own variables, and words that its version 3.7 does not have, as povray takes them.
TEST_F(ReadPovray, NamesThatAreFree) {
  for (const std::string name : {"clock_delta", "final_clock", "final_frame", "frame_number", "image_width",
                                 "image_height", "initial_clock", "initial_frame", "normalize",
                                 "number_of_sources", "potential", "pragma", "sgn", "tau", "trunc"}) {
    EXPECT_DOUBLE_EQ(number(name + " + 1", "#declare " + name + " = 8;"), 9) << name;
    EXPECT_DOUBLE_EQ(number("A", "#macro M(" + name + ") #declare A = " + name + "; #end M(5)"), 5) << name;
  }
  EXPECT_DOUBLE_EQ(number("image_width", "#declare image_width = image_width / image_width + 1;"), 2);
  EXPECT_DOUBLE_EQ(
      number(
          "image_width / W",
          "#declare W = image_width; #macro M() #local image_width = 3; #declare N = image_width; #end M()"),
      1);
  const auto is_defined = [&](const std::string& name, const std::string& before = "") {
    return number("N", before + "#declare N = 0; #ifdef (" + name + ") #declare N = 1; #end");
  };
  EXPECT_EQ(is_defined("image_width"), 1);
  for (const char* name : {"tau", "pi", "clock"}) EXPECT_EQ(is_defined(name), 0) << name;
  EXPECT_EQ(is_defined("tau", "#declare tau = 1;"), 1);
  EXPECT_EQ(is_defined("tau", "#declare tau = 1; #undef tau "), 0);
  error("#declare pi = 3;");
}

// povray takes them without commas between, or with one behind the last; no more than one.
TEST_F(ReadPovray, CommasOfMacros) {
  const std::string before = "#macro D(A, B) (A - B) #end #macro None() 4 #end ";
  for (const char* call : {"D(7, 3)", "D(7, 3,)", "D(7 3)", "None()"})
    EXPECT_DOUBLE_EQ(number(call, before), 4) << call;
  for (const char* call :
       {"D(7, 3,,)", "D(7,, 3)", "D(, 7, 3)", "D(7, 3, 1)", "D(7, 3 1)", "D(7)", "D(7,)", "None(,)"})
    error(before + "#declare N = " + call + ";");
}

TEST_F(ReadPovray, ArraysAndSplines) {
  EXPECT_DOUBLE_EQ(number("A[1][0] + dimension_size(A,2)", "#declare A = array[2][3] {{1,2,3},{4,5,6}}"), 7);
  EXPECT_DOUBLE_EQ(number("B[0]", "#declare A = array[1] {1} #declare B = A; #declare A[0] = 2;"), 1);
  const std::string spline = "#declare S = spline { natural_spline 0,<0,0,0> 1,<1,2,3> 2,<5,5,5> 4,<0,1,2> }";
  EXPECT_NEAR(number("S(3).x", spline), 4.391, 5e-4);
  EXPECT_NEAR(number("S(0.5).y", spline), 0.821, 5e-4);
}

TEST_F(ReadPovray, FunctionsAreCompiled) {
  EXPECT_DOUBLE_EQ(number("F(3,4,0)", "#declare F = function { sqrt(x*x + y*y) - z }"), 5);
  EXPECT_DOUBLE_EQ(number("G(2)",
                          "#declare F = function(a,b) { select(a-b, 1, 2, 3) } #declare G = function(q) { "
                          "F(q,2) + F(1,q)*10 }"),
                   12);
}

TEST_F(ReadPovray, TextFilesStayInMemory) {
  EXPECT_DOUBLE_EQ(number("A + B.y",
                          "#fopen F \"t.txt\" write #write (F, 4, \",\", <1,2,3>) #fclose F "
                          "#fopen F \"t.txt\" read #read (F, A, B)"),
                   6);
  EXPECT_FALSE(std::filesystem::exists(folder_.path() / "t.txt"));
}

TEST_F(ReadPovray, ErrorsNameTheirPlaceAndWhatLeadsThere) {
  const Error undeclared = error("sphere { 0, 1 }\n  box { 0, Sixe }\n");
  EXPECT_EQ(undeclared.location.line, 2);
  EXPECT_EQ(undeclared.location.column, 12);
  EXPECT_NE(std::string(undeclared.what()).find("'Sixe' is not declared"), std::string::npos);
  EXPECT_EQ(undeclared.excerpt, "  box { 0, Sixe }");
  file("#macro M()\n sphere { 0 }\n#end\n", "m.inc");
  const std::string nested = error("#include \"m.inc\"\nM()\n").what();
  EXPECT_NE(nested.find("in macro M, called at"), std::string::npos) << nested;
  EXPECT_NE(std::string(error("#if (1)\n").what()).find("no #end"), std::string::npos);
  EXPECT_NE(std::string(error("#include \"nowhere.inc\"\n").what()).find("there is no file"),
            std::string::npos);
  EXPECT_NE(std::string(error("#macro R() R() R() #end R()").what()).find("too deep"), std::string::npos);
  // Where a loop begins again within its own condition, it would do so without end.
  for (const char* loop : {"#while (C<=1.#end", "#while (C<=1+#declare C=2; #end", "#while (C #end 1)"})
    EXPECT_EQ(error(std::string("#declare C = 0;\nunion { sphere { 0, 1 } ") + loop + " }").location.line, 2)
        << loop;
}

TEST_F(ReadPovray, ASceneOfAllKinds) {
  const ImportedScene imported = read(R"(#version 3.7; global_settings { assumed_gamma 1 }
camera { location <0,0,-4> right 2*x up y direction z }
light_source { <1,2,3>, rgb 2 }
light_source { 0, 1 spotlight radius 10 falloff 20 point_at z fade_distance 2 fade_power 2 }
sphere { <1,2,3>, 4 pigment { rgb <1,.5,.25> } finish { ambient 0 diffuse 0.5 } }
box { 0, 1 scale <1,2,3> }
cylinder { 0, y, 0.5 open }
plane { y, -1 }
difference { box { -1, 1 } box { 0, 2 } }
torus { 1, 0.25 }
mesh2 { vertex_vectors { 3, 0, x, y } face_indices { 1, <0,1,2> } })");
  const Scene& scene = imported.scene;
  ASSERT_EQ(scene.lights.size(), 2u);
  const auto& point = std::get<PointLight>(scene.lights[0].model);
  EXPECT_EQ(point.position, (Point3d{1, 2, 3}));
  ASSERT_TRUE(point.fading);
  EXPECT_NEAR(luminance(point.intensity), 2 * M_PI, 1e-3);
  const auto& spot = std::get<SpotLight>(scene.lights[1].model);
  EXPECT_EQ(spot.fading->fade_distance, 2);
  EXPECT_FLOAT_EQ(spot.cutoff_deg, 20);
  ASSERT_GE(scene.shapes.size(), 7u);
  const Transform sphere = scene.shapes[0].object_to_world;
  EXPECT_EQ(transform_point(sphere, {0, 0, 1}), (Point3d{1, 2, 7}));
  const auto& diffuse = std::get<DiffuseMaterial>(scene.materials.at(scene.shapes[0].material.value).model);
  EXPECT_NEAR(std::get<SigmoidSpectrum>(std::get<Spectrum>(diffuse.reflectance)).rgb[0], 0.5, 1e-6);
  EXPECT_TRUE(scene.settings.direct_only);
  const auto& camera = std::get<PerspectiveCamera>(scene.camera);
  EXPECT_DOUBLE_EQ(camera.screen.x1, 1);
  EXPECT_DOUBLE_EQ(camera.screen.y1, 0.5);
  EXPECT_EQ(scene.film.width, 2 * scene.film.height);
}

TEST_F(ReadPovray, AnAnimationIsItsFirstFrame) {
  for (const char* name : {"clock", "clock_delta", "initial_clock", "clock_on"})
    EXPECT_EQ(number(name), 0) << name;
  for (const char* name : {"frame_number", "initial_frame", "final_frame"})
    EXPECT_EQ(number(name), 1) << name;
}

TEST_F(ReadPovray, WhatIsDefinedStandsBeforeTheScene) {
  ImportOptions options;
  options.definitions = {{"clock", "0.25"}, {"Wide", "-2e1"}, {"Name", "2 m"}};
  const Scene scene =
      read_povray(file("camera { location -4*z } #ifndef (Wide) #error \"no\" #end #if (Name = \"2 m\") "
                       "sphere { <Wide, clock, 0>, 1 } #end"),
                  MeshMemory(), options)
          .scene;
  ASSERT_EQ(scene.shapes.size(), 1u);
  const Point3d center = transform_point(scene.shapes[0].object_to_world, Point3d{});
  EXPECT_DOUBLE_EQ(center.x, -20);
  EXPECT_DOUBLE_EQ(center.y, 0.25);
  for (const auto& [name, value] : {std::pair{"sphere", "1"}, {"clock", "noon"}, {"2x", "1"}, {"", "1"}}) {
    options.definitions = {{name, value}};
    EXPECT_THROW(read_povray(file("sphere { 0, 1 }"), MeshMemory(), options), UsageError) << name;
  }
}

TEST_F(ReadPovray, TextsAreCompared) {
  EXPECT_EQ(number("(Name_ != \"\" ? 1 : 2)", "#declare Name_ = \"b\";"), 1);
  EXPECT_EQ(number("(\"a\" = Name_)", "#declare Name_ = \"b\";"), 0);
  EXPECT_EQ(number("(\"a\" < Name_ & 1 = 1)", "#declare Name_ = \"b\";"), 1);
}

TEST_F(ReadPovray, DefaultsMayLackTheirSign) {
  const Scene scene = read("default { pigment { rgb <1,0,0> } } sphere { 0, 1 }").scene;
  ASSERT_FALSE(scene.materials.empty());
}

// Behind a face comes the number of a texture, or the next face, which may be an expression.
TEST_F(ReadPovray, FacesMayBeExpressions) {
  const Scene scene =
      read(
          "#declare F_ = <0,1,2>; mesh2 { vertex_vectors { 4, <0,0,0>,<1,0,0>,<1,1,0>,<0,1,0> } "
          "face_indices { 2, F_+0, F_+<0,1,1> } }")
          .scene;
  ASSERT_EQ(scene.meshes.size(), 1u);
  EXPECT_EQ(scene.meshes[0].triangles.size(), 2u);
  EXPECT_NE(error("mesh2 { vertex_vectors { 3, 0, x, y } face_indices { 1, <0,1,2>, 4 } }").what(),
            std::string());
}

// Of the package fonts-povray.
TEST_F(ReadPovray, ATextOfBlanksHasNoExtents) {
  const Scene scene = read(
                          "#declare T_ = text { ttf \"cyrvetic.ttf\" \" \" 1, 0 } "
                          "sphere { 0, 1 + max_extent(T_).x }")
                          .scene;
  EXPECT_EQ(transform_vector(scene.shapes.at(0).object_to_world, Vector3d{0, 0, 1}), (Vector3d{0, 0, 1}));
}

// The cube of 40 that is looked at has cells larger than these.
TEST_F(ReadPovray, SmallSurfacesOfPolynomialsAreFound) {
  const auto width = [&](const char* polynomial) {
    const Scene scene = read(std::string(polynomial)).scene;
    Bounds3f bounds;
    for (const Point3f& p : scene.meshes.at(0).positions) extend(bounds, p);
    return extent(bounds).x;
  };
  EXPECT_NEAR(width("quartic { <1,0,0,0,2,0,0,2,0,-2.5,0,0,0,0,0,0,0,0,0,0,1,0,0,2,0,1.5,0,0,0,0,1,0,-2.5,0,"
                    "0.5625> pigment { rgb 1 } }"),
              3, 0.03)
      << "a torus of radii 1 and 0.5";
  EXPECT_NEAR(width("poly { 2, <1,0,0,0,1,0,0,1,0,-0.01> pigment { rgb 1 } }"), 0.2, 0.002) << "a sphere";
}

// As POV-Ray 3.7 shows its prism3.pov.
TEST_F(ReadPovray, UpAlongTheDirectionMirrors) {
  const auto mirrored = [&](const char* up) {
    const Scene scene =
        read(std::string("camera { location <-10,10,-10> right x up ") + up + " look_at 0 } sphere { 0, 1 }")
            .scene;
    return swaps_handedness(std::get<PerspectiveCamera>(scene.camera).camera_to_world);
  };
  EXPECT_NE(mirrored("z"), mirrored("y"));
}

TEST_F(ReadPovray, APlaneAloneReachesTheHorizon) {
  const Scene scene = read("camera { location <0,1,-100> look_at <0,20,0> } plane { y, 0 }").scene;
  ASSERT_EQ(scene.shapes.size(), 1u);
  EXPECT_GT(length(transform_vector(scene.shapes[0].object_to_world, Vector3d{1, 0, 0})), 1e4);
}

// For formats where all objects have shadows: a light within what it looks like would else light nothing.
TEST_F(ReadPovray, LightPassesWhatALampLooksLike) {
  const Scene scene =
      read_for_export(
          "camera { location -4*z } light_source { <0,2,0> 1 looks_like { sphere { 0, 0.1 pigment { rgb 1 } "
          "finish { ambient 1 } } } } sphere { 0, 1 pigment { rgb 1 } no_shadow }")
          .scene;
  ASSERT_EQ(scene.shapes.size(), 2u);
  const auto* const sheet =
      std::get_if<ThinDielectricMaterial>(&scene.materials.at(scene.shapes[0].material.value).model);
  ASSERT_TRUE(sheet);
  EXPECT_EQ(sheet->eta, Spectrum{ConstantSpectrum{1}});
  ASSERT_TRUE(scene.shapes[0].area_light);
  EXPECT_FALSE(scene.area_lights.at(scene.shapes[0].area_light->value).two_sided)
      << "its back would be seen through its front, too";
  EXPECT_TRUE(
      std::holds_alternative<DiffuseMaterial>(scene.materials.at(scene.shapes[1].material.value).model))
      << "what reflects stays as it is";
}

TEST_F(ReadPovray, LightPassesASkyWithoutShadow) {
  const auto sheets = [&](const char* more) {
    const Scene scene =
        read_for_export(
            std::string("camera { location -4*z } union { sphere { 0, 100 } pigment { rgb <0,0,1> } finish { "
                        "ambient 1 diffuse 0 } ") +
            more + "}")
            .scene;
    return std::holds_alternative<ThinDielectricMaterial>(
        scene.materials.at(scene.shapes.at(0).material.value).model);
  };
  EXPECT_TRUE(sheets("no_shadow"));
  EXPECT_FALSE(sheets(""));
}

TEST_F(ReadPovray, AFlatBoxIsARectangle) {
  const ImportedScene read_scene = read("camera { location -4*z } box { <-1,-1,2>, <1,1,2> }");
  ASSERT_EQ(read_scene.scene.meshes.size(), 1u);
  EXPECT_EQ(read_scene.scene.meshes[0].triangles.size(), 2u);
  Bounds3f bounds;
  for (const Point3f& p : read_scene.scene.meshes[0].positions) extend(bounds, p);
  EXPECT_EQ(bounds.lower, (Point3f{-1, -1, 2}));
  EXPECT_EQ(bounds.upper, (Point3f{1, 1, 2}));
  EXPECT_TRUE(
      read("camera { location -4*z } box { <-1,2,2>, <1,2,2> } sphere { 0, 1 }").scene.meshes.size() == 1u)
      << "a line is dropped";
}

// POV-Ray's image begins at +x and goes towards +z, with its top at +y; u runs backwards here.
TEST_F(ReadPovray, AnImageAroundASphere) {
  std::ofstream(folder_.path() / "a.ppm") << "P3 2 1 255 255 0 0 0 0 255\n";
  const auto at = [&](const char* more, double u, double v) {
    const Scene scene =
        read(std::string("sphere { 0, 1 pigment { image_map { ppm \"a.ppm\" map_type 1 } ") + more + " } }")
            .scene;
    const double phi = (1 - u) * 2 * M_PI, theta = (1 - v) * M_PI;  // of the sphere's own (u,v)
    return transform_point(
        scene.shapes.at(0).object_to_world,
        {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)});
  };
  EXPECT_LT(length(at("", 0, 0.5) - Point3d{1, 0, 0}), 1e-12);
  EXPECT_LT(length(at("", 0.25, 0.5) - Point3d{0, 0, 1}), 1e-12);
  EXPECT_LT(length(at("", 0.25, 1) - Point3d{0, 1, 0}), 1e-12);
  EXPECT_LT(length(at("rotate 90*y scale 3", 0, 0.5) - Point3d{0, 0, -1}), 1e-12);
}

TEST_F(ReadPovray, PigmentsOfASkyLieAboveEachOther) {
  const Scene scene = read(
                          "camera { location -4*z } sky_sphere { pigment { rgb <0,0,1> } pigment { rgbt "
                          "<1,1,1,0.75> } } sphere "
                          "{ 0, 1 }")
                          .scene;
  const auto& radiance = scene.area_lights.at(scene.shapes.back().area_light->value).radiance;
  const auto* const texture = std::get_if<Id<Texture>>(&radiance);
  ASSERT_TRUE(texture);
  const auto& mix = std::get<MixTexture>(scene.textures.at(texture->value).model);
  EXPECT_FLOAT_EQ(std::get<float>(mix.amount), 0.25f);
  EXPECT_LT(luminance(std::get<Spectrum>(mix.first)), 0.2) << "blue, below";
  EXPECT_NEAR(luminance(std::get<Spectrum>(mix.second)), 1, 0.01);
}

}  // namespace
}  // namespace vitrail::read_povray_test
