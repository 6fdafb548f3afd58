// SPDX-License-Identifier: Apache-2.0
// A few rows in which all pairs of values occur, where all combinations would be too many.
#pragma once

#include <cstddef>
#include <vector>

namespace vitrail::test {

// Rows of one value in [0, sizes[i]) for each dimension i, so that each two values of two dimensions stand
// together in one row at least. Always the same rows. About 1.2 times the product of the two greatest sizes.
std::vector<std::vector<std::size_t>> rows_of_all_pairs(const std::vector<std::size_t>& sizes);

// Of `rows` the first ones in which every value of each dimension occurs.
std::vector<std::vector<std::size_t>> rows_of_all_values(const std::vector<std::vector<std::size_t>>& rows);

}  // namespace vitrail::test
