// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <utility>

namespace vitrail {

// It counts the text of files that are included more than once. Forty files that each include the next one
// twice are small, and practically without end when they are read.
class IncludedText {
 public:
  explicit IncludedText(std::uint64_t most_bytes) : most_bytes_(most_bytes) {}

  // Says that `file` of so many bytes is about to be read. Returns false where that is too much.
  [[nodiscard]] bool add(const std::filesystem::path& file, std::uint64_t bytes);
  // Returns the message for that case.
  std::string refusal() const;

 private:
  std::uint64_t most_bytes_, again_bytes_ = 0;
  std::set<std::pair<dev_t, ino_t>> seen_;
};

}  // namespace vitrail
