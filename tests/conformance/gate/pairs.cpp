// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/gate/pairs.h"

#include <algorithm>
#include <numeric>
#include <random>
#include <set>
#include <utility>

namespace vitrail::test {

namespace {

// Which pairs no row has yet: by the numbers of their values, counted through all dimensions.
class Uncovered {
 public:
  explicit Uncovered(const std::vector<std::size_t>& sizes) : sizes_(sizes) {
    for (const std::size_t size : sizes) {
      first_.push_back(values_);
      values_ += size;
    }
    open_.assign(values_ * values_, 0);
    for (std::size_t i = 0; i < sizes.size(); ++i)
      for (std::size_t j = i + 1; j < sizes.size(); ++j)
        for (std::size_t a = 0; a < sizes[i]; ++a)
          for (std::size_t b = 0; b < sizes[j]; ++b) at(i, a, j, b) = at(j, b, i, a) = 1, ++left_;
  }
  bool empty() const { return left_ == 0; }
  bool has(std::size_t i, std::size_t a, std::size_t j, std::size_t b) { return at(i, a, j, b) != 0; }
  void remove(const std::vector<std::size_t>& row) {
    for (std::size_t i = 0; i < row.size(); ++i)
      for (std::size_t j = i + 1; j < row.size(); ++j)
        if (at(i, row[i], j, row[j])) at(i, row[i], j, row[j]) = at(j, row[j], i, row[i]) = 0, --left_;
  }
  // How many open pairs the value is in.
  std::size_t open_pairs(std::size_t i, std::size_t a) {
    std::size_t count = 0;
    for (std::size_t j = 0; j < sizes_.size(); ++j)
      for (std::size_t b = 0; j != i && b < sizes_[j]; ++b) count += at(i, a, j, b);
    return count;
  }

 private:
  char& at(std::size_t i, std::size_t a, std::size_t j, std::size_t b) {
    return open_[(first_[i] + a) * values_ + first_[j] + b];
  }

  const std::vector<std::size_t>& sizes_;
  std::vector<std::size_t> first_;
  std::vector<char> open_;
  std::size_t values_ = 0, left_ = 0;
};

// The index of the greatest score; of equal ones any.
template <class Score>
std::size_t best(std::size_t count, std::mt19937& random, Score&& score) {
  std::size_t chosen = 0, most = 0, equal = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t s = score(i) + 1;
    if (s > most) most = s, equal = 0;
    if (s == most && random() % ++equal == 0) chosen = i;
  }
  return chosen;
}

std::vector<std::size_t> greedy_row(Uncovered& open, const std::vector<std::size_t>& sizes,
                                    std::mt19937& random) {
  std::vector<std::size_t> order(sizes.size()), row(sizes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
  for (std::size_t n = 0; n < order.size(); ++n) {
    const std::size_t i = order[n];
    row[i] = best(sizes[i], random, [&](std::size_t a) {
      if (n == 0) return open.open_pairs(i, a);
      std::size_t covered = 0;
      for (std::size_t m = 0; m < n; ++m) covered += open.has(i, a, order[m], row[order[m]]);
      return covered;
    });
  }
  return row;
}

}  // namespace

std::vector<std::vector<std::size_t>> rows_of_all_pairs(const std::vector<std::size_t>& sizes) {
  std::mt19937 random(1);
  Uncovered open(sizes);
  std::vector<std::vector<std::size_t>> rows;
  while (!open.empty()) {
    rows.push_back(greedy_row(open, sizes, random));
    open.remove(rows.back());
  }
  return rows;
}

std::vector<std::vector<std::size_t>> rows_of_all_values(const std::vector<std::vector<std::size_t>>& rows) {
  std::set<std::pair<std::size_t, std::size_t>> seen;
  std::vector<std::vector<std::size_t>> chosen;
  for (const auto& row : rows) {
    bool is_new = false;
    for (std::size_t d = 0; d < row.size(); ++d) is_new = seen.insert({d, row[d]}).second || is_new;
    if (is_new) chosen.push_back(row);
  }
  return chosen;
}

}  // namespace vitrail::test
