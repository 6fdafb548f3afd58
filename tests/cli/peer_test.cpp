// SPDX-License-Identifier: Apache-2.0
// convert --check=peer: what it is that catches a difference.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/support/command.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::peer_test {
namespace {

using ::testing::HasSubstr;

class Peer : public ::testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }

  // The check of `in` by a program, whose words are those of a shell. In Mitsuba's place, $2 is the written
  // scene and $3 what it is compared with.
  test::CommandResult ask(const std::string& in, const std::string& program, const char* out = "out.xml") {
    const std::string peer = write("python", "#!/bin/sh\n" + program);
    std::filesystem::permissions(peer, std::filesystem::perms::owner_all);
    return test::run(test::vitrail("convert") + " " + in + " " + (folder_ / out).string() +
                     " --check=peer --peer " + peer);
  }

  test::TemporaryDirectory folder_;
};

constexpr const char* sensor = R"(<scene version="3.0.0"><integrator type="INTEGRATOR"/>
    <sensor type="perspective"><transform name="to_world"><lookat origin="0,0,4" target="0,0,0" up="0,1,0"/></transform>
    <film type="hdrfilm"><integer name="width" value="16"/><integer name="height" value="8"/></film></sensor>
    <emitter type="constant"/>)";

std::string scene(const std::string& integrator, const std::string& shapes) {
  std::string text = sensor;
  return text.replace(text.find("INTEGRATOR"), 10, integrator) + shapes + "</scene>";
}

TEST_F(Peer, AsksVitrailWhereItShowsNothingOfTheInput) {
  const std::string in = write("in.xml", scene("path", "<shape type=\"sphere\"/>"));
  const auto result = ask(in, R"(case $3 in
*.xml) echo '{"variants": [{"variant": "scalar_rgb", "loads": true, "passed": true, "not_compared": "no such plugin"}]}' ;;
*) echo '{"variants": [{"variant": "scalar_rgb", "loads": true, "passed": false, "compared_with": "vitrail",
  "luminance_ratio": 1.5, "worst_pixel": 0.9}]}' ;;
esac
)");
  EXPECT_EQ(result.status, 1) << result.output;
  EXPECT_THAT(result.output, HasSubstr("Mitsuba scalar_rgb shows it otherwise than vitrail shows the input"));
  EXPECT_THAT(result.output, HasSubstr("of the input it says: no such plugin"));
}

// A difference of a mean that is a third of its noise, and is one where there are more samples ($6).
TEST_F(Peer, SamplesMoreWhereNoiseLeavesRoomForADifference) {
  const std::string in = write("in.xml", scene("path", "<shape type=\"sphere\"/>"));
  const auto result = ask(in, R"(case $6 in
64) noise=0.3 passed=true ;;
*) noise=0.002 passed=false ;;
esac
echo '{"variants": [{"variant": "scalar_rgb", "loads": true, "passed": '$passed', "compared_with": "itself",
  "luminance_ratio": 1.1, "mean_noise": '$noise', "worst_pixel": 0.1, "pixel_noise": '$noise', "tolerance": 0.01}]}'
)");
  EXPECT_EQ(result.status, 1) << result.output;
  EXPECT_THAT(result.output, HasSubstr("luminance +10.00 % ± 0.20 %, a pixel of 64 by up to 10.0 % ± 0.2 %"));
}

