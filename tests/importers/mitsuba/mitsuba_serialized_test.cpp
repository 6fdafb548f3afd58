// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <zlib.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "importers/mitsuba/read/serialized.h"
#include "importers/writing/write_ply.h"
#include "scene/system/diagnostics.h"
#include "tests/importers/bytes_of_numbers.h"
#include "tests/importers/temporary_folder.h"
#include "tests/support/paths.h"

namespace vitrail::mitsuba::mitsuba_serialized_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string deflated(const std::string& text) {
  uLongf size = ::compressBound(text.size());
  std::string result(size, '\0');
  ::compress(reinterpret_cast<Bytef*>(result.data()), &size, reinterpret_cast<const Bytef*>(text.data()),
             text.size());
  result.resize(size);
  return result;
}

template <class T>
std::string square(std::uint32_t flags, std::uint16_t version, float z = 0, std::uint32_t corner = 3,
                   std::uint64_t vertices = 4, std::uint64_t triangles = 2) {
  std::string body = bytes(flags);
  if (version == 4) body += std::string("name") + '\0';
  body += bytes(vertices, triangles);
  for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) body += bytes(T(x), T(y), T(z));
  if (flags & 1)
    for (int i = 0; i < 4; ++i) body += bytes(T(0), T(0), T(1));
  if (flags & 2)
    for (int i = 0; i < 4; ++i) body += bytes(T(i), T(.25));
  if (flags & 8)
    for (int i = 0; i < 12; ++i) body += bytes(T(1));
  body += bytes(0u, 1u, 2u, 0u, 2u, corner);
  return bytes(std::uint16_t{0x041C}, version) + deflated(body);
}

template <class Offset>
std::string container(const std::vector<std::string>& meshes) {
  std::string file, table;
  for (const std::string& mesh : meshes) {
    table += bytes(static_cast<Offset>(file.size()));
    file += mesh;
  }
  return file + table + bytes(static_cast<std::uint32_t>(meshes.size()));
}

TEST(MitsubaSerialized, ReadsBothVersionsAndPrecisions) {
  TemporaryFolder folder;
  const auto v4 = folder.write(
      "4.serialized", container<std::uint64_t>({square<float>(0x1000, 4, 1), square<float>(0x100b, 4, 2),
                                                square<double>(0x2003, 4, 3)}));
  const auto v3 = folder.write(
      "3.serialized", container<std::uint32_t>({square<float>(0x1001, 3, 1), square<double>(0x2000, 3, 2)}));
  for (const auto& [file, count] : {std::pair{v4, 3}, {v3, 2}}) {
    for (int i = 0; i < count; ++i) {
      const TriangleMesh mesh = read_serialized(file, i);
      EXPECT_EQ(mesh.positions.size(), 4u);
      EXPECT_EQ(mesh.positions[2], (Point3f{1, 1, static_cast<float>(i + 1)}));
      EXPECT_THAT(mesh.triangles, ElementsAre(std::array{0u, 1u, 2u}, std::array{0u, 2u, 3u}));
    }
  }
  EXPECT_EQ(read_serialized(v4, 2).uvs[3], (Point2f{3, .25f}));
  EXPECT_EQ(read_serialized(v4, 1).normals[3], (Normal3f{0, 0, 1}));
  EXPECT_TRUE(read_serialized(v4, 0).normals.empty());
}

TEST(MitsubaSerialized, RefusesWhatIsWrong) {
  TemporaryFolder folder;
  const auto error = [&](const std::string& content, int index = 0) -> std::string {
    try {
      read_serialized(folder.write("a.serialized", content), index);
    } catch (const Error& e) {
      return e.what();
    }
    return "no error";
  };
  const std::string good = container<std::uint64_t>({square<float>(0x1000, 4), square<float>(0x1000, 4)});
  EXPECT_EQ(error(good, 1), "no error");
  EXPECT_THAT(error(good, 2), HasSubstr("shape_index is 2, but the file has 2 meshes"));
  EXPECT_THAT(error(good, -1), HasSubstr("shape_index is -1"));
  EXPECT_THAT(error(""), HasSubstr("too short"));
  EXPECT_THAT(error("ply\nabcdef"), HasSubstr("not a serialized mesh"));
  EXPECT_THAT(error(bytes(std::uint16_t{0x041C}, std::uint16_t{5})), HasSubstr("version 5"));
  EXPECT_THAT(error(good.substr(0, 24)), HasSubstr("ends too early"));
  EXPECT_THAT(error(bytes(std::uint16_t{0x041C}, std::uint16_t{4}) + "this is no zlib stream"),
              HasSubstr("damaged"));
  EXPECT_THAT(error(bytes(std::uint16_t{0x041C}, std::uint16_t{4})), HasSubstr("ends too early"));
  EXPECT_THAT(error(square<float>(0x1000, 4, NAN)), HasSubstr("not a finite"));
  EXPECT_THAT(error(square<float>(0x1000, 4, 0, 4)), HasSubstr("refers to vertex 4, but there are 4"));
  EXPECT_THAT(error(square<float>(0x1000, 4, 0, 3, 0xffffffff)), HasSubstr("4294967295 positions cannot"));
  EXPECT_THAT(error(square<float>(0x1000, 4, 0, 3, 1ull << 62)), HasSubstr("more than 32 bits"));
  EXPECT_THAT(error(square<float>(0x1000, 4, 0, 3, 4, 1ull << 62)), HasSubstr("triangles cannot"));
  EXPECT_THAT(error(square<float>(0x1000, 4, 0, 3, 4, 3)), HasSubstr("ends too early"));
  std::string far = good;
  far.replace(far.size() - 12, 8, bytes(std::uint64_t{1} << 40));
  EXPECT_THAT(error(far, 1), HasSubstr("offset 1099511627776 is not within"));
  std::string many = good;
  many.replace(many.size() - 4, 4, bytes(0xffffffffu));
  EXPECT_THAT(error(many, 1), HasSubstr("cannot hold the 4294967295 meshes"));
}

TEST(MitsubaSerialized, ReadsMitsubasOwnFiles) {
  const char* corpus = std::getenv("VITRAIL_CORPUS");
  const std::filesystem::path folder =
      corpus ? corpus : std::filesystem::path(test::source_dir()) / "../shared/corpus";
  const auto preview = folder / "mitsuba-data/common/meshes/matpreview.serialized";
  if (!std::filesystem::exists(preview)) GTEST_SKIP() << "no corpus at " << folder;
  for (int i = 0; i < 3; ++i) EXPECT_FALSE(read_serialized(preview, i).triangles.empty());
  EXPECT_EQ(read_serialized(folder / "mitsuba-data/tests/serialized/rectangle_normals_uv.serialized", 0)
                .triangles.size(),
            2u);
}

}  // namespace
}  // namespace vitrail::mitsuba::mitsuba_serialized_test
