// SPDX-License-Identifier: Apache-2.0
// vitrail convert as a user runs it: the report, --strict, the exit status.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>

#include "tests/support/command.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::convert_test {
namespace {

using ::testing::HasSubstr;

class Convert : public ::testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }
  std::string path(const char* name) const { return (folder_ / name).string(); }
  test::CommandResult convert(const std::string& arguments) {
    return test::run(test::vitrail("convert") + " " + arguments);
  }

  const std::string triangle_ = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]\n";
  test::TemporaryDirectory folder_;
};

TEST_F(Convert, SaysWhatBecameOfEachItem) {
  const std::string in =
      write("in.pbrt",
            "Film \"rgb\" PixelFilter \"box\"\nWorldBegin\nMaterial \"diffuse\"\n" + triangle_ +
                "MakeNamedMaterial \"coat\"\n \"string type\" \"coateddiffuse\"\nNamedMaterial \"coat\"\n" +
                triangle_);
  const auto result = convert(in + " " + path("out.xml") + " --report " + path("report.json"));
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("1 approximated, 0 dropped"));
  EXPECT_THAT(result.output, HasSubstr("in.pbrt:5:1"));
  const nlohmann::json report = test::read_json(path("report.json"));
  EXPECT_EQ(report.at("approximated"), 1);
  bool found = false;
  for (const auto& item : report.at("items")) {
    if (item.at("item") != "material \"coat\"") continue;
    found = true;
    EXPECT_EQ(item.at("fidelity"), "approximated");
    EXPECT_EQ(item.at("line"), 5);
    EXPECT_THAT(item.at("notes").at(0).at("what").get<std::string>(), HasSubstr("plastic"));
  }
  EXPECT_TRUE(found) << report.dump(1);
}

// Five kinds of loss, one of eight materials: each kind once, what is dropped first. As a page, each with all
// of its places.
TEST_F(Convert, NotesAreGroupedAndNoneIsHidden) {
  std::string text = "Film \"rgb\" PixelFilter \"box\"\nWorldBegin\n";
  for (int i = 0; i < 8; ++i)
    text += "MakeNamedMaterial \"coat" + std::to_string(i) + "\" \"string type\" \"coateddiffuse\"\n";
  for (const char* kind : {"wrinkled", "marble", "dots"})
    text += fmt::format("Texture \"{0}<&>\" \"spectrum\" \"{0}\"\n", kind);
  text += "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"rgb Le\" [5 5 5]\n" + triangle_;
  const auto result =
      convert(write("in.pbrt", text) + " " + path("out.xml") + " --report " + path("report.html"));
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("in between (and 7 more)")) << "coats";
  for (const char* kind : {"wrinkled", "marble", "dots"})
    EXPECT_THAT(result.output, HasSubstr(fmt::format("texture \"{}<&>\"", kind))) << "each has another mean";
  EXPECT_THAT(result.output, ::testing::Not(HasSubstr("\n  and "))) << "nothing is hidden";
  EXPECT_LT(result.output.find("dropped:\n"), result.output.find("approximated:\n"));
  std::ifstream file(path("report.html"));
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  EXPECT_THAT(page, HasSubstr("<details><summary>and 7 more</summary>"));
  for (int line = 3; line < 11; ++line)
    EXPECT_THAT(page, HasSubstr("in.pbrt:" + std::to_string(line) + ":1</code>"));
  EXPECT_THAT(page, ::testing::AllOf(HasSubstr("dots&lt;&amp;&gt;"), ::testing::Not(HasSubstr("dots<&>"))));
}

