// SPDX-License-Identifier: Apache-2.0
// Fullest orders domains by how many rays wait for them: it finds the fullest and the emptiest of 65,535
// without looking at each.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace vitrail {

// Domains stand in buckets by the bits of their number. The answers are exact among up to `looked_at` domains
// of the bucket, and within a factor of two where it holds more. They depend on the order of the calls alone.
class Fullest {
 public:
  static constexpr std::size_t looked_at = 64;

  explicit Fullest(std::size_t domains);

  void insert(std::uint32_t domain, std::uint64_t rays);
  void erase(std::uint32_t domain);
  void set(std::uint32_t domain, std::uint64_t rays);  // of one that is in it

  // They return nothing where no domain is in it; `most` looks only at those that rays wait for.
  std::optional<std::uint32_t> most() const;
  std::optional<std::uint32_t> fewest() const;

 private:
  struct Place {
    int bucket = -1;  // −1: it is not in
    std::uint32_t index = 0;
    std::uint64_t rays = 0;
  };
  std::vector<Place> places_;                        // by domain
  std::vector<std::vector<std::uint32_t>> buckets_;  // of domains, by std::bit_width of their rays
};

}  // namespace vitrail
