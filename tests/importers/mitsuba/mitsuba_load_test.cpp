// SPDX-License-Identifier: Apache-2.0
// What surrounds the plugins of a Mitsuba file: includes, defaults, references, and input that means harm.
#include <fmt/format.h>
#include <limits>

#include "importers/mitsuba/read/sun_and_sky.h"
#include "scene/spectra/rgb_to_spectrum.h"
#include "tests/importers/mitsuba/mitsuba_load.h"

namespace vitrail::mitsuba_load_test {
namespace {

namespace fs = std::filesystem;

// Mitsuba 3.9.1 has 1.3 and .2, each where the file does not give it.
TEST_F(MitsubaLoad, HairHasBothMelaninsAndRunsAlongV) {
  const auto hair = [&](const std::string& inside) {
    return std::get<HairMaterial>(material("<bsdf type=\"hair\" id=\"m\">" + inside + "</bsdf>").model);
  };
  EXPECT_TRUE(hair("").along_v);
  EXPECT_EQ(hair("").eumelanin, FloatParameter{1.3f});
  EXPECT_EQ(hair("").pheomelanin, FloatParameter{0.2f});
  EXPECT_EQ(hair("<float name=\"eumelanin\" value=\".5\"/>").pheomelanin, FloatParameter{0.2f});
  EXPECT_FALSE(hair("<float name=\"pheomelanin\" value=\"0\"/>").pheomelanin);
  const auto absorbing =
      hair("<spectrum name=\"sigma_a\" value=\".25\"/><float name=\"scale\" value=\"4\"/>");
  EXPECT_EQ(absorbing.sigma_a, SpectrumParameter{ConstantSpectrum{1}});
  EXPECT_FALSE(absorbing.eumelanin || absorbing.pheomelanin);
}

const std::string red = "<rgb name=\"reflectance\" value=\"1 0 0\"/>";

TEST_F(MitsubaLoad, DefaultsOfMaterials) {
  const auto principled = [&](const std::string& type, const std::string& inside) {
    return std::get<PrincipledMaterial>(
        material("<bsdf type=\"" + type + "\" id=\"m\">" + inside + "</bsdf>").model);
  };
  EXPECT_EQ(principled("principled", ""), PrincipledMaterial{});
  const PrincipledMaterial thin =
      principled("principledthin", "<rgb name=\"base_color\" value=\".2 .4 .6\"/>");
  EXPECT_EQ(thin.base_color, SpectrumParameter{reflectance_from_rgb({.2, .4, .6})});
  EXPECT_TRUE(thin.thin);
  EXPECT_FALSE(std::get<PlasticMaterial>(material("<bsdf type=\"plastic\" id=\"m\"/>").model).nonlinear);
}

TEST_F(MitsubaLoad, BareOpaqueMaterialsHaveOneSide) {
  const Material bare = material("<bsdf type=\"diffuse\" id=\"m\">" + red + "</bsdf>");
  EXPECT_EQ(std::get<DiffuseMaterial>(bare.model).reflectance,
            SpectrumParameter{reflectance_from_rgb({1, 0, 0})});
  EXPECT_FALSE(bare.two_sided);
  EXPECT_EQ(bare.name, "m");
  EXPECT_EQ(bare.origin.line, 1u);
  EXPECT_TRUE(material("<bsdf type=\"twosided\" id=\"m\"><bsdf type=\"diffuse\"/></bsdf>").two_sided);
  EXPECT_TRUE(material("<bsdf type=\"dielectric\" id=\"m\"/>").two_sided);
  const std::string white = "<bsdf type=\"diffuse\" id=\"white\"/>", ref = "<ref id=\"white\"/>";
  const Material two = material(white + "<bsdf type=\"twosided\" id=\"m\">" + ref + ref + "</bsdf>");
  const Id<Material> back = std::get<TwoSidedMaterial>(two.model).back;
  EXPECT_TRUE(imported_.scene.materials.at(back.value).two_sided);
  EXPECT_FALSE(imported_.scene.materials.at(0).two_sided) << "that is called white";
}

// What an adapter says of a material that is made of others holds for these, and not where they are used
// without it.
TEST_F(MitsubaLoad, AdaptersReachTheParts) {
  const std::string parts =
      "<bsdf type=\"diffuse\" id=\"a\"/><texture type=\"checkerboard\" id=\"t\"/>"
      "<bsdf type=\"mask\" id=\"hole\"><ref id=\"a\"/></bsdf>"
      "<bsdf type=\"blendbsdf\" id=\"blend\"><ref id=\"hole\"/><ref id=\"a\"/></bsdf>";
  const auto leaf = [&](Material at) {
    for (;;) {
      if (const auto* blend = std::get_if<BlendMaterial>(&at.model))
        at = imported_.scene.materials.at(blend->second.value);
      else if (const auto* mask = std::get_if<MaskMaterial>(&at.model))
        at = imported_.scene.materials.at(mask->material.value);
      else
        return at;
    }
  };
  for (const std::string inside : {"hole", "blend"}) {
    const Material bumped =
        material(parts + "<bsdf type=\"bumpmap\" id=\"m\"><ref id=\"t\" name=\"texture\"/><ref id=\"" +
                 inside + "\"/></bsdf>");
    EXPECT_TRUE(leaf(bumped).displacement) << inside;
    EXPECT_TRUE(leaf(bumped).bump_shadowing);
    EXPECT_FALSE(bumped.displacement);
    EXPECT_FALSE(imported_.scene.materials.at(0).displacement) << "that is called a";
  }
  const Material mapped =
      material(parts +
               "<bsdf type=\"normalmap\" id=\"m\"><texture type=\"checkerboard\" name=\"normalmap\"/>"
               "<ref id=\"hole\"/></bsdf>");
  EXPECT_TRUE(leaf(mapped).normal_map);
  const std::string opaque =
      "<bsdf type=\"blendbsdf\"><bsdf type=\"diffuse\"/><bsdf type=\"diffuse\"/></bsdf>";
  EXPECT_TRUE(leaf(material("<bsdf type=\"twosided\" id=\"m\">" + opaque + "</bsdf>")).two_sided);
}

// Measured: behind bumps on a mask, a sheet or nothing no light of emitters gets through to volpath.
TEST_F(MitsubaLoad, BumpsThatMitsubaMeansOtherwise) {
  const auto says = [&](const std::string& words, const std::string& integrator, const std::string& bsdf) {
    material("<integrator type=\"" + integrator + "\"/>" + bsdf);
    return mentions(words);
  };
  const std::string bumps = "<texture type=\"checkerboard\" name=\"texture\"/>",
                    diffuse = "<bsdf type=\"diffuse\"/>";
  const auto with = [&](const char* type, const std::string& inside) {
    return fmt::format("<bsdf type=\"{}\" id=\"m\">{}</bsdf>", type, inside);
  };
  const std::string mask = "<bsdf type=\"mask\">" + diffuse + "</bsdf>";
  EXPECT_TRUE(says("these bumps", "volpath", with("bumpmap", bumps + mask)));
  EXPECT_TRUE(says("these bumps", "volpath", with("normalmap", bumps + "<bsdf type=\"thindielectric\"/>")));
  EXPECT_FALSE(says("these bumps", "path", with("bumpmap", bumps + mask)));
  EXPECT_FALSE(says("these bumps", "volpath", with("bumpmap", bumps + diffuse)));

  // It mirrors what twosided is around, and turns over what is around it.
  EXPECT_TRUE(
      says("on the back", "path", with("twosided", "<bsdf type=\"bumpmap\">" + bumps + diffuse + "</bsdf>")));
  EXPECT_FALSE(
      says("on the back", "path", with("bumpmap", bumps + "<bsdf type=\"twosided\">" + diffuse + "</bsdf>")));
}

TEST_F(MitsubaLoad, NullCountsInMitsubasPath) {
  const auto says = [&](const std::string& integrator) {
    material("<integrator type=\"" + integrator +
             "\"><integer name=\"max_depth\" value=\"6\"/></integrator>"
             "<bsdf type=\"null\" id=\"m\"/>");
    return mentions("the depth");
  };
  EXPECT_TRUE(says("path"));
  EXPECT_FALSE(says("volpath"));
}

// Mitsuba 3.9.1: an absorbing ball is clear to path, whatever its surface, and to scenes without integrator.
TEST_F(MitsubaLoad, MediaThatTheIntegratorIgnores) {
  const std::string ball =
      "<shape type=\"sphere\"><bsdf type=\"null\"/><medium name=\"interior\" type=\"homogeneous\"/></shape>";
  const auto sees = [&](const std::string& integrator, const ImportOptions& options = {}) {
    const std::string element = integrator.empty() ? "" : "<integrator type=\"" + integrator + "\"/>";
    imported_ = read_mitsuba(folder_.write("scene.xml", head + element + ball + tail), MeshMemory{}, options);
    const bool seen = imported_.scene.shapes.at(0).interior.has_value();
    EXPECT_EQ(mentions("ignores them"), !seen) << integrator;
    return seen;
  };
  for (const char* integrator : {"volpath", "volpathmis", "bdpt"}) EXPECT_TRUE(sees(integrator));
  for (const char* integrator : {"path", "prb", "direct", ""}) EXPECT_FALSE(sees(integrator));
  ImportOptions options;
  options.all_media = true;
  EXPECT_TRUE(sees("path", options));
}

TEST_F(MitsubaLoad, DefaultsReferencesAliasesAndIncludes) {
  folder_.write("part.xml", head +
                                "<default name=\"tone\" value=\"0.75\"/><bsdf type=\"diffuse\" id=\"part\">"
                                "<spectrum name=\"reflectance\" value=\"$tone\"/></bsdf>" +
                                tail);
  const Material m = material(
      "<default name=\"tone\" value=\"0.25\"/><include filename=\"part.xml\"/><alias id=\"part\" as=\"m\"/>");
  EXPECT_EQ(std::get<DiffuseMaterial>(m.model).reflectance, SpectrumParameter{ConstantSpectrum{0.25f}})
      << "the first default counts";
  EXPECT_EQ(imported_.scene.files.size(), 2u);
  EXPECT_EQ(m.origin.file, 1u);
}

TEST_F(MitsubaLoad, SharedFilesAreFoundFromTheWorkingDirectory) {
  const std::string part = head + "<bsdf type=\"diffuse\" id=\"m\"/>" + tail;
  const fs::path scenes = folder_.write("scene.xml", head + "<include filename=\"part.xml\"/>" + floor + tail)
                              .parent_path(),
                 before = fs::current_path();
  fs::create_directory(scenes / "common");
  folder_.write("common/part.xml", part);
  fs::current_path(scenes);
  EXPECT_NO_THROW(imported_ = read_mitsuba("scene.xml"));
  fs::current_path(before);
  EXPECT_EQ(imported_.scene.materials.size(), 1u);
}

TEST_F(MitsubaLoad, Daylight) {
  const ImportedScene old = read_mitsuba(folder_.write(
      "scene.xml",
      "<scene version=\"0.6.0\"><emitter type=\"sunsky\"><vector name=\"sunDirection\" x=\"0\" y=\"3\" "
      "z=\"4\"/>"
      "<float name=\"skyScale\" value=\"2\"/><float name=\"sunScale\" value=\"0.5\"/></emitter></scene>"));
  ASSERT_EQ(old.scene.lights.size(), 1u);
  const auto& both = std::get<SkyLight>(old.scene.lights[0].model);
  EXPECT_NEAR(both.to_sun.z, 0.6, 1e-12);   // its +y is up
  EXPECT_NEAR(both.to_sun.y, -0.8, 1e-12);  // and its +z in the south
  EXPECT_NEAR(transform_vector(both.light_to_world, both.to_sun).z, 0.8, 1e-12);
  EXPECT_EQ(both.sky_scale, 2);
  EXPECT_EQ(both.sun_scale, 0.5f);
  const auto says = [](const ImportedScene& imported, std::string_view what) {
    return std::ranges::any_of(
        imported.diagnostics, [&](const Diagnostic& d) { return d.message.find(what) != std::string::npos; });
  };
  EXPECT_TRUE(says(old, "the model of daylight of Mitsuba 0.6"));

  // Where Mitsuba 3.9.1 has the sun of these hours in Tokyo, its default: up, and −y east and −x north.
  for (const auto& [hour, direction] : {std::pair{9, Vector3d{0.0956952, -0.614786, 0.782867}},
                                        {15, Vector3d{0.0513851, 0.691748, 0.720308}}}) {
    const ImportedScene now = read_mitsuba(
        folder_.write("scene.xml", fmt::format("<scene version=\"3.0.0\"><emitter type=\"sunsky\">"
                                               "<float name=\"hour\" value=\"{}\"/></emitter></scene>",
                                               hour)));
    EXPECT_FALSE(says(now, "daylight"));
    EXPECT_LT(length(std::get<SkyLight>(now.scene.lights.at(0).model).to_sun - direction), 5e-4) << hour;
  }
}

// The sun of one moment, or the mean of several while the sensor's shutter is open. Where it stands is what
// Mitsuba's sunsky has of the same hour.
TEST_F(MitsubaLoad, DaylightOverTime) {
  const auto lights = [&](const std::string& sensor, const std::string& emitter) {
    return read_mitsuba(
               folder_.write("scene.xml", "<scene version=\"3.0.0\">" + sensor + emitter + "</scene>"))
        .scene.lights;
  };
  const auto sun = [](const Light& light) { return std::get<SkyLight>(light.model).to_sun; };
  const std::string day =
      "<integer name=\"start_year\" value=\"2024\"/><integer name=\"start_month\" value=\"2\"/><integer "
      "name=\"start_day\" value=\"28\"/><integer name=\"end_year\" value=\"2024\"/><integer "
      "name=\"end_month\" value=\"3\"/><integer name=\"end_day\" value=\"2\"/>";
  const std::string timed = "<emitter type=\"timed_sunsky\">" + day + "</emitter>";
  const auto at = [&](int month, int date, double hour) {
    return sun(
        lights("", fmt::format("<emitter type=\"sunsky\"><integer name=\"year\" value=\"2024\"/><integer "
                               "name=\"month\" value=\"{}\"/><integer name=\"day\" value=\"{}\"/><float "
                               "name=\"hour\" value=\"{}\"/></emitter>",
                               month, date, hour))
            .at(0));
  };
  EXPECT_NO_THROW(at(13, -400, 7));
  EXPECT_THROW(at(std::numeric_limits<int>::min(), 28, 7), Error);
  EXPECT_THROW(at(2, std::numeric_limits<int>::max(), 7), Error);
  const auto once = lights("", timed);
  ASSERT_EQ(once.size(), 1u);
  EXPECT_LT(length(sun(once[0]) - at(2, 28, 7)), 1e-9);
  EXPECT_EQ(std::get<SkyLight>(once[0].model).sun_scale, 1);

  // Half of the shutter's time: the first one and a half of three days, of a leap year.
  const auto over =
      lights("<sensor type=\"perspective\"><float name=\"shutter_close\" value=\"0.5\"/></sensor>", timed);
  ASSERT_EQ(over.size(), 32u);
  EXPECT_EQ(std::get<SkyLight>(over[7].model).sky_scale, 1 / 32.0f);
  for (const int i : {0, 20, 25, 31}) {
    const double days = (i + 0.5) / 32 * 1.5, hour = 7 + 12 * (days - std::floor(days));
    EXPECT_LT(length(sun(over[static_cast<std::size_t>(i)]) - at(2, days < 1 ? 28 : 29, hour)), 1e-9) << i;
  }
  EXPECT_THROW(lights("",
                      "<emitter type=\"timed_sunsky\"><float name=\"window_end_time\" "
                      "value=\"3\"/></emitter>"),
               Error);
}

// The mean over the rectangle is that of a grid on it, on the side of its normal.
TEST_F(MitsubaLoad, IrradianceMetersAreMeasuredBySensors) {
  const auto says = [&](const std::string& shape, const std::string& more, const std::string& what) {
    const ImportedScene imported = read_mitsuba(folder_.write(
        "scene.xml", "<scene version=\"3.0.0\"><shape type=\"" + shape +
                         "\"><transform name=\"to_world\"><scale x=\"2\" y=\"3\" z=\"1\"/>" + more +
                         "</transform><sensor type=\"irradiancemeter\"/></shape></scene>"));
    return std::ranges::any_of(imported.diagnostics, [&](const Diagnostic& d) {
      return d.fidelity == Fidelity::dropped && d.message.find(what) != std::string::npos;
    });
  };
  EXPECT_TRUE(says("rectangle", "<translate x=\"10\" z=\"5\"/>", "plane 8 -3 5.0006  4 0 0  0 6 0  8x8"));
  EXPECT_TRUE(says("rectangle", "<scale x=\"-1\"/>", "plane 2 -3 0.0006  0 6 0  -4 0 0  8x8"));
  EXPECT_TRUE(says("disk", "", "sensor \"irradiancemeter\" of a disk"));
}

TEST_F(MitsubaLoad, WhatIsNotUsedIsReportedWithASuggestion) {
  material("<bsdf type=\"diffuse\" id=\"m\"><rgb name=\"reflectanse\" value=\"1 0 0\"/></bsdf>");
  EXPECT_TRUE(mentions("did you mean \"reflectance\""));
  material("<bsdf type=\"difuse\" id=\"m\"/>");
  EXPECT_TRUE(mentions("did you mean \"diffuse\""));
  material(
      "<integrator type=\"path\"><integer name=\"max_depth\" value=\"$depth\"/></integrator><bsdf "
      "type=\"diffuse\" id=\"m\"/>");
  EXPECT_TRUE(mentions("\"$depth\" has no <default>"));
}

TEST_F(MitsubaLoad, WhatAnAreaLightDoesNotUseIsReported) {
  imported_ = read(
      "<shape type=\"sphere\"><emitter type=\"area\"><rgb name=\"radianse\" value=\"1\"/></emitter></shape>");
  EXPECT_TRUE(mentions("did you mean \"radiance\""));
}

TEST_F(MitsubaLoad, LaterVersionsAreTold) {
  imported_ = read_mitsuba(folder_.write("scene.xml", "<scene version=\"4.0.0\"/>"));
  EXPECT_TRUE(mentions("version 4.0.0 is read as version 3"));
  imported_ = read_mitsuba(folder_.write("scene.xml", "<scene version=\"3.9.1\"/>"));
  EXPECT_FALSE(mentions("is read as version"));
}

// Names of version 0.6 are read in files without a version where the first file has that version. A file may
// hold one element alone.
TEST_F(MitsubaLoad, IncludedFilesAreOfTheFirstOnesVersion) {
  const std::string included =
      "<bsdf type=\"dielectric\" id=\"m\"><float name=\"intIOR\" value=\"2\"/></bsdf>";
  for (const std::string& text : {included, "<scene>" + included + "</scene>"}) {
    folder_.write("m.xml", text);
    imported_ = read_mitsuba(folder_.write(
        "scene.xml", "<scene version=\"0.6.0\"><include filename=\"m.xml\"/>" + floor + "</scene>"));
    const Material& material = imported_.scene.materials.at(imported_.scene.shapes.at(0).material.value);
    EXPECT_EQ(std::get<DielectricMaterial>(material.model).eta, Spectrum{ConstantSpectrum{2}});
  }
}

TEST_F(MitsubaLoad, MistakesAreErrorsWithTheirPlace) {
  EXPECT_THAT(error("<scene version=\"3.0.0\"><shape></scene>"), ::testing::HasSubstr("not XML"));
  EXPECT_THAT(error("<scene/>"), ::testing::HasSubstr("no version"));
  EXPECT_THAT(error("<teapot/>"), ::testing::HasSubstr("not a Mitsuba scene"));
  EXPECT_THAT(error_inside("<shap type=\"sphere\"/>"), ::testing::HasSubstr("did you mean <shape>"));
  EXPECT_THAT(
      error_inside("<bsdf type=\"diffuse\" id=\"wood\"/><shape type=\"sphere\"><ref id=\"wod\"/></shape>"),
      ::testing::HasSubstr("did you mean \"wood\""));
  EXPECT_THAT(error_inside("<shape type=\"sphere\"><float name=\"radius\" value=\"nan\"/></shape>"),
              ::testing::HasSubstr("finite number"));
  EXPECT_THAT(
      error_inside("<shape type=\"ply\"><string name=\"filename\" value=\"../../../../none.ply\"/></shape>"),
      ::testing::HasSubstr("none.ply"));
  EXPECT_THAT(error_inside("<shape type=\"ply\"><string name=\"filename\" value=\"/dev/zero\"/></shape>"),
              ::testing::HasSubstr("/dev/zero"));
  EXPECT_THAT(error_inside("<bsdf type=\"diffuse\" id=\"a\"/><bsdf type=\"diffuse\" id=\"a\"/>"),
              ::testing::HasSubstr("twice"));
}

// As programs on Windows write them.
TEST_F(MitsubaLoad, OtherEncodingsAndSeparators) {
  std::filesystem::create_directory(folder_ / "meshes");
  folder_.write("meshes/m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string text = head +
                           "<bsdf type=\"diffuse\" id=\"wei\xC3\x9F\"/><shape type=\"obj\"><string "
                           "name=\"filename\" value=\"meshes\\m.obj\"/><ref id=\"wei\xC3\x9F\"/></shape>" +
                           tail;
  std::string latin = "<?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>\n" + text, utf16 = "\xFF\xFE";
  for (std::size_t at = latin.find("\xC3\x9F"); at != std::string::npos; at = latin.find("\xC3\x9F"))
    latin.replace(at, 2, "\xDF");
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool two = text[i] == '\xC3';
    utf16 += two ? '\xDF' : text[i];
    utf16 += '\0';
    i += two;
  }
  for (const std::string& file : {text, "\xEF\xBB\xBF" + text, latin, utf16}) {
    const Scene scene = read_mitsuba(folder_.write("scene.xml", file)).scene;
    ASSERT_EQ(scene.materials.size(), 1u);
    EXPECT_EQ(scene.materials[0].name, "wei\xC3\x9F");
  }
}

TEST_F(MitsubaLoad, HarmIsBounded) {
  EXPECT_THAT(error_inside("<include filename=\"scene.xml\"/>"), ::testing::HasSubstr("includes itself"));
  EXPECT_THAT(error_inside("<bsdf type=\"twosided\" id=\"a\"><ref id=\"b\"/></bsdf><bsdf type=\"twosided\" "
                           "id=\"b\"><ref id=\"a\"/></bsdf>"),
              ::testing::HasSubstr("contains itself"));
  EXPECT_THAT(error_inside("<alias id=\"a\" as=\"b\"/><alias id=\"b\" as=\"a\"/><shape type=\"sphere\"><ref "
                           "id=\"a\"/></shape>"),
              ::testing::HasSubstr("stands for itself"));
  std::string deep, close;
  for (int i = 0; i < 100'000; ++i) deep += "<bsdf type=\"twosided\">", close += "</bsdf>";
  EXPECT_THAT(error_inside(deep + close), ::testing::HasSubstr("nested too deeply"));
  std::string laughs = "<default name=\"a0\" value=\"ha ha ha ha ha ha ha ha\"/>";
  for (int i = 1; i < 40; ++i) {
    const std::string before = "$a" + std::to_string(i - 1) + " ";
    laughs += "<default name=\"a" + std::to_string(i) + "\" value=\"";
    for (int k = 0; k < 10; ++k) laughs += before;
    laughs += "\"/>";
  }
  EXPECT_THAT(error_inside(laughs), ::testing::HasSubstr("without bound"));
  std::string blends = "<bsdf type=\"diffuse\" id=\"b0\"/>";
  for (int i = 1; i < 60; ++i) {
    const std::string ref = "<ref id=\"b" + std::to_string(i - 1) + "\"/>";
    blends += "<bsdf type=\"blendbsdf\" id=\"b" + std::to_string(i) + "\">" + ref + ref + "</bsdf>";
  }
  EXPECT_EQ(read(blends).scene.materials.size(), 60u) << "sharing is not copying";
  blends += "<bsdf type=\"twosided\"><ref id=\"b59\"/></bsdf>";
  EXPECT_EQ(read(blends).scene.materials.size(), 120u) << "nor where each is changed";
}

// Measured with 3.9.1: a point, spot, directional or projecting light is as many times as bright as "direct"
// has emitter_samples, lamps and constant light are not.
TEST_F(MitsubaLoad, DirectAddsUpSamplesOfLightsWithoutExtent) {
  const auto lights = [](const char* integrator) {
    return std::string(integrator) +
           "<emitter type=\"point\"><spectrum name=\"intensity\" value=\"2\"/></emitter>"
           "<emitter type=\"constant\"><spectrum name=\"radiance\" value=\"2\"/></emitter>";
  };
  const auto intensity = [&](const std::string& inside) {
    imported_ = read(inside);
    EXPECT_EQ(std::get<InfiniteLight>(imported_.scene.lights.at(1).model).radiance,
              Spectrum{ConstantSpectrum{2}});
    return std::get<PointLight>(imported_.scene.lights.at(0).model).intensity;
  };
  EXPECT_EQ(intensity(lights("<integrator type=\"direct\"><integer name=\"emitter_samples\" value=\"4\"/>"
                             "</integrator>")),
            Spectrum{ConstantSpectrum{8}});
  EXPECT_TRUE(mentions("4 times as bright"));
  EXPECT_EQ(intensity(lights("<integrator type=\"aov\"><integrator type=\"direct\"><integer "
                             "name=\"shading_samples\" value=\"3\"/></integrator></integrator>")),
            Spectrum{ConstantSpectrum{6}});
  EXPECT_EQ(intensity(lights("<integrator type=\"direct\"/>")), Spectrum{ConstantSpectrum{2}});
  EXPECT_FALSE(mentions("times as bright"));
  EXPECT_EQ(intensity(lights("<integrator type=\"path\"><integer name=\"emitter_samples\" value=\"4\"/>"
                             "</integrator>")),
            Spectrum{ConstantSpectrum{2}});
}

}  // namespace
}  // namespace vitrail::mitsuba_load_test