// What the scene refers to elsewhere comes along, by its name.
TEST_F(Convert, PacksWhatTheSceneRefersTo) {
  for (const char* folder : {"a", "b", "out"}) std::filesystem::create_directory(folder_ / folder);
  write("a/wood.ptx", "one");
  write("b/wood.ptx", "two");
  write("out/near.ptx", "three");
  std::string text = "Film \"rgb\" PixelFilter \"box\"\nWorldBegin\n";
  for (const char* file : {"a/wood", "b/wood", "out/near"})
    text += std::string("Texture \"") + file + "\" \"spectrum\" \"ptex\" \"string filename\" \"" + file +
            ".ptx\"\n";
  const std::string in = write("in.pbrt", text + triangle_);
  const auto result = convert(in + " " + path("out/scene.pbrt") + " --pack");
  EXPECT_EQ(result.status, 0) << result.output;
  const auto content = [&](const char* name) {
    std::ifstream file(path(name));
    return std::string{std::istreambuf_iterator<char>(file), {}};
  };
  EXPECT_EQ(content("out/scene-files/wood.ptx"), "one");
  EXPECT_EQ(content("out/scene-files/wood-2.ptx"), "two");
  EXPECT_FALSE(std::filesystem::exists(path("out/scene-files/near.ptx"))) << "it is there";
  EXPECT_THAT(content("out/scene.pbrt"),
              ::testing::AllOf(HasSubstr("\"scene-files/wood-2.ptx\""), HasSubstr("\"near.ptx\"")));
  EXPECT_EQ(convert(in + " --to xml -o " + path("many") + " --pack").status, 2);
}

// One rule for all formats, and inspect's too.
TEST_F(Convert, LostImagesAreRefused) {
  const std::string in = write("in.pbrt",
                               "WorldBegin\nLightSource \"infinite\"\n"
                               "Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"lost.png\"\n"
                               "Material \"diffuse\" \"texture reflectance\" \"t\"\n" +
                                   triangle_);
  const auto names_the_place = ::testing::AllOf(HasSubstr("in.pbrt:3:1: cannot find the file"),
                                                HasSubstr("lost.png"), HasSubstr("--missing=replace"));
  for (const char* name : {"out.pbrt", "out.xml", "out.pov", "out.obj"}) {
    const auto refused = convert(in + " " + path(name));
    EXPECT_EQ(refused.status, 3) << name;
    EXPECT_THAT(refused.output, names_the_place);
    EXPECT_FALSE(std::filesystem::exists(path(name)));
    const auto replaced = convert(in + " " + path(name) + " --missing=replace");
    EXPECT_EQ(replaced.status, 0) << replaced.output;
    EXPECT_THAT(replaced.output, HasSubstr("grey 0.5 stands for it"));
  }
  const auto inspected = test::run(test::vitrail("inspect") + " " + in);
  EXPECT_EQ(inspected.status, 3);
  EXPECT_THAT(inspected.output, names_the_place);
}

TEST_F(Convert, RecordsOfOnePlaceAreTwoItems) {
  write("in.mtl", "newmtl wood\nKd 1 1 1\nKs 1 1 1\nillum 2\nmap_Kd -t 1 1 1 wood.png\n");
  write("wood.png", "");
  const std::string in = write("in.obj", "mtllib in.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl wood\nf 1 2 3\n");
  const auto result = convert(in + " " + path("out.pbrt") + " --report " + path("report.json"));
  EXPECT_EQ(result.status, 0) << result.output;
  std::map<std::string, std::string> fidelity;
  const nlohmann::json report = test::read_json(path("report.json"));
  for (const auto& item : report.at("items")) fidelity[item.at("item")] = item.at("fidelity");
  EXPECT_EQ(fidelity.at("texture"), "exact") << "what is lost is the material's";
  EXPECT_EQ(fidelity.at("material \"wood\""), "dropped");
}

TEST_F(Convert, EveryItemIsThere) {
  const std::string in = write(
      "in.pbrt",
      "LookAt 0 0 5 0 0 0 0 1 0\nCamera \"perspective\"\nSampler \"halton\" \"integer pixelsamples\" 8\n"
      "Integrator \"path\"\nPixelFilter \"box\"\nFilm \"rgb\"\nWorldBegin\nMaterial \"diffuse\"\n" +
          triangle_);
  const auto result = convert(in + " " + path("out.xml") + " --report " + path("report.json"));
  EXPECT_EQ(result.status, 0) << result.output;
  std::map<std::string, int> lines;
  const nlohmann::json report = test::read_json(path("report.json"));
  for (const auto& item : report.at("items")) lines[item.at("item")] = item.at("line");
  EXPECT_EQ(
      lines,
      (std::map<std::string, int>{
          {"camera", 2}, {"sampler", 3}, {"integrator", 4}, {"film", 6}, {"material", 8}, {"shape", 9}}));
}

