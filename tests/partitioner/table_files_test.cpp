// SPDX-License-Identifier: Apache-2.0
#include "partitioner/appearance/table_files.h"

#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <random>

#include "partitioner/appearance/appearance.h"
#include "scene/system/diagnostics.h"
#include "tests/laws/scattering/table_cases.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::table_files_test {
namespace {

FourierTable fourier() {
  const std::array<double, 3> color{0.8, 0.4, 0.2};
  return laws::fourier_table(
      [](Vector3d out, Vector3d in) { return out.z * in.z > 0 ? in.z * in.z + in.x : 0; }, 3, 4, 1.5f,
      &color);
}
AdaptiveTable adaptive(double alpha_v = 0.3) {
  return laws::adaptive_table({.facets = make_microfacets(0.3, alpha_v), .resolution = 4, .incidences = 3});
}

class TableFiles : public testing::Test {
 protected:
  std::filesystem::path file(const char* name) const { return folder_.path() / name; }

  // Every shortening, and every byte changed: an error that names the file, or a table without a fault.
  void damage(const std::filesystem::path& whole, std::size_t changed_up_to,
              const std::function<ScatteringTable(const std::filesystem::path&)>& read) {
    std::ifstream in(whole, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    const auto path = file("damaged.bsdf");
    int refused = 0;
    const auto attempt = [&](const std::string& text) {
      std::ofstream(path, std::ios::binary) << text;
      try {
        EXPECT_EQ(fault_of(read(path)), nullptr);
      } catch (const Error& e) {
        EXPECT_EQ(e.location.file, path.string());
        ++refused;
      }
    };
    const int lengths = 60;
    for (int i = 0; i < lengths; ++i)
      attempt(bytes.substr(0, bytes.size() * static_cast<std::size_t>(i) / lengths));
    EXPECT_EQ(refused, lengths);
    std::mt19937 random(5);
    for (std::size_t i = 0; i < changed_up_to; i += 3) {
      std::string changed = bytes;
      changed[i] = static_cast<char>(random());
      attempt(changed);
    }
    EXPECT_GT(refused, lengths + 20);
  }

  test::TemporaryDirectory folder_;
};

TEST_F(TableFiles, AreReadAsTheyWereWritten) {
  laws::write(fourier(), file("a.bsdf"));
  EXPECT_EQ(read_fourier_table(file("a.bsdf")), fourier());
  for (const double alpha_v : {0.3, 0.5}) {
    laws::write(adaptive(alpha_v), file("b.bsdf"));
    EXPECT_EQ(read_adaptive_table(file("b.bsdf")), adaptive(alpha_v));
  }
}

TEST_F(TableFiles, OthersAreRefusedByName) {
  laws::write(fourier(), file("a.bsdf"));
  for (const char* name : {"a.bsdf", "none.bsdf"}) {
    try {
      read_adaptive_table(file(name));
      FAIL();
    } catch (const Error& e) {
      EXPECT_EQ(e.location.file, file(name).string());
    }
  }
  EXPECT_THROW(read_fourier_table(file("none.bsdf")), Error);
  EXPECT_THROW(read_fourier_table(folder_.path()), Error);
}

TEST_F(TableFiles, DamagedOnesAreRefusedOrSound) {
  laws::write(fourier(), file("a.bsdf"));
  damage(file("a.bsdf"), 1400, [](const auto& path) { return read_fourier_table(path); });
  laws::write(adaptive(), file("b.bsdf"));
  damage(file("b.bsdf"), 700, [](const auto& path) { return read_adaptive_table(path); });
}

// Two materials of one file share its table, which no material that is not used brings.
TEST_F(TableFiles, AreKeptOnceWhereAShapeUsesThem) {
  laws::write(fourier(), file("a.bsdf"));
  laws::write(adaptive(), file("b.bsdf"));
  using Format = TabulatedMaterial::Format;
  const Material fourier_material{TabulatedMaterial{Format::fourier, file("a.bsdf").string()}};
  Scene scene;
  scene.materials = {fourier_material, Material{TabulatedMaterial{Format::adaptive, file("b.bsdf").string()}},
                     fourier_material};
  scene.meshes.emplace_back();
  for (const std::uint32_t used : {0u, 2u}) {
    Shape shape;
    shape.material = {used};
    scene.shapes.push_back(shape);
  }
  const Appearance a = appearance_of(scene, {});
  EXPECT_TRUE(a.diagnostics.empty());
  ASSERT_EQ(a.tables.size(), 1u);
  EXPECT_EQ(std::get<FourierTable>(a.tables[0]), fourier());
  EXPECT_EQ(a.materials.at(0), a.materials.at(1));
}

}  // namespace
}  // namespace vitrail::table_files_test
