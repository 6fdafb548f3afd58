// SPDX-License-Identifier: Apache-2.0
#include "scene/models/sensor_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "scene/system/diagnostics.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::sensor_file_test {
namespace {

class SensorFile : public ::testing::Test {
 protected:
  std::vector<Sensor> read(const std::string& text) {
    std::ofstream(folder_ / "sensors.txt") << text;
    return read_sensors(folder_ / "sensors.txt");
  }
  test::TemporaryDirectory folder_;
};

TEST_F(SensorFile, PointsAndPlanes) {
  const auto sensors =
      read("# on the desk\n1 2 3  0 0 2\n\n\tplane 0 0 1  4 0 0  0 2 0  2x1 # two\n1e3 0 -.5 1 0 0\r\n");
  ASSERT_EQ(sensors.size(), 4u);
  EXPECT_EQ(sensors[0], (Sensor{{1, 2, 3}, {0, 0, 1}}));
  EXPECT_EQ(sensors[1], (Sensor{{1, 1, 1}, {0, 0, 1}}));
  EXPECT_EQ(sensors[2], (Sensor{{3, 1, 1}, {0, 0, 1}}));
  EXPECT_EQ(sensors[3], (Sensor{{1000, 0, -0.5}, {1, 0, 0}}));
}

TEST_F(SensorFile, SaysWhichLineIsWrong) {
  for (const char* wrong :
       {"1 2 3 0 0", "1 2 3 0 0 0", "1 2 3 0 0 x", "1 2 3 0 0 1 7", "plane 0 0 0 1 0 0 2 0 0 2x2",
        "plane 0 0 0 1 0 0 0 1 0 2", "plane 0 0 0 1 0 0 0 1 0 0x2", "plane 0 0 0 1 0 0 0 1 0 2x1.5",
        "plane 0 0 0 1 0 0 0 1 0 60000x60000", "nan 0 0 0 0 1"}) {
    try {
      read(std::string("\n") + wrong);
      FAIL() << wrong;
    } catch (const Error& error) {
      EXPECT_EQ(error.location.line, 2) << wrong;
    }
  }
  EXPECT_THROW(read("# nothing\n"), Error);
  EXPECT_THROW(read_sensors("/nowhere/sensors.txt"), Error);
}

TEST(SensorFilm, HasAColumnASensor) {
  const FilmSettings film = sensor_film(7);
  EXPECT_EQ(film.width, 7);
  EXPECT_EQ(film.crop, (PixelRect{0, 7, 0, sensor_rows}));
  EXPECT_EQ(film.spectrum.width_nm(), 10);
}

}  // namespace
}  // namespace vitrail::sensor_file_test
