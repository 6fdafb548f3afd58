// SPDX-License-Identifier: Apache-2.0
// Files of many chunks (256 KiB), which threads read and which have to join as if one had read them line by
// line.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <random>

#include "importers/obj/read/obj.h"
#include "tests/importers/temporary_folder.h"

namespace vitrail::obj_large_test {
namespace {

using testing::HasSubstr;

struct CornerValues {
  Point3f position;
  Point2f uv;
  Normal3f normal;
  bool operator==(const CornerValues&) const = default;
};

std::vector<CornerValues> corners_of(const TriangleMesh& mesh) {
  std::vector<CornerValues> corners;
  for (const auto& triangle : mesh.triangles) {
    for (const std::uint32_t i : triangle) {
      corners.push_back({mesh.positions[i], mesh.uvs.empty() ? Point2f{} : mesh.uvs[i],
                         mesh.normals.empty() ? Normal3f{} : mesh.normals[i]});
    }
  }
  return corners;
}

// Each as its 24 numbers.
std::vector<std::vector<float>> sorted_triangles(const std::vector<CornerValues>& corners) {
  std::vector<std::vector<float>> triangles(corners.size() / 3);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const auto& [p, uv, n] = corners[i];
    std::ranges::copy(std::array{p.x, p.y, p.z, uv.x, uv.y, n.x, n.y, n.z},
                      std::back_inserter(triangles[i / 3]));
  }
  std::ranges::sort(triangles);
  return triangles;
}

// Writes statements of every kind at random and knows what triangles they make.
class RandomObj {
 public:
  explicit RandomObj(unsigned seed) : random_(seed) {}

  void write(std::size_t size) {
    while (text.size() < size) {
      const int kind = pick(100);
      if (kind < 30 || positions_.size() < 3) {
        vertex();
      } else if (kind < 90) {
        face();
      } else if (kind < 95) {
        line(fmt::format("# {:{}}", "comment \\", pick(40) + 9));
      } else if (kind < 97) {
        line(fmt::format("g group{}", pick(5)));
      } else {
        line(fmt::format("  \t{}", kind == 97 ? "" : "o object"));
      }
    }
  }

  std::string text;
  std::vector<CornerValues> plain, full;  // of faces without and with texture coordinates and normals
  int lines = 0;

 private:
  int pick(int below) { return std::uniform_int_distribution(0, below - 1)(random_); }
  float coordinate() { return static_cast<float>(pick(20001) - 10000) / 8; }

  // Lines end in each of the three ways; a lone carriage return makes the statement reader take over.
  void line(std::string_view content) {
    const int kind = pick(50);
    text += content;
    text += kind == 0 ? "\r" : kind < 5 ? "\r\n" : "\n";
    ++lines;
  }

  // Statements may be joined from two lines.
  std::string gap() {
    if (pick(200) != 0) return " ";
    ++lines;
    return " \\\n";
  }

  void vertex() {
    const Point3f p{coordinate(), coordinate(), coordinate()};
    const char* const tail = pick(100) == 0 ? " # tail" : "";
    line(fmt::format("v {}{}{:.6f} {:e}{}", p.x, gap(), p.y, p.z, tail));
    positions_.push_back(p);
    if (pick(4) == 0) return;
    uvs_.push_back({coordinate(), coordinate()});
    line(fmt::format("vt {} {}{}", uvs_.back().x, uvs_.back().y, pick(9) == 0 ? " 0.5" : ""));
    normals_.push_back({coordinate(), coordinate(), 1});
    line(fmt::format("vn {} {} 1", normals_.back().x, normals_.back().y));
  }

  template <class T>
  std::string index(const std::vector<T>& values, bool relative, T& value) {
    const int i = pick(static_cast<int>(values.size()));
    value = values[static_cast<std::size_t>(i)];
    return std::to_string(relative ? i - static_cast<int>(values.size()) : i + 1);
  }

  void face() {
    const bool has_all = !uvs_.empty() && pick(2) == 0;
    std::string text_of_face = "f";
    for (int i = 0; i < 3; ++i) {
      const bool relative = pick(8) == 0;
      CornerValues corner;
      text_of_face += gap();
      text_of_face += index(positions_, relative, corner.position);
      if (has_all) {
        const std::string uv = index(uvs_, relative, corner.uv);
        text_of_face += fmt::format("/{}/{}", uv, index(normals_, relative, corner.normal));
      }
      (has_all ? full : plain).push_back(corner);
    }
    line(text_of_face);
  }

