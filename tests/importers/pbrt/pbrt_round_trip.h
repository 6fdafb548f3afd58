// SPDX-License-Identifier: Apache-2.0
// pbrt → Scene → pbrt → Scene, for tests of the writer.
#pragma once

#include <fstream>

#include "importers/pbrt/write/write_pbrt.h"
#include "tests/conformance/gate/pbrt_grammar.h"
#include "tests/importers/pbrt/pbrt_text.h"
#include "tests/support/equal_scenes.h"

namespace vitrail {

struct RoundTrip {
  ImportedScene first, second;
  Diagnostics written;
  std::string text;
  std::vector<std::string> complaints;
};
inline RoundTrip round_trip(const std::string& text) {
  const TemporaryFolder folder;
  RoundTrip result;
  result.first = read_pbrt(folder.write("scene.pbrt", text));
  const std::filesystem::path out = folder / "out.pbrt";
  result.written = write_pbrt(result.first.scene, out);
  std::ifstream file(out);
  result.text.assign(std::istreambuf_iterator<char>(file), {});
  result.second = read_pbrt(out);
  result.complaints = test::pbrt_complaints(out);
  return result;
}

// Nothing is lost in writing, pbrt takes what is written, and what is read again is the same.
inline void expect_exact(const std::string& text) {
  const RoundTrip trip = round_trip(text);
  EXPECT_THAT(test::pbrt_complaints(trip.text, ""), testing::IsEmpty()) << trip.text;
  for (const Diagnostic& d : trip.written) ADD_FAILURE() << d.message;
  EXPECT_EQ(test::difference(trip.first.scene, trip.second.scene), "") << text << "\n became\n" << trip.text;
}
inline void expect_exact_world(const std::string& world) {
  expect_exact("Film \"rgb\"\nWorldBegin\n" + world);
}
inline void expect_exact_material(const std::string& directives) {
  expect_exact_world(directives + " " + triangle);
}

// What is written of it passes pbrt's grammar, and the report mentions it.
inline RoundTrip expect_reported(const std::string& world, const char* report) {
  RoundTrip trip = round_trip("Film \"rgb\"\nWorldBegin\n" + world);
  EXPECT_THAT(test::pbrt_complaints(trip.text, ""), testing::IsEmpty()) << trip.text;
  EXPECT_TRUE(mentions(trip.written, report)) << trip.text;
  return trip;
}

}  // namespace vitrail
