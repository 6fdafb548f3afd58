// SPDX-License-Identifier: Apache-2.0
// Which files each test_NAME runs, of those that are linked into one program: written by vitrail_test.
#pragma once

#include <span>
#include <string_view>

namespace vitrail::test {

struct TestFile {
  std::string_view program, file;  // "test_photons", "tests/laws/light/photons_test.cpp"
};
extern const std::span<const TestFile> test_files;

}  // namespace vitrail::test
