// SPDX-License-Identifier: Apache-2.0
// These functions give the numbers of candidate k from those of a set. Digits are flipped as in the first
// points of Sobol's sequence. Four candidates thus lie in different quarters of each dimension, 16 in
// different 16ths, and each alone keeps the strata of the set.
#pragma once

#include <array>
#include <cstdint>

namespace vitrail {

// They are the digits that are flipped: the highest four of 24 bits, of the first and third number
// (`straight`) and of the others (`turned`).
struct CandidateDigits {
  std::uint32_t straight, turned;
};
inline constexpr std::uint32_t most_candidates = 16;
inline constexpr CandidateDigits candidate_digits[most_candidates]{
    {0, 0},  {8, 8}, {4, 12}, {12, 4},  {2, 10}, {10, 2},  {6, 6}, {14, 14},
    {1, 15}, {9, 7}, {5, 3},  {13, 11}, {3, 5},  {11, 13}, {7, 9}, {15, 1}};

inline std::array<float, 4> numbers_of_candidate(std::array<float, 4> u, std::uint32_t k) {
  const CandidateDigits digits = candidate_digits[k];
  const auto flipped = [](float x, std::uint32_t by) {
    return static_cast<float>(static_cast<std::uint32_t>(x * 0x1p24f) ^ by << 20) * 0x1p-24f;
  };
  return {flipped(u[0], digits.straight), flipped(u[1], digits.turned), flipped(u[2], digits.straight),
          flipped(u[3], digits.turned)};
}

}  // namespace vitrail