TEST_F(Convert, WritesEveryFormat) {
  const std::string in =
      write("in.pbrt", "Film \"rgb\" PixelFilter \"box\" WorldBegin LightSource \"point\" " + triangle_);
  for (const char* out : {"out.pbrt", "out.xml", "out.pov", "out.obj", "out.ply"}) {
    const auto result = convert(in + " " + path(out));
    EXPECT_EQ(result.status, 0) << out << result.output;
    EXPECT_TRUE(std::filesystem::exists(path(out))) << out;
  }
}

TEST_F(Convert, StrictIsForWhatIsExact) {
  const std::string exact =
      write("exact.pbrt", "Film \"rgb\" PixelFilter \"box\" WorldBegin LightSource \"point\" " + triangle_);
  EXPECT_EQ(convert(exact + " " + path("exact.xml") + " --strict").status, 0);
  const std::string curve = write("curve.pbrt",
                                  "Film \"rgb\" PixelFilter \"box\" WorldBegin Shape \"curve\" \"point3 P\" "
                                  "[0 0 0 1 0 0 2 1 0 3 0 0]");
  const auto result = convert(curve + " " + path("curve.xml") + " --strict");
  EXPECT_EQ(result.status, 3) << result.output;
  EXPECT_FALSE(std::filesystem::exists(path("curve.xml")))
      << "nothing is written of what is not read exactly";
}

// A stand-in for the Python that has Mitsuba.
TEST_F(Convert, AsksThePeer) {
  const std::string in =
      write("in.pbrt",
            "LookAt 0 0 5 0 0 0 0 1 0 Camera \"perspective\" Film \"rgb\" \"integer xresolution\" 16 "
            "\"integer yresolution\" 8 WorldBegin LightSource \"infinite\" " +
                triangle_);
  const auto ask = [&](const std::string& says) {
    const std::string peer = write("python", "#!/bin/sh\ncat <<'END'\n" + says + "\nEND\n");
    std::filesystem::permissions(peer, std::filesystem::perms::owner_all);
    return convert(in + " " + path("out.xml") + " --check=peer --peer " + peer + " --report " +
                   path("report.json"));
  };
  const auto refused = ask(
      R"({"variants": [{"variant": "scalar_rgb", "loads": false, "passed": false, "said": "two meshes"}]})");
  EXPECT_EQ(refused.status, 1) << refused.output;
  EXPECT_THAT(refused.output, HasSubstr("Mitsuba scalar_rgb refuses it: two meshes"));
  EXPECT_EQ(test::read_json(path("report.json")).at("peer").at("passed"), false);
  const auto shown = ask(
      R"({"variants": [{"variant": "scalar_rgb", "loads": true, "passed": true, "compared_with": "vitrail", "luminance_ratio": 1.0, "worst_pixel": 0.01}]})");
  EXPECT_EQ(shown.status, 0) << shown.output;
  EXPECT_THAT(shown.output, HasSubstr("Mitsuba scalar_rgb shows it as vitrail shows the input"));
  const auto missing = convert(in + " " + path("out.xml") + " --check=peer --peer " + path("nowhere"));
  EXPECT_EQ(missing.status, 2) << missing.output;
  EXPECT_EQ(convert(in + " " + path("out.xml") + " --peer " + path("python")).status, 2);
  EXPECT_EQ(convert(in + " " + path("out.ply") + " --check=peer").status, 2);
}

