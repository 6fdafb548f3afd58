// SPDX-License-Identifier: Apache-2.0
#include "glazing/optical_rows.h"

#include <fmt/format.h>

#include <algorithm>

namespace vitrail {

namespace {

// The rows about `nm` and the weight of the second.
template <typename Row>
struct Between {
  const Row *a, *b;
  double weight;
};

template <typename Row>
Between<Row> between(const std::vector<Row>& rows, double nm) {
  const auto above =
      std::upper_bound(rows.begin(), rows.end(), nm, [](double x, const Row& row) { return x < row.nm; });
  if (above == rows.begin()) return {&rows.front(), &rows.front(), 0};
  if (above == rows.end()) return {&rows.back(), &rows.back(), 0};
  const Row &a = *(above - 1), &b = *above;
  return {&a, &b, (nm - a.nm) / (b.nm - a.nm)};
}

double mix(double a, double b, double weight) { return a + weight * (b - a); }

void add(OpticalRow& sum, const OpticalRow& row) {
  sum.at.t += row.at.t;
  sum.at.rf += row.at.rf;
  sum.at.rb += row.at.rb;
}
void add(IndexRow& sum, const IndexRow& row) {
  sum.n += row.n;
  sum.k += row.k;
}
void divide(OpticalRow& row, double count) {
  row.at = {row.at.t / count, row.at.rf / count, row.at.rb / count};
}
void divide(IndexRow& row, double count) { row = {row.nm, row.n / count, row.k / count}; }

template <typename Row>
std::vector<Row> merged(std::vector<Row> rows, std::vector<std::string>& notes) {
  const auto earlier = [](const Row& a, const Row& b) { return a.nm < b.nm; };
  if (!std::is_sorted(rows.begin(), rows.end(), earlier)) {
    notes.emplace_back("wavelengths are not in ascending order and are sorted");
    std::stable_sort(rows.begin(), rows.end(), earlier);
  }
  std::vector<Row> result;
  for (std::size_t first = 0, last; first < rows.size(); first = last) {
    Row mean = rows[first];
    for (last = first + 1; last < rows.size() && rows[last].nm == mean.nm; ++last) add(mean, rows[last]);
    divide(mean, static_cast<double>(last - first));
    result.push_back(mean);
  }
  if (result.size() < rows.size())
    notes.push_back(fmt::format("{} wavelengths are there more than once and become their mean",
                                rows.size() - result.size()));
  return result;
}

}  // namespace

WavelengthRange range_of(const OpticalRows& rows) { return {rows.front().nm, rows.back().nm}; }

WavelengthRange common(WavelengthRange a, WavelengthRange b) {
  return {std::max(a.first_nm, b.first_nm), std::min(a.last_nm, b.last_nm)};
}

PaneValues value_at(const OpticalRows& rows, double nm) {
  const auto [a, b, w] = between(rows, nm);
  return {mix(a->at.t, b->at.t, w), mix(a->at.rf, b->at.rf, w), mix(a->at.rb, b->at.rb, w)};
}

IndexRow index_at(const IndexRows& rows, double nm) {
  const auto [a, b, w] = between(rows, nm);
  return {nm, mix(a->n, b->n, w), mix(a->k, b->k, w)};
}

OpticalRows tidy(OpticalRows rows, std::vector<std::string>& notes) {
  rows = merged(std::move(rows), notes);
  int bounded = 0;
  for (OpticalRow& row : rows) {
    PaneValues v = row.at;
    v.t = std::clamp(v.t, 0.0, 1.0);
    v.rf = std::clamp(v.rf, 0.0, 1 - v.t);
    v.rb = std::clamp(v.rb, 0.0, 1 - v.t);
    bounded += v != row.at;
    row.at = v;
  }
  if (bounded > 0)
    notes.push_back(fmt::format("{} rows leave 0 ≤ T, R and T + R ≤ 1 and are brought into it", bounded));
  return rows;
}

IndexRows tidy(IndexRows rows, std::vector<std::string>& notes) { return merged(std::move(rows), notes); }

}  // namespace vitrail
