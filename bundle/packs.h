// SPDX-License-Identifier: Apache-2.0
// Packs are few files that hold many domains. A domain in a pack has the bytes of its own file, from a
// multiple of `pack_page` on; the bytes between are 0.
#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "bundle/manifest.h"
#include "scene/system/input_files.h"

namespace vitrail {

// OpenPacks keeps packs open, so that a load is one mmap. Any thread may call it.
class OpenPacks {
 public:
  // Throws as RegularFile does. The file may be one that cannot be opened; it is then tried again the next
  // time.
  std::shared_ptr<const RegularFile> open(const std::filesystem::path& pack);

 private:
  static constexpr std::size_t most = 64;  // descriptors
  std::mutex mutex_;
  std::deque<std::pair<std::filesystem::path, std::shared_ptr<const RegularFile>>> open_;  // oldest first
};

// Returns whether a file is named as packs are.
bool is_pack(const std::filesystem::path& file);

// Returns the domains of a pack by their headers, without a manifest. The last may have a wrong header: it
// takes all the rest, and is rejected when it is mapped.
std::vector<Stored> domains_of_pack(const std::filesystem::path& pack);

// Throws Error unless these domains, in any order, fill the pack but for the bytes between, which are 0. A
// pack that was cut short is found when its domains are mapped.
void check_pack(const std::filesystem::path& pack, std::vector<Stored> domains);

// Moves the domains of a bundle that is being written from their files into packs of so many bytes at most,
// or of one domain where it is larger. Throws MachineError.
void write_packs(const std::filesystem::path& bundle, Manifest& manifest, std::uint64_t most_bytes);

}  // namespace vitrail