TEST_F(Convert, PovRayTakesWhatIsWritten) {
  if (std::system("povray --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no povray on the path";
  const std::string in = write("in.pbrt",
                               "LookAt 0 0 5 0 0 0 0 1 0 Camera \"perspective\" Film \"rgb\" WorldBegin "
                               "LightSource \"point\" Texture \"t\" \"spectrum\" \"imagemap\" \"string "
                               "filename\" \"t.pfm\" Material \"diffuse\" \"texture reflectance\" \"t\" " +
                                   triangle_);
  write("t.pfm", std::string("PF\n1 1\n-1.0\n") + std::string(12, '\0'));
  const auto result = convert(in + " " + path("out.pov") + " --check=peer");
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("POV-Ray renders it"));  // it is black
  std::ifstream written(path("out.pov"));
  const std::string text{std::istreambuf_iterator<char>(written), {}};
  EXPECT_THAT(text, HasSubstr("image_map"));
}

TEST_F(Convert, PovRayShowsWhatIsWritten) {
  if (std::system("povray --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no povray on the path";
  const std::string in = write("in.pbrt", R"(LookAt 0 0 5 0 0 0 0 1 0 Camera "perspective" PixelFilter "box"
          Film "rgb" "integer xresolution" 40 "integer yresolution" 20 WorldBegin
          AttributeBegin Translate 0 0 4 LightSource "point" AttributeEnd
          AttributeBegin AreaLightSource "diffuse" "rgb L" [2 1.5 1]
          Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [2 2 2 2 3 2 3 3 2 3 2 2] AttributeEnd
          Texture "t" "spectrum" "imagemap" "string filename" "t.pfm" Material "diffuse" "texture reflectance" "t"
          Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-9 -9 0 9 -9 0 9 9 0 -9 9 0])");
  write("t.pfm", std::string("PF\n1 1\n-1.0\n") + std::string("\0\0\0\x3f\0\0\0\x3f\0\0\0\x3f", 12));  // ½
  const auto asked = convert(in + " " + path("out.pov") + " --check=peer");
  EXPECT_EQ(asked.status, 0) << asked.output;
  EXPECT_THAT(asked.output, HasSubstr("looks the same"));
  EXPECT_THAT(asked.output, HasSubstr("POV-Ray shows it as vitrail shows the input"));
  const std::string other = write("other.sh",
                                  "#!/bin/sh\n"  // with one more lamp
                                  "for word; do case $word in +I*) scene=${word#+I};; esac; done\n"
                                  "echo 'light_source { <0, 1, 4> color rgb 1 }' >> \"$scene\"\n"
                                  "exec povray \"$@\"\n");
  std::filesystem::permissions(other, std::filesystem::perms::owner_all);
  const auto spoilt = convert(in + " " + path("out.pov") + " --check=peer --peer " + other);
  EXPECT_EQ(spoilt.status, 1) << spoilt.output;
  EXPECT_THAT(spoilt.output, HasSubstr("POV-Ray shows it otherwise than vitrail shows the input"));
}

TEST_F(Convert, InspectKnowsEverySpectrum) {
  const std::string in =
      write("in.pbrt",
            "Film \"rgb\" WorldBegin Texture \"t\" \"spectrum\" \"constant\" \"rgb value\" [3 2 1] "
            "Material \"diffuse\" \"texture reflectance\" \"t\" " +
                triangle_);
  const auto result = test::run(test::vitrail("inspect") + " " + in);
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("unbounded RGB"));
}

TEST_F(Convert, MistakesHaveTheirStatus) {
  const std::string in = write("in.pbrt", "Film \"rgb\" PixelFilter \"box\" WorldBegin " + triangle_);
  EXPECT_EQ(convert(in + " " + path("out.blend")).status, 2);
  EXPECT_EQ(convert(in + " " + in).status, 2) << "over itself";
  EXPECT_EQ(convert(path("none.pbrt") + " " + path("out.xml")).status, 3);
  EXPECT_EQ(convert(in + " /proc/none/out.xml").status, 4);
}

TEST_F(Convert, ManyScenesBecomeOneFormat) {
  std::filesystem::create_directories(folder_ / "in/deep");
  const std::string scene = "Film \"rgb\"\nWorldBegin\nLightSource \"infinite\"\nInclude \"part.pbrt\"\n";
  write("in/a.pbrt", scene);
  write("in/part.pbrt", triangle_);  // no scene of its own
  write("in/deep/b.pbrt", "WorldBegin\n" + triangle_);
  write("in/deep/broken.pbrt", "WorldBegin\nShape\n");
  const std::string command = path("in") + " --to xml -o " + path("in/out");
  const auto result = convert(command);
  EXPECT_EQ(result.status, 3) << result.output;
  EXPECT_THAT(result.output, HasSubstr("broken.pbrt:"));
  EXPECT_THAT(result.output, HasSubstr("3 scenes: 2 converted, 0 that look different, 1 refused, 0 failed"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "in/out/a.xml"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "in/out/part.xml"));
  EXPECT_EQ(test::read_json(folder_ / "in/out/deep/b.report.json").at("dropped"), 0);

  std::filesystem::remove(folder_ / "in/out/a.report.json");  // as if it had been ended there
  write("in/deep/broken.pbrt", "WorldBegin\n" + triangle_);
  const auto again = convert(command);
  EXPECT_EQ(again.status, 0) << again.output;
  EXPECT_THAT(again.output, HasSubstr("b.xml: converted already"));
  EXPECT_THAT(again.output, ::testing::Not(HasSubstr("a.xml: converted already")));
  EXPECT_THAT(convert(command + " --again").output, ::testing::Not(HasSubstr("already")));
  EXPECT_THAT(convert(command + " --tessellate 5").output, ::testing::Not(HasSubstr("already")));
  for (int i = 0; i < 2; ++i) EXPECT_EQ(convert(command + " --strict").status, 3);
}

TEST_F(Convert, ScenesOfOneNameKeepTheirExtensions) {
  write("in.pbrt", "WorldBegin\n" + triangle_);
  write("in.xml", "<scene version=\"3.0.0\"><sensor type=\"perspective\"/><shape type=\"cube\"/></scene>");
  const auto result = convert(path("in.pbrt") + " " + path("in.xml") + " --to pbrt -o " + path("out"));
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/in.pbrt.pbrt"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/in.xml.pbrt"));
  EXPECT_EQ(convert(path("in.pbrt") + " " + path("in.pbrt") + " --to xml -o " + path("out")).status, 2);
}

