// SPDX-License-Identifier: Apache-2.0
// This converts many scenes into one format: each by a `vitrail convert` of its own, several at once.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace vitrail {

struct ManyConversions {
  std::vector<std::filesystem::path> inputs;  // files and folders
  std::filesystem::path folder;               // below it what is below a folder of `inputs`
  std::string format;                         // "xml": the extension
  int at_once = 1;
  std::uint64_t memory_bytes = 0;       // of each at work
  bool again = false;                   // also what is converted already
  std::string check, peer, input_peer;  // of --check, --peer and --peer-of-input; empty: none
  bool strict = false, quiet = false;
  std::vector<std::string> options;  // of reading each
};

// Writes beside each output its report, NAME.report.json, last. A scene whose report is younger than
// its file and of the same options is converted already: a list that was interrupted goes on with
// the rest. A scene that is refused does not keep the others. Returns the worst exit status of all:
// machine, bad input, differs, done.
int convert_many(const ManyConversions& many);

}  // namespace vitrail
