// SPDX-License-Identifier: Apache-2.0
// Grids that NanoVDB's own tools write, against its own look-ups.
#include "images/nanovdb.h"

#include <gmock/gmock.h>
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#define NANOVDB_USE_ZIP
#include <nanovdb/util/GridBuilder.h>
#include <nanovdb/util/IO.h>
#include <nanovdb/util/Primitives.h>
#pragma GCC diagnostic pop

#include <fstream>
#include <iterator>

#include "scene/system/diagnostics.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::nanovdb_test {
namespace {

using testing::HasSubstr;
using Handle = nanovdb::GridHandle<>;

Handle fog() {
  return nanovdb::createFogVolumeSphere<float>(10.0f, {3, 4, 5}, 0.5, 3.0, {1, 2, 3}, "density");
}

class NanoVdb : public testing::Test {
 protected:
  std::filesystem::path write(const Handle& handle, nanovdb::io::Codec codec = nanovdb::io::Codec::NONE) {
    nanovdb::io::writeGrid(file_.string(), handle, codec);
    return file_;
  }
  void write(const std::string& bytes) { std::ofstream(file_, std::ios::binary) << bytes; }
  std::string bytes() const {
    std::ifstream in(file_, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::string error() const {
    try {
      const auto read = read_nanovdb_header(file_, "density");
      if (read) read_nanovdb_values(read->grid);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }

  test::TemporaryDirectory folder_;
  const std::filesystem::path file_ = folder_ / "cloud.nvdb";
};

// Every cell of the box has the value that NanoVDB finds at its centre, and lies where NanoVDB has it.
void expect_all_cells(const NanoVdbGrid& read, const nanovdb::FloatGrid& grid) {
  const Grid& g = read.grid;
  const std::vector<float> values = read_nanovdb_values(g);
  const auto accessor = grid.getAccessor();
  const auto first = grid.indexBBox().min();
  ASSERT_EQ(g.nx, grid.indexBBox().dim()[0] + 2);
  ASSERT_EQ(values.size(),
            static_cast<std::size_t>(g.nx) * static_cast<std::size_t>(g.ny) * static_cast<std::size_t>(g.nz));
  std::size_t i = 0, wrong = 0, inside = 0;
  for (int z = 0; z < g.nz; ++z)
    for (int y = 0; y < g.ny; ++y)
      for (int x = 0; x < g.nx; ++x, ++i) {
        const nanovdb::Coord voxel(first[0] - 1 + x, first[1] - 1 + y, first[2] - 1 + z);
        wrong += values[i] != accessor.getValue(voxel);
        inside += values[i] == 1;
        const auto there = grid.indexToWorld(nanovdb::Vec3d(voxel[0], voxel[1], voxel[2]));
        const auto at = [](double lower, double upper, int k, int n) {
          return lower + (upper - lower) * (k + 0.5) / n;
        };
        const Point3d here = transform_point(read.frame, {at(g.bounds.lower.x, g.bounds.upper.x, x, g.nx),
                                                          at(g.bounds.lower.y, g.bounds.upper.y, y, g.ny),
                                                          at(g.bounds.lower.z, g.bounds.upper.z, z, g.nz)});
        wrong +=
            std::abs(here.x - there[0]) + std::abs(here.y - there[1]) + std::abs(here.z - there[2]) > 1e-9;
      }
  EXPECT_EQ(wrong, 0u);
  EXPECT_GT(inside, values.size() / 4) << "most of a ball, or of the tiles";
}

TEST_F(NanoVdb, EveryVoxelPlainAndDeflated) {
  const Handle handle = fog();
  for (const auto codec : {nanovdb::io::Codec::NONE, nanovdb::io::Codec::ZIP}) {
    const auto read = read_nanovdb_header(write(handle, codec), "density");
    ASSERT_TRUE(read);
    EXPECT_EQ(read->frame, Transform{});
    expect_all_cells(*read, *handle.grid<float>());
  }
  EXPECT_FALSE(read_nanovdb_header(file_, "temperature"));
}

// Tiles of the lower and upper nodes and of the root.
TEST_F(NanoVdb, Tiles) {
  nanovdb::GridBuilder<float> builder(0.0f, nanovdb::GridClass::FogVolume);
  auto accessor = builder.getAccessor();
  accessor.setValue({-3, 0, 0}, 2.0f);
  accessor.setValue({600, 20, 200}, 3.0f);
  builder([](const nanovdb::Coord&) { return 1.0f; }, nanovdb::CoordBBox({0, 0, 0}, {300, 20, 200}));
  const Handle handle = builder.getHandle<>(1.0, {}, "density");
  const auto read = read_nanovdb_header(write(handle), "density");
  ASSERT_TRUE(read);
  expect_all_cells(*read, *handle.grid<float>());
}

TEST_F(NanoVdb, TurnedGridsHaveAFrame) {
  Handle handle = fog();
  auto& map = const_cast<nanovdb::Map&>(handle.grid<float>()->map());
  const double turned[3][3]{{0, -2, 0}, {2, 0, 0}, {0, 0, 2}};
  nanovdb::Map made;
  const double inverse_of[3][3]{{0, .5, 0}, {-.5, 0, 0}, {0, 0, .5}};
  made.set(turned, inverse_of, nanovdb::Vec3d(7, 8, 9), 1.0);
  map = made;
  const auto read = read_nanovdb_header(write(handle), "density");
  ASSERT_TRUE(read);
  EXPECT_NE(read->frame, Transform{});
  expect_all_cells(*read, *handle.grid<float>());
}

TEST_F(NanoVdb, WhatIsRefusedSaysWhatToDo) {
  write(fog());
  const std::string whole = bytes();
  const auto changed = [&](std::size_t at, char to) {
    std::string other = whole;
    other[at] = to;
    write(other);
    return error();
  };
  EXPECT_THAT(changed(0, 'x'), HasSubstr("NanoVDB0"));
  EXPECT_THAT(changed(11, '\x7f'), HasSubstr("nanovdb_convert"));  // the version's highest byte
  constexpr std::size_t meta = sizeof(nanovdb::io::Header);
  EXPECT_THAT(changed(meta + offsetof(nanovdb::io::MetaData, codec), 2), HasSubstr("Blosc"));
  EXPECT_THAT(changed(meta + offsetof(nanovdb::io::MetaData, gridType), 2), HasSubstr("floats"));
  write(nanovdb::createFogVolumeSphere<double>(10.0, {0, 0, 0}, 0.5, 3.0, {0, 0, 0}, "density"));
  EXPECT_THAT(error(), HasSubstr("floats"));
}

// Whatever stands in the file: read or refused. Offsets of nodes are the last bytes before 2⁶⁴.
TEST_F(NanoVdb, BrokenFiles) {
  write(nanovdb::createFogVolumeSphere<float>(3.0f, {0, 0, 0}, 1.0, 3.0, {0, 0, 0}, "density"));
  const std::string whole = bytes();
  ASSERT_EQ(error(), "");
  for (std::size_t size = 0; size < whole.size(); size += 1 + size / 16) {
    write(whole.substr(0, size));
    EXPECT_NE(error(), "") << size;
  }
  std::size_t refused = 0;
  for (std::size_t i = 0; i + 8 < 4000; i += 4) {
    std::string other = whole;
    other.replace(i, 8, "\xff\xff\xff\xff\xff\xff\xff\x7f");
    write(other);
    refused += !error().empty();
  }
  EXPECT_GT(refused, 20u);
}

}  // namespace
}  // namespace vitrail::nanovdb_test