TEST_F(Convert, ACheckSeesWhatLooksDifferent) {
  const std::string light =
      "Film \"rgb\" \"integer xresolution\" 48 \"integer yresolution\" 48\nCamera "
      "\"perspective\"\nWorldBegin\n"
      "LightSource \"infinite\"\nTranslate 0 0 3\n";
  const std::string same = write("same.pbrt", light + "Material \"diffuse\"\nShape \"sphere\"\n");
  const auto good = convert(same + " " + path("same.xml") + " --check --report " + path("report.json"));
  EXPECT_EQ(good.status, 0) << good.output;
  EXPECT_THAT(good.output, HasSubstr("looks the same"));
  const auto pictures = test::read_json(path("report.json")).at("pictures");
  EXPECT_EQ(pictures.at("passed"), true);
  EXPECT_EQ(pictures.at("samples"), 32);

  // Mitsuba's media do not shine.
  const std::string glow =
      write("glow.pbrt", light +
                             "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"rgb Le\" [5 5 5]\n"
                             "MediumInterface \"m\" \"\"\nMaterial \"interface\"\nShape \"sphere\"\n");
  const auto bad = convert(glow + " " + path("glow.xml") + " --check");
  EXPECT_EQ(bad.status, 1) << bad.output;
  EXPECT_THAT(bad.output, HasSubstr("looks different"));
  EXPECT_EQ(convert(same + " " + path("same.pov") + " --check").status, 0);

  const std::string nothing =
      write("nothing.pbrt", "Camera \"perspective\"\nWorldBegin\nTranslate 0 0 3\nShape \"sphere\"\n");
  const auto black = convert(nothing + " " + path("nothing.xml") + " --check");
  EXPECT_EQ(black.status, 0) << black.output;
  EXPECT_THAT(black.output, HasSubstr("looks the same: the scene shows nothing"));
}

TEST_F(Convert, ACheckTakesMoreSamplesWhereNoiseHidesTheMean) {
  // A lamp within glass is found by chance alone.
  const std::string noisy =
      write("noisy.pbrt",
            "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8\nPixelFilter \"box\"\n"
            "Camera \"perspective\"\nWorldBegin\nTranslate 0 0 3\nShape \"disk\" \"float radius\" 9 \"float "
            "height\" 3\n"
            "Material \"dielectric\"\nShape \"sphere\" \"float radius\" 0.5\n"
            "AreaLightSource \"diffuse\" \"float scale\" 50\nShape \"sphere\" \"float radius\" 0.1\n");
  const auto result = convert(noisy + " " + path("noisy.xml") + " --check --report " + path("report.json"));
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_EQ(test::read_json(path("report.json")).at("pictures").at("samples"), 256) << result.output;
}

}  // namespace
}  // namespace vitrail::convert_test
