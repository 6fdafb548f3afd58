// SPDX-License-Identifier: Apache-2.0
#include "film/neighbours.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

namespace vitrail {

Neighbours along_axis(std::span<const double> correlations) {
  Neighbours result;
  for (std::size_t i = 1; i < correlations.size(); ++i) {
    const double rho = correlations[i] / correlations[0];
    result.of_mean += 2 * rho;
    result.of_variances += 2 * rho * rho;
  }
  return result;
}

Neighbours product(const Neighbours& x, const Neighbours& y) {
  return {x.of_mean * y.of_mean, x.of_variances * y.of_variances};
}

Neighbours neighbours_of(const std::string& about) {
  const nlohmann::json json = nlohmann::json::parse(about, nullptr, false);
  if (!json.is_object()) return {};
  const auto found = json.find("neighbours");
  if (found == json.end() || !found->is_array() || found->size() != 2) return {};
  const auto number = [&](std::size_t i) {
    const double v = (*found)[i].is_number() ? (*found)[i].get<double>() : 1;
    return std::isfinite(v) ? std::max(v, 1.0) : 1;
  };
  return {number(0), number(1)};
}

}  // namespace vitrail
