// SPDX-License-Identifier: Apache-2.0
// Where the project and its programs are. Only paths.cpp is compiled with these folders: a compiler cache
// knows all other files in another checkout.
#pragma once

#include <string>

namespace vitrail::test {

std::string source_dir();                             // of the checkout
std::string project_file(const std::string& inside);  // project_file("docs/README.md")
std::string bin_dir();                                // of the programs that were built

}  // namespace vitrail::test
