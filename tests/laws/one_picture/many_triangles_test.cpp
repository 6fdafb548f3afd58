// SPDX-License-Identifier: Apache-2.0
// Scenes of more triangles than rays have numbers for (bundle/triangle_number.h), their instances counted.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <random>
#include <string>

#include "bundle/triangle_number.h"
#include "tests/support/command.h"
#include "tests/support/ranks.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::many_triangles_test {
namespace {

using ::testing::HasSubstr;

constexpr const char* head =
    "LookAt 0 -8 5 0 0 .6 0 0 1\nCamera \"perspective\" \"float fov\" 50\n"
    "Film \"rgb\" \"integer xresolution\" 64 \"integer yresolution\" 48\nWorldBegin\n"
    "LightSource \"infinite\" \"rgb L\" [.1 .12 .15]\n";

// A wavy square of 2·side² triangles and edge 1.
std::string waves(int side) {
  std::string points, corners;
  for (int y = 0; y <= side; ++y)
    for (int x = 0; x <= side; ++x)
      points += fmt::format("{:.4f} {:.4f} {:.3f} ", x / double(side) - .5, y / double(side) - .5,
                            .05 * std::sin(7. * x / side) * std::sin(5. * y / side));
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const int a = y * (side + 1) + x, b = a + side + 1;
      corners += fmt::format("{} {} {} {} {} {} ", a, a + 1, b, a + 1, b + 1, b);
    }
  return fmt::format("Shape \"trianglemesh\" \"point3 P\" [{}] \"integer indices\" [{}]\n", points, corners);
}

std::string place(const std::string& object, double x, double y, double z, double scale) {
  return fmt::format(
      "AttributeBegin\nTranslate {:.4f} {:.4f} {:.4f}\nScale {} {} {}\nObjectInstance \"{}\"\nAttributeEnd\n",
      x, y, z, scale, scale, scale, object);
}

class ManyTriangles : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
  }
  std::string must(const std::string& command) const {
    const CommandResult result = run(command);
    EXPECT_EQ(result.status, 0) << command << "\n" << result.output;
    return result.output;
  }
  void partition(const std::string& scene, const std::string& bundle, const std::string& more = {}) const {
    must(fmt::format("{} '{}' -o '{}' --quiet --force --no-sync {}", vitrail("partition"), path(scene),
                     path(bundle), more));
  }
  // Its film's hash.
  std::string render(const std::string& bundle, int ranks = 1, const std::string& more = {}) const {
    must(fmt::format("{} '{}' -o '{}' --quiet --force --spp 4 --threads 2 --stats '{}' {}",
                     vitrail_on(ranks, "render"), path(bundle), path("a.film"), path("a.json"), more));
    return read_json(folder_ / "a.json")["film_hash"].get<std::string>();
  }

  TemporaryDirectory folder_;
};

TEST(TriangleNumber, OfASumIsTheSumOfNumbers) {
  std::mt19937_64 bits(5);
  for (int i = 0; i < 100'000; ++i) {
    const std::uint64_t a = bits() >> (i % 60 + 2), b = bits() >> (i / 7 % 60 + 2);
    ASSERT_EQ(number_from(triangle_number(a), triangle_number(b)), triangle_number(a + b)) << a << " " << b;
  }
  EXPECT_EQ(triangle_number(triangle_numbers - 1), triangle_numbers - 1);
  EXPECT_EQ(number_from(triangle_numbers - 1, 1), 0u);
}

// Cubes of 10³ instances in so many levels.
std::string nested(int levels) {
  std::string text = std::string(head) + "ObjectBegin \"0\"\n" + waves(10) + "ObjectEnd\n";
  for (int level = 1; level <= levels; ++level) {
    text += fmt::format("ObjectBegin \"{}\"\n", level);
    for (int i = 0; i < 1000; ++i)
      text += place(std::to_string(level - 1), i % 10 * .1 - .45, i / 10 % 10 * .1 - .45, i / 100 * .1 - .45,
                    .08);
    text += "ObjectEnd\n";
  }
  return text + place(std::to_string(levels), 0, 0, .5, 6) + place("0", 0, 0, 1, .5);
}

// More than a double counts.
TEST_F(ManyTriangles, AreCountedByEveryVerb) {
  constexpr const char* count = "200000000000000200";
  write("deep.pbrt", nested(5));
  EXPECT_THAT(must(fmt::format("{} '{}'", vitrail("inspect"), path("deep.pbrt"))), HasSubstr(count));
  partition("deep.pbrt", "deep.vit", fmt::format("--stats '{}'", path("p.json")));
  EXPECT_EQ(read_json(folder_ / "p.json")["input_triangles"].dump(), count);
  EXPECT_THAT(must(fmt::format("{} '{}'", vitrail("inspect"), path("deep.vit"))), HasSubstr(count));
  EXPECT_THAT(must(fmt::format("{} '{}'", vitrail("verify"), path("deep.vit"))), HasSubstr("whole"));
  const std::string profile = fmt::format("--profile '{}'", path("rays.json"));
  const std::string whole = render("deep.vit", 1, profile);
  must(fmt::format("{} '{}' --ranks 4 {}", vitrail("plan"), path("deep.vit"), profile));
  partition("deep.pbrt", "deep.vit", "--domains 3");
  EXPECT_EQ(render("deep.vit", 2), whole);
}

TEST_F(ManyTriangles, AreRefusedBeyondTheLimitsByName) {
  write("deep.pbrt", nested(7));
  const std::string to = fmt::format("-o '{}' --quiet --force", path("a.vit"));
  const CommandResult deep = run(fmt::format("{} '{}' {}", vitrail("partition"), path("deep.pbrt"), to));
  EXPECT_EQ(deep.status, 3) << deep.output;
  EXPECT_THAT(deep.output, HasSubstr("the most is 4611686018427387904"));
  write("many.pbrt", nested(3));
  const CommandResult flat =
      run(fmt::format("{} '{}' {} --flatten", vitrail("partition"), path("many.pbrt"), to));
  EXPECT_EQ(flat.status, 3) << flat.output;
  EXPECT_THAT(flat.output, HasSubstr("--flatten copies up to 4294967291"));
}

}  // namespace
}  // namespace vitrail::test::many_triangles_test
