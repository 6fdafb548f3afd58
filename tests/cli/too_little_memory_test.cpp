// SPDX-License-Identifier: Apache-2.0
// `--memory` of any size, for every kind of picture, whose reader is a library that no exception may pass: a
// verb does its work or refuses it with status 4, and names one budget, which is enough.
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <optional>
#include <regex>

#include "images/image_files.h"
#include "tests/support/command.h"
#include "tests/support/long_tests.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::too_little_memory_test {
namespace {

using testing::HasSubstr;

constexpr std::array<std::string_view, 15> kinds{"bmp", "dpx", "exr", "fits", "hdr", "iff", "jp2", "jpg",
                                                 "png", "ppm", "psd", "sgi",  "tga", "tif", "webp"};
constexpr std::array budgets{8, 12, 16, 24, 32, 48, 64, 100, 128, 144, 160, 192, 256, 512};  // MiB

// A fifth of them, so that each meets a fifth of the kinds; with VITRAIL_LONG_TESTS all.
std::vector<int> budgets_of(std::string_view kind) {
  const auto place = static_cast<std::size_t>(std::ranges::find(kinds, kind) - kinds.begin());
  std::vector<int> chosen;
  for (std::size_t i = 0; i < budgets.size(); ++i)
    if (are_long() || (i + place) % 5 == 0) chosen.push_back(budgets[i]);
  return chosen;
}

constexpr const char* head =
    "LookAt 0 0 5 0 0 0 0 1 0\nCamera \"perspective\"\n"
    "Film \"rgb\" \"integer xresolution\" 16 \"integer yresolution\" 16\nWorldBegin\n"
    "LightSource \"infinite\"\n";
constexpr const char* square =
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point3 P\" [-1 -1 0 1 -1 0 1 1 0 -1 1 0] "
    "\"point2 uv\" [0 0 1 0 1 1 0 1]\n";

// The one budget that a refusal names, MiB.
std::optional<int> named_budget(const std::string& said) {
  const std::regex words("(?:try --memory |at least )(\\d+)M\\b");
  std::optional<int> only;
  for (std::sregex_iterator it(said.begin(), said.end(), words), end; it != end; ++it) {
    if (only) return std::nullopt;
    only = std::stoi((*it)[1]);
  }
  return only;
}

class TooLittleMemory : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  // Of side × side texels with some noise, in the library's own defaults or with 16 bits. False where this
  // one is not built with that kind.
  bool write_picture(const std::string& name, int side, bool with_16_bits = false) const {
    const auto out = OIIO::ImageOutput::create(path(name));
    if (!out) return false;
    std::vector<float> values;
    for (int i = 0; i < side * side * 3; ++i)
      values.push_back(0.5f + 0.4f * static_cast<float>(std::sin(i * 1.7 + i % 91)));
    const OIIO::TypeDesc of_kind = out->supports("float") ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8;
    const OIIO::ImageSpec spec(side, side, 3,
                               with_16_bits ? OIIO::TypeDesc(OIIO::TypeDesc::UINT16) : of_kind);
    const bool written =
        out->open(path(name), spec) && out->write_image(OIIO::TypeDesc::FLOAT, values.data());
    EXPECT_TRUE(written) << name << ": " << out->geterror();
    return written && out->close();
  }
  static std::string with_picture(const std::string& picture) {
    return fmt::format(
        "{}Texture \"t\" \"spectrum\" \"imagemap\" \"string filename\" \"{}\"\n"
        "Material \"diffuse\" \"texture reflectance\" \"t\"\n{}",
        head, picture, square);
  }
  CommandResult partition(const std::string& scene, const std::string& more) const {
    return run(fmt::format("{} '{}' -o '{}' --force --no-cache --no-sync --quiet --stats '{}' {}",
                           vitrail("partition"), path(scene), path("out.vit"), path("stats.json"), more));
  }
  std::uint64_t peak_bytes() const {
    return read_json(folder_ / "stats.json")["peak_rss_bytes"].get<std::uint64_t>();
  }
  void expect_done_or_refused(const std::string& command, const std::string& what) const {
    const CommandResult result = run(command);
    EXPECT_TRUE(result.status == 0 || result.status == 4) << what << ": " << result.status << "\n"
                                                          << result.output;
    if (result.status == 4) {
      EXPECT_TRUE(named_budget(result.output)) << what << ":\n" << result.output;
    }
  }
  // Each budget is enough, or what is named in its place is, and a tenth less is not. Every second one of the
  // ladder and the last; with VITRAIL_LONG_TESTS all.
  void expect_right_budgets(const std::string& scene, const std::vector<int>& ladder) const {
    std::map<int, CommandResult> runs;
    const auto run_in = [&](int budget) -> const CommandResult& {
      const auto [it, is_new] = runs.try_emplace(budget);
      if (is_new) it->second = partition(scene, fmt::format("--memory {}M", budget));
      if (is_new && it->second.status == 0) {
        EXPECT_LE(peak_bytes(), std::uint64_t(budget) << 20) << scene;
      }
      return it->second;
    };
    int refused = 0, kept = 0;
    for (std::size_t i = 0; i < ladder.size(); ++i) {
      if (!are_long() && i % 2 == 1 && i + 1 < ladder.size()) continue;
      const int budget = ladder[i];
      const CommandResult& first = run_in(budget);
      ++(first.status == 0 ? kept : refused);
      if (first.status == 0) continue;
      ASSERT_EQ(first.status, 4) << scene << " in " << budget << "M: " << first.output;
      const std::optional<int> named = named_budget(first.output);
      ASSERT_TRUE(named) << first.output;
      EXPECT_EQ(run_in(*named).status, 0) << scene << ": " << first.output << run_in(*named).output;
      EXPECT_EQ(run_in(*named * 9 / 10).status, 4)
          << scene << " in " << *named * 9 / 10 << "M: " << first.output;
    }
    EXPECT_GT(refused, 0) << scene << ": the ladder is too high to tell";
    EXPECT_GT(kept, 0) << scene << ": the ladder is too low to tell";
  }
  TemporaryDirectory folder_;
};

