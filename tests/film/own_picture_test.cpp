// SPDX-License-Identifier: Apache-2.0
#include "film/own_picture.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "tests/support/temporary_directory.h"

namespace vitrail::own_picture_test {
namespace {

TEST(OwnPicture, SaysSoBeforeOrAfterItsPixels) {
  const test::TemporaryDirectory directory;
  const auto is_own = [&](const char* name, const std::string& bytes) {
    const auto file = directory.path() / name;
    std::ofstream(file, std::ios::binary) << bytes;
    return is_own_picture(file);
  };
  const std::string software = "vitrail 0.0.7, pictures of revision 3", pixels(1 << 20, 'x');
  EXPECT_TRUE(is_own("first.png", software + pixels)) << "another version's";
  EXPECT_TRUE(is_own("last.tif", pixels + software));
  EXPECT_FALSE(is_own("between.png", pixels + software + pixels)) << "a pixel";
  EXPECT_FALSE(is_own("other.png", "another program" + pixels));
  EXPECT_FALSE(is_own("empty.png", ""));
  EXPECT_TRUE(is_own("sensors.csv", "x,y,z,nx,ny,nz,illuminance_lx,more\n"));
  EXPECT_FALSE(is_own("other.csv", "x,y,z\n" + software));
  EXPECT_FALSE(is_own_picture(directory.path())) << "a folder";
}

}  // namespace
}  // namespace vitrail::own_picture_test