  std::mt19937 random_;
  std::vector<Point3f> positions_;
  std::vector<Point2f> uvs_;
  std::vector<Normal3f> normals_;
};

TEST(LargeObj, ChunksJoinAsOneText) {
  TemporaryFolder folder;
  for (const unsigned seed : {1u, 2u, 3u}) {
    RandomObj random(seed);
    random.write(3'000'000);
    const ImportedScene imported = read_obj(folder.write("random.obj", random.text));
    std::vector<CornerValues> plain, full;  // of all objects
    for (const TriangleMesh& mesh : imported.scene.meshes)
      std::ranges::copy(corners_of(mesh), std::back_inserter(mesh.uvs.empty() ? plain : full));
    EXPECT_TRUE(sorted_triangles(full) == sorted_triangles(random.full));
    EXPECT_TRUE(sorted_triangles(plain) == sorted_triangles(random.plain));
    EXPECT_TRUE(imported.diagnostics.empty());
  }
}

TEST(LargeObj, ThreadsDoNotShow) {
  TemporaryFolder folder;
  RandomObj random(4);
  random.write(3'000'000);
  const std::filesystem::path file = folder.write("random.obj", random.text);
  const ImportedScene many = read_obj(file);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_TRUE(read_obj(file).scene.meshes == many.scene.meshes);
}

TEST(LargeObj, ErrorsBehindManyChunksHaveTheirLine) {
  TemporaryFolder folder;
  RandomObj random(5);
  random.write(2'000'000);
  for (const std::string bad : {"v 0 0 x", "f 1 2 999999", "f 1 2 -999999"}) {
    if (random.text.back() == '\r') random.text += '\n';
    try {
      read_obj(folder.write("bad.obj", random.text + bad + "\n" + random.text));
      ADD_FAILURE() << "accepted: " << bad;
    } catch (const Error& error) {
      EXPECT_EQ(error.excerpt, bad);
      EXPECT_EQ(error.location.line, random.lines + 1);
    }
  }
}

TEST(LargeObj, FilesWithoutLineFeedsOrWithoutAnyEnd) {
  TemporaryFolder folder;
  std::string text = "v 0 0 0\rv 1 0 0\rv 0 1 0\r";
  for (int i = 0; i < 50000; ++i) text += "f 1 2 3\r";
  EXPECT_EQ(read_obj(folder.write("mac.obj", text)).scene.meshes.at(0).triangles.size(), 50000u);
  text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3 \\\n" + std::string(1'000'000, ' ') + "# x";
  EXPECT_EQ(read_obj(folder.write("blank.obj", text)).scene.meshes.at(0).triangles.size(), 1u);
}

// One index a corner: the mesh has the file's vertices in the file's order, less those without a face.
TEST(LargeObj, AlignedVerticesKeepTheirOrder) {
  TemporaryFolder folder;
  const std::string vertices =
      "v 0 0 0\nvt 0 0\nv 1 0 0\nvt 1 0\nv 1 1 0\nvt 1 1\nv 0 1 0\nvt 0 1\nv 9 9 9\nvt 9 9\n";
  const ImportedScene some = read_obj(folder.write("a.obj", vertices + "f 4/4 3/3 2/2\nf 4/4 2/2 1/1\n"));
  const TriangleMesh& mesh = some.scene.meshes.at(0);
  EXPECT_THAT(mesh.positions,
              testing::ElementsAre(Point3f{0, 0, 0}, Point3f{1, 0, 0}, Point3f{1, 1, 0}, Point3f{0, 1, 0}));
  EXPECT_THAT(mesh.uvs, testing::ElementsAre(Point2f{0, 0}, Point2f{1, 0}, Point2f{1, 1}, Point2f{0, 1}));
  using Triangle = std::array<std::uint32_t, 3>;
  EXPECT_THAT(mesh.triangles, testing::ElementsAre(Triangle{3, 2, 1}, Triangle{3, 1, 0}));
  const ImportedScene all = read_obj(folder.write("b.obj", vertices + "f 5/5 4/4 3/3\nf 4/4 2/2 1/1\n"));
  EXPECT_THAT(all.scene.meshes.at(0).triangles, testing::ElementsAre(Triangle{4, 3, 2}, Triangle{3, 1, 0}));
  // A corner whose indices differ: vertices in the order of their use.
  const ImportedScene split = read_obj(folder.write("c.obj", vertices + "f 4/4 3/3 2/2\nf 4/4 2/1 1/1\n"));
  EXPECT_THAT(split.scene.meshes.at(0).triangles, testing::ElementsAre(Triangle{0, 1, 2}, Triangle{0, 3, 4}));
  EXPECT_THAT(split.scene.meshes.at(0).uvs, testing::ElementsAre(Point2f{0, 1}, Point2f{1, 1}, Point2f{1, 0},
                                                                 Point2f{0, 0}, Point2f{0, 0}));
}

// Vertices that differ in nothing but their texture coordinates must not make a search of one another.
TEST(LargeObj, ManyVerticesAtOnePlace) {
  TemporaryFolder folder;
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  constexpr int count = 100'000;
  for (int i = 1; i <= count; ++i) text += fmt::format("vt {} 0\n", i);
  for (int i = 1; i <= count; ++i) text += fmt::format("f 1/{} 2/{} 3/{}\n", i, i, i);
  EXPECT_EQ(read_obj(folder.write("fan.obj", text)).scene.meshes.at(0).positions.size(), 3u * count);
}

}  // namespace
}  // namespace vitrail::obj_large_test
