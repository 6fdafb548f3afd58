// SPDX-License-Identifier: Apache-2.0
#include "importers/bytes/included_text.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>

namespace vitrail {

bool IncludedText::add(const std::filesystem::path& file, std::uint64_t bytes) {
  constexpr std::uint64_t opening = 64 << 10;  // takes as long as so much text
  struct stat status = {};
  if (::stat(file.c_str(), &status) != 0) return true;
  if (seen_.insert({status.st_dev, status.st_ino}).second) return true;
  again_bytes_ += std::max(bytes, opening);
  return again_bytes_ <= most_bytes_;
}

std::string IncludedText::refusal() const {
  return fmt::format(
      "files that are included more than once come to more than {} MiB of text; --include-limit raises that",
      most_bytes_ >> 20);
}

}  // namespace vitrail