TEST_F(Peer, AsksVitrailWhereItRefusesTheInput) {
  if (std::system("povray --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no povray on the path";
  const std::string in =
      write("in.pov",
            "#version 3.7; global_settings { assumed_gamma 1 } camera { location -4*z look_at 0 }\n"
            "light_source { <2, 3, -4> rgb 1 } plane { z, 0 pigment { rgb .5 } finish { ambient 0 } }\n");
  const auto result = ask(
      in, "case \"$*\" in *+I*/in.pov*) echo 'Parse Error: too old' >&2; exit 1;; esac\nexec povray \"$@\"\n",
      "out.pov");
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("POV-Ray shows it as vitrail shows the input"));
  EXPECT_THAT(result.output, HasSubstr("of the input it says: Parse Error: too old"));
}

const char* grey_plane =
    "#version 3.7; global_settings { assumed_gamma 1 } camera { location -4*z look_at 0 }\n"
    "light_source { <2, 3, -4> rgb 1 } plane { z, 0 pigment { rgb .5 } finish { ambient 0 } }\n";

// Half as bright again as the input's own program shows it, and as we do.
TEST_F(Peer, ComparesWithTheProgramOfTheInput) {
  if (std::system("povray --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no povray on the path";
  const auto result = ask(write("in.pov", grey_plane), R"(exec /usr/bin/python3 -c '
import json, sys
means, noise = json.load(open(sys.argv[2]))
print(json.dumps({"variants": [{"variant": "scalar_rgb", "loads": True, "passed": False, "compared_with": "vitrail",
  "luminance_ratio": 1.5, "worst_pixel": 0.9, "luminances": [1.5 * m for m in means], "noise": [0.0] * len(means)}]}))
' "$2" "$3"
)");
  EXPECT_EQ(result.status, 1) << result.output;
  EXPECT_THAT(result.output, HasSubstr("Mitsuba scalar_rgb shows it otherwise than POV-Ray shows the input"));
  EXPECT_THAT(result.output, HasSubstr("vitrail's picture is that of the input"));
}

// We stand in for pbrt: $7 is the picture, $8 the scene with another film, beside the scene.
TEST_F(Peer, ComparesPicturesOfPbrt) {
  const std::string in = write("in.pbrt", R"(LookAt 0 0 4 0 0 0 0 1 0 Camera "perspective" PixelFilter "box"
      Film "rgb" "integer xresolution" [ 16 ] "integer yresolution" 8 WorldBegin LightSource "infinite" "rgb L" [2 2 2]
      Material "diffuse" Shape "sphere")");
  const std::string run =
      fmt::format("exec '{}/vitrail-render' \"$8\" -o \"$7\" --spp 16 --quiet\n", test::bin_dir());
  const std::string more = "case $8 in *.out-*) sed -i 's/\\[ *2 2 2 *\\]/[2.2 2.2 2.2]/' \"$8\";; esac\n";
  const auto same = ask(in, run, "out.pbrt"), other = ask(in, more + run, "out.pbrt"),
             killed = ask(in, "case $8 in *.out-*) kill -SEGV $$;; esac\n" + run, "out.pbrt");
  EXPECT_EQ(same.status, 0) << same.output;
  EXPECT_THAT(same.output, HasSubstr("pbrt shows it as it shows the input: luminance"));
  EXPECT_EQ(killed.status, 1) << killed.output;
  EXPECT_THAT(killed.output, HasSubstr("it was ended by signal 11 (Segmentation fault)"));
  EXPECT_EQ(other.status, 1) << other.output;
  EXPECT_THAT(other.output, HasSubstr("pbrt shows it otherwise than it shows the input: luminance +10"));
  EXPECT_THAT(other.output, HasSubstr("vitrail's picture is that of the input"));
  for (const auto& file : std::filesystem::directory_iterator(folder_ / ""))
    EXPECT_THAT(file.path().filename().string(), ::testing::Not(HasSubstr("compared")));
}

class PeerMitsuba : public Peer {
 protected:
  void SetUp() override {
    if (std::system("python3 -c 'import mitsuba' >/dev/null 2>&1") != 0)
      GTEST_SKIP() << "no Mitsuba in the python3 on the path";
  }
};

// Its spectral variants have no number for an extinction that is 0 at some wavelengths alone.
TEST_F(PeerMitsuba, TakesAnInputWithoutNumbersForNoPicture) {
  const std::string in = write("in.xml", scene("volpath", R"(<shape type="sphere"><bsdf type="null"/>
      <medium type="homogeneous" name="interior"><spectrum name="sigma_t" value="500:1,600:1"/>
      <spectrum name="albedo" value="0"/></medium></shape>)"));
  const auto result = ask(in, "exec python3 \"$@\"\n");
  EXPECT_THAT(result.output, HasSubstr("Mitsuba scalar_spectral shows it"));
  EXPECT_THAT(result.output, HasSubstr("% of its pixels are no numbers"));
}

// Where the extinction ends at 400 and 600 nm, volpath lost 4 % of what the albedo scatters.
TEST_F(PeerMitsuba, SeesWhatExtinctionsThatEndWithinTheVisibleScatter) {
  const std::string in = write("in.xml", scene("volpath", R"(<shape type="sphere"><bsdf type="null"/>
      <medium type="homogeneous" name="interior"><spectrum name="sigma_t" value="400:.5,600:.9"/>
      <spectrum name="albedo" value=".8"/></medium></shape>)"));
  const auto result = ask(in, "exec python3 \"$@\"\n");
  EXPECT_EQ(result.status, 0) << result.output;
  EXPECT_THAT(result.output, HasSubstr("Mitsuba scalar_spectral shows it as vitrail shows the input"));
}

// What rgb variants cut of the input is said.
TEST_F(PeerMitsuba, SaysWhatRgbVariantsCutOfAnExtinction) {
  const std::string in = write("in.xml", scene("volpath", R"(<shape type="sphere"><bsdf type="null"/>
      <medium type="homogeneous" name="interior"><spectrum name="sigma_t" value="360:.5,500:4,600:1,830:3"/>
      <spectrum name="albedo" value=".8"/></medium></shape>)"));
  const auto result = ask(in, "exec python3 \"$@\"\n");
  EXPECT_THAT(result.output, HasSubstr("cut that of the input at 1"));
  EXPECT_THAT(result.output, HasSubstr("Mitsuba scalar_spectral shows it as it shows the input"));
}

// 4 % more light, of an input that it does not read.
TEST_F(PeerMitsuba, SeesFourPercentInRgbToo) {
  const std::string in = write("in.pbrt", R"(LookAt 0 0 4 0 0 0 0 1 0 Camera "perspective" PixelFilter "box"
      Film "rgb" "integer xresolution" 16 "integer yresolution" 8 WorldBegin LightSource "infinite" "rgb L" [2 2 2]
      Material "diffuse" Shape "sphere")");
  const std::string more = "sed -i 's/value=\"2 2 2\"/value=\"2.08 2.08 2.08\"/' \"$2\"\n",
                    run = "exec python3 \"$@\"\n";
  const auto same = ask(in, run), other = ask(in, more + run);
  EXPECT_EQ(same.status, 0) << same.output;
  EXPECT_EQ(other.status, 1) << other.output;
  EXPECT_THAT(other.output, HasSubstr("Mitsuba scalar_rgb shows it otherwise than vitrail shows the input"));
}

// Of a lamp that covers whole pixels of 64: a filter's reach in so small a picture is no difference.
TEST_F(PeerMitsuba, ComparesBoxesWhereFiltersReachDifferently) {
  const std::string in = write("in.pbrt", R"(LookAt 0 0 4 0 0 0 0 1 0
      Camera "orthographic" "float screenwindow" [-4 4 -4 4]
      PixelFilter "gaussian" "float xradius" 1.5 "float yradius" 1.5
      Film "rgb" "integer xresolution" 16 "integer yresolution" 16 WorldBegin
      AreaLightSource "diffuse" "rgb L" [2 2 2] Material "diffuse" "rgb reflectance" [0 0 0]
      Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point3 P" [-2 -2 0  2 -2 0  2 2 0  -2 2 0])");
  const auto result = ask(in, "exec python3 \"$@\"\n");
  EXPECT_EQ(result.status, 0) << result.output;
}

// The scale distorts the image there: one that was taken out made the picture brighter by a third.
TEST_F(PeerMitsuba, KeepsTheScaleThatDistortsAnEnvironment) {
  std::ofstream image(folder_ / "sky.pfm", std::ios::binary);
  image << "PF\n8 4\n-1.0\n";
  for (int i = 0; i < 32; ++i)
    for (const float value : {i < 8 ? 4.0f : 0.1f, 0.2f * static_cast<float>(i % 8), 0.5f})
      image.write(reinterpret_cast<const char*>(&value), sizeof value);
  image.close();
  std::string text = scene("path", R"(<emitter type="envmap"><string name="filename" value="sky.pfm"/>
      <transform name="to_world"><scale value="5"/></transform></emitter><shape type="sphere"/>)");
  text.erase(text.find("<emitter type=\"constant\"/>"), 26);
  const auto result = ask(write("in.xml", text), "exec python3 \"$@\"\n");
  EXPECT_EQ(result.status, 0) << result.output;
}

// On a machine other than Windows POV-Ray refuses the word `bmp`.
// One grey pixel of inks: each of the four components is a block without differences.
std::string jpeg_of_inks() {
  const auto segment = [](char marker, const std::string& content) {
    return std::string{'\xff', marker, 0, static_cast<char>(content.size() + 2)} + content;
  };
  const std::string one_code = '\1' + std::string(16, '\0');  // a table of one value, 0, which is one bit
  std::string frame{8, 0, 1, 0, 1, 4}, scan{4};
  for (char component = 1; component <= 4; ++component)
    frame += std::string{component, 0x11, 0}, scan += std::string{component, 0};
  return "\xff\xd8" + segment('\xdb', '\0' + std::string(64, '\1')) + segment('\xc0', frame) +
         segment('\xc4', '\0' + one_code) + segment('\xc4', '\x10' + one_code) +
         segment('\xda', scan + std::string{0, 63, 0}) + std::string{0} + "\xff\xd9";
}

TEST_F(Peer, WritesImagesForPovRayAsAnotherKind) {
  if (std::system("povray --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no povray on the path";
  constexpr unsigned char bitmap[]{'B', 'M', 58, 0, 0, 0, 0, 0, 0,  0, 54, 0, 0, 0, 40, 0,  0,   0, 1, 0,
                                   0,   0,   1,  0, 0, 0, 1, 0, 24, 0, 0,  0, 0, 0, 4,  0,  0,   0, 0, 0,
                                   0,   0,   0,  0, 0, 0, 0, 0, 0,  0, 0,  0, 0, 0, 40, 80, 160, 0};
  std::ofstream(folder_ / "colour.bmp", std::ios::binary)
      .write(reinterpret_cast<const char*>(bitmap), sizeof bitmap);
  std::ofstream(folder_ / "inks.jpg", std::ios::binary) << jpeg_of_inks();
  for (const char* name : {"colour.bmp", "inks.jpg"}) {
    const auto result =
        ask(write("in.xml", scene("path", fmt::format(R"(<shape type="rectangle"><bsdf type="diffuse">
      <texture type="bitmap" name="reflectance"><string name="filename" value="{}"/></texture></bsdf></shape>)",
                                                      name))),
            "exec povray \"$@\"\n", "out.pov");
    EXPECT_THAT(result.output, HasSubstr("POV-Ray shows it")) << name;
    EXPECT_THAT(result.output, ::testing::Not(HasSubstr("refuses"))) << name;
  }
}

}  // namespace
}  // namespace vitrail::peer_test