TEST_F(TooLittleMemory, IsDoneOrRefusedForEachKindOfPicture) {
  write("none.pbrt", std::string(head) + square);
  ASSERT_EQ(partition("none.pbrt", "").status, 0);
  const auto without = static_cast<std::int64_t>(peak_bytes());
  std::int64_t most = 0;
  for (const std::string_view name : kinds) {
    const std::string kind(name);
    if (!write_picture("picture." + kind, 64)) continue;
    write("a.pbrt", with_picture("picture." + kind));
    const CommandResult plenty = partition("a.pbrt", "");
    ASSERT_EQ(plenty.status, 0) << kind << ": " << plenty.output;
    const std::int64_t more =
        static_cast<std::int64_t>(peak_bytes()) - without;  // below 0: another cache of files
    most = std::max(most, more);
    EXPECT_LE(more, static_cast<std::int64_t>(image_library_bytes))
        << kind << ": the library's need is stated too low";
    for (const int budget : budgets_of(kind)) {
      const std::string what = fmt::format("{} in {}M", kind, budget),
                        memory = fmt::format("--memory {}M", budget);
      expect_done_or_refused(fmt::format("{} '{}' --quiet {}", vitrail("inspect"), path("a.pbrt"), memory),
                             "inspect " + what);
      expect_done_or_refused(fmt::format("{} '{}' -o '{}' --force --no-cache --no-sync --quiet {}",
                                         vitrail("partition"), path("a.pbrt"), path("out.vit"), memory),
                             "partition " + what);
    }
    expect_done_or_refused(fmt::format("{} '{}' -o '{}' --force --spp 1 --no-cache --quiet --memory 12M",
                                       vitrail("render"), path("a.pbrt"), path("out.film")),
                           "render " + kind);
  }
  EXPECT_GT(most, static_cast<std::int64_t>(image_library_bytes / 4 * 3))
      << "the library's need is stated too high";
}

TEST_F(TooLittleMemory, TheBudgetThatIsNamedIsEnoughForPictures) {
  ASSERT_TRUE(write_picture("small.png", 64, true) && write_picture("middle.png", 512, true) &&
              write_picture("large.png", 2048, true));
  for (const char* picture : {"small.png", "middle.png", "large.png"}) {
    write("a.pbrt", with_picture(picture));
    expect_right_budgets("a.pbrt", {8, 16, 32, 64, 128, 256});
  }
}

