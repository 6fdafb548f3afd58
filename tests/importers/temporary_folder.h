// SPDX-License-Identifier: Apache-2.0
// A folder of a test's own, and what tests of readers write into it.
#pragma once

#include <fstream>
#include <string>

#include "tests/support/temporary_directory.h"

namespace vitrail {

class TemporaryFolder : public test::TemporaryDirectory {
 public:
  std::filesystem::path write(const std::string& name, const std::string& content) const {
    std::ofstream(*this / name, std::ios::binary) << content;
    return *this / name;
  }
};

}  // namespace vitrail
