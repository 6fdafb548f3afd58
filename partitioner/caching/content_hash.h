// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace vitrail {

// A ContentHash is 128 bits of XXH3 over what was added. Different contents do not share them by chance;
// somebody who means to can find some that do.
class ContentHash {
 public:
  ContentHash();
  ~ContentHash();
  ContentHash(const ContentHash&) = delete;
  ContentHash& operator=(const ContentHash&) = delete;

  // Adds a text with its length, so that two texts are not taken for one.
  void add(std::string_view text);
  void add(std::span<const std::byte> bytes);
  // Throws Error where the file cannot be read.
  void add_content(const std::filesystem::path& file);
  // Returns 32 digits.
  std::string hex() const;

 private:
  void add_bytes(std::span<const std::byte> bytes);

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vitrail
