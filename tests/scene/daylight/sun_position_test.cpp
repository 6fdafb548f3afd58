// SPDX-License-Identifier: Apache-2.0
#include "scene/daylight/sun_position.h"

#include <gtest/gtest.h>

#include <cmath>

#include "scene/system/diagnostics.h"

namespace vitrail::sun_position_test {
namespace {

double apart(double a_deg, double b_deg) { return std::abs(std::remainder(a_deg - b_deg, 360)); }

// Reda & Andreas, "Solar Position Algorithm for Solar Radiation Applications", NREL/TP-560-34302, example of
// appendix A.5: 39.742476° N, 105.1786° W, October 17th 2003, 12:30:30 at UTC − 7; without refraction.
TEST(SunPosition, IsThatOfTheNrelExample) {
  const SunPosition p = sun_position(local_time("2003-10-17T12:30:30-07:00"), {39.742476, -105.1786});
  EXPECT_NEAR(p.elevation_deg, 39.872046, 0.01);
  EXPECT_LT(apart(p.azimuth_deg, 194.340241), 0.01);
}

// PyEphem 4.1.6 (VSOP87), without refraction.
TEST(SunPosition, IsThatOfAnEphemeris) {
  struct Row {
    const char* time;
    Site place;
    SunPosition sun;
  };
  for (const Row& row : {Row{"2026-06-21T12:00+02:00", {48.8566, 2.3522}, {56.3088, 128.8300}},
                         Row{"2026-12-22T09:30+11:00", {-33.8688, 151.2093}, {44.6276, 90.6050}},
                         Row{"2026-03-20T15:15-05:00", {-0.1807, -78.4678}, {46.5492, 270.3223}},
                         Row{"2040-05-01T00:00Z", {69.6492, 18.9553}, {-4.0282, 19.0162}}}) {
    const SunPosition p = sun_position(local_time(row.time), row.place);
    EXPECT_NEAR(p.elevation_deg, row.sun.elevation_deg, 0.01) << row.time;
    EXPECT_LT(apart(p.azimuth_deg, row.sun.azimuth_deg), 0.02) << row.time;
  }
}

TEST(LocalTime, ReadsIso8601) {
  const LocalTime t = local_time("2026-06-21T12:30:36+05:30");
  EXPECT_EQ(t.year, 2026);
  EXPECT_EQ(t.month, 6);
  EXPECT_EQ(t.day, 21);
  EXPECT_NEAR(t.hour, 12.51, 1e-12);
  EXPECT_NEAR(t.timezone_h, 5.5, 1e-12);
  EXPECT_NEAR(local_time("2026-06-21T12:30-03:30").timezone_h, -3.5, 1e-12);
  EXPECT_EQ(local_time("2026-06-21T12:30Z").timezone_h, 0);
  EXPECT_EQ(local_time("2024-02-29T00:00Z").day, 29);
  for (const char* wrong :
       {"", "2026-06-21", "2026-06-21T12:30", "2026-13-01T00:00Z", "2026-02-29T00:00Z", "2026-06-21T25:00Z",
        "2026-06-21T12:61Z", "2026-06-21T12:30Zulu", "2026-06-21T12:30+1"})
    EXPECT_THROW(local_time(wrong), Error) << wrong;
}

}  // namespace
}  // namespace vitrail::sun_position_test