// images/byte_rows.h: those of 8 bits.
TEST_F(TooLittleMemory, PlainPicturesDoWithoutTheLibrary) {
  for (const auto& [name, side] :
       {std::pair{"plain.png", 64}, {"plain.png", 2048}, {"plain.jpg", 64}, {"plain.jpg", 2048}}) {
    ASSERT_TRUE(write_picture(name, side));
    write("a.pbrt", with_picture(name));
    const CommandResult refused = partition("a.pbrt", "--memory 8M");
    ASSERT_EQ(refused.status, 4) << refused.output;
    const std::optional<int> named = named_budget(refused.output);
    ASSERT_TRUE(named) << refused.output;
    EXPECT_LT(*named, static_cast<int>(image_library_bytes >> 20) / 4) << refused.output;
    EXPECT_EQ(partition("a.pbrt", fmt::format("--memory {}M", *named)).status, 0) << *named;
    EXPECT_LE(peak_bytes(), std::uint64_t(*named) << 20);
  }
}

// A wavy square of 2·side² triangles: its points.
struct Waves {
  std::vector<std::array<double, 3>> points;
  std::vector<std::array<int, 3>> triangles;
};
Waves waves(int side, int kind = 0) {
  Waves w;
  for (int y = 0; y <= side; ++y)
    for (int x = 0; x <= side; ++x)
      w.points.push_back({double(x), double(y), std::sin(x * 0.3 + kind) * std::cos(y * 0.2)});
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const int a = y * (side + 1) + x, b = a + side + 1;
      w.triangles.push_back({a, a + 1, b});
      w.triangles.push_back({b, a + 1, b + 1});
    }
  return w;
}
std::string as_pbrt(const Waves& w) {
  std::string points, numbers;
  for (const auto& p : w.points) points += fmt::format("{} {} {:.3f} ", p[0], p[1], p[2]);
  for (const auto& t : w.triangles) numbers += fmt::format("{} {} {} ", t[0], t[1], t[2]);
  return fmt::format("Shape \"trianglemesh\" \"point3 P\" [{}] \"integer indices\" [{}]\n", points, numbers);
}

TEST_F(TooLittleMemory, TheBudgetThatIsNamedIsEnoughForInstances) {
  ASSERT_TRUE(write_picture("small.png", 64, true));
  std::string scene = with_picture("small.png");
  for (int object = 0; object < 4; ++object)
    scene += fmt::format("ObjectBegin \"{}\"\n{}ObjectEnd\n", object, as_pbrt(waves(200, object)));
  for (int i = 0; i < 2000; ++i)
    scene += fmt::format("AttributeBegin\nTranslate {} {} -9\nObjectInstance \"{}\"\nAttributeEnd\n", i % 50,
                         i / 50, i % 4);
  write("a.pbrt", scene);
  expect_right_budgets("a.pbrt", {16, 32, 48, 64, 96, 128, 160, 256});
}

TEST_F(TooLittleMemory, TheBudgetThatIsNamedIsEnoughForMeshes) {
  const Waves w = waves(220);
  write("a.pbrt", std::string(head) + as_pbrt(w));
  expect_right_budgets("a.pbrt", {12, 16, 24, 64});
  std::string obj;
  for (const auto& p : w.points) obj += fmt::format("v {} {} {:.3f}\n", p[0], p[1], p[2]);
  for (const auto& t : w.triangles) obj += fmt::format("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
  write("a.obj", obj);
  expect_right_budgets("a.obj", {12, 16, 24, 64});
  std::string ply = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face {}\n"
      "property list uchar int vertex_indices\nend_header\n",
      w.points.size(), w.triangles.size());
  for (const auto& p : w.points) ply += fmt::format("{} {} {:.3f} 9 99 200\n", p[0], p[1], p[2]);
  for (const auto& t : w.triangles) ply += fmt::format("3 {} {} {}\n", t[0], t[1], t[2]);
  write("a.ply", ply);
  expect_right_budgets("a.ply", {12, 16, 24, 64});
}

TEST_F(TooLittleMemory, TheBudgetThatIsNamedIsEnoughForLamps) {
  write("a.pbrt", std::string(head) + "AreaLightSource \"diffuse\"\n" + as_pbrt(waves(220)));
  expect_right_budgets("a.pbrt", {12, 16, 20, 24, 28, 32, 64});
}

TEST_F(TooLittleMemory, TheBudgetThatIsNamedIsEnoughForCurves) {
  std::string scene = std::string(head) + "Material \"hair\"\n";
  for (int i = 0; i < 30'000; ++i) {
    const double x = i % 141 * 0.1, y = i / 141 * 0.1, z = std::sin(i * 0.7);
    scene += fmt::format(
        "Shape \"curve\" \"float width\" .004 \"point3 P\" [{:.3f} {:.3f} {:.3f} {:.3f} {:.3f} .3 {:.3f} "
        "{:.3f} .6 "
        "{:.3f} {:.3f} 1]\n",
        x, y, z, x + 0.1 * z, y, x, y + 0.2, x - 0.1 * z, y);
  }
  write("a.pbrt", scene);
  expect_right_budgets("a.pbrt", {16, 24, 96});
  // Of notes on very many curves most are counted alone.
  const CommandResult said = run(fmt::format("{} '{}' -o '{}' --force --no-cache --no-sync --memory 96M",
                                             vitrail("partition"), path("a.pbrt"), path("out.vit")));
  EXPECT_THAT(said.output, HasSubstr("(counted alone: 28976 places)"));
}

TEST_F(TooLittleMemory, TheBudgetThatIsNamedIsEnoughForVolumes) {
  constexpr int side = 80;
  std::string densities;
  for (int i = 0; i < side * side * side; ++i) densities += fmt::format("{:.3f} ", std::sin(i * 0.7) + 1);
  write("a.pbrt",
        fmt::format(
            "{0}MakeNamedMedium \"m\" \"string type\" \"uniformgrid\" \"integer nx\" {1} \"integer ny\" {1} "
            "\"integer nz\" {1} \"float density\" [{2}]\nMediumInterface \"m\" \"\"\nMaterial "
            "\"interface\"\nShape \"sphere\"\n",
            head, side, densities));
  expect_right_budgets("a.pbrt", {12, 16, 20, 64});
}

// A frame counts nothing that the frames before have given back.
TEST_F(TooLittleMemory, OfAJobIsEnoughForEachFrame) {
  write("a.pbrt", std::string(head) + "AreaLightSource \"diffuse\"\n" + as_pbrt(waves(220)));
  ASSERT_EQ(partition("a.pbrt", "").status, 0);
  write("list.txt", "--seed 1\n--seed 2\n--seed 3\n--seed 4\n--seed 5\n--seed 6\n");
  const CommandResult frames =
      run(fmt::format("SLURM_JOB_ID=7 SLURM_MEM_PER_NODE=64 {} '{}' -o '{}' --frames '{}' --spp 1 --quiet",
                      vitrail("render"), path("out.vit"), path("f%d.png"), path("list.txt")));
  EXPECT_EQ(frames.status, 0) << frames.output;
}

// What a job has bounds the reading too: beyond it the system would kill the render. A user's own number does
// not, so that the one that is enough can be named.
TEST_F(TooLittleMemory, OfAJobEndsTheReadingOfTheScene) {
  std::string scene = head;
  for (int i = 0; i < 60'000; ++i)
    scene += fmt::format(
        "MakeNamedMaterial \"m{}\" \"string type\" \"diffuse\" \"rgb reflectance\" [.{:05} .5 .5]\n"
        "NamedMaterial \"m{}\" Shape \"sphere\" \"float radius\" .01\n",
        i, i, i);
  write("a.pbrt", scene);
  ASSERT_EQ(partition("a.pbrt", "--aov crypto_material").status, 0);
  const std::string render = fmt::format("{} '{}' -o '{}' --aov crypto_material --spp 1 --quiet",
                                         vitrail("render"), path("out.vit"), path("out.film"));
  const CommandResult job = run("SLURM_JOB_ID=7 SLURM_MEM_PER_NODE=32 " + render);
  EXPECT_EQ(job.status, 4) << job.output;
  EXPECT_THAT(job.output, HasSubstr("are too little for reading the scene"));
  EXPECT_TRUE(named_budget(job.output)) << job.output;
  const CommandResult own = run(render + " --memory 32M");
  EXPECT_EQ(own.status, 4) << own.output;
  EXPECT_THAT(own.output, HasSubstr("--memory 32M is too little. Give at least"));
}

}  // namespace
}  // namespace vitrail::test::too_little_memory_test
