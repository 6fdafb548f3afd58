// SPDX-License-Identifier: Apache-2.0
#include "scene/records/scattering_table.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace vitrail {

namespace {

bool all_finite(std::span<const float> values) {
  return std::ranges::all_of(values, [](float x) { return std::isfinite(x); });
}

bool ascends(const std::vector<float>& nodes) {
  return !nodes.empty() && all_finite(nodes) && std::ranges::is_sorted(nodes) &&
         std::ranges::adjacent_find(nodes) == nodes.end();
}

// Splines need two nodes, and a distance between any two that have one between them.
bool may_have_splines(const std::vector<float>& mu) {
  if (mu.size() < 2 || !all_finite(mu) || !std::ranges::is_sorted(mu) || mu.front() < -1 || mu.back() > 1)
    return false;
  if (mu[0] == mu[1] || mu[mu.size() - 2] == mu.back()) return false;
  for (std::size_t i = 2; i < mu.size(); ++i)
    if (mu[i] == mu[i - 2]) return false;
  return true;
}

const char* fault(const FourierTable& t) {
  if (!std::isfinite(t.eta) || !(t.eta > 0)) return "a Fourier table has no index of refraction";
  if (t.channels != 1 && t.channels != 3) return "a Fourier table has neither one channel nor three";
  if (!may_have_splines(t.mu)) return "the nodes of a Fourier table are out of order";
  const std::size_t pairs = t.mu.size() * t.mu.size();
  if (t.first.size() != pairs || t.orders.size() != pairs) return "a Fourier table is not whole";
  for (std::size_t i = 0; i < pairs; ++i)
    if (t.orders[i] > max_fourier_orders ||
        t.first[i] + std::uint64_t{t.channels} * t.orders[i] > t.coefficients.size())
      return "a Fourier table refers to coefficients that are not there";
  return all_finite(t.coefficients) ? nullptr : "a coefficient of a Fourier table is not finite";
}

bool is_whole(const SquareTable& square, std::size_t slices) {
  const std::uint64_t cells = std::uint64_t{square.rows} * square.columns;
  return square.rows >= 2 && square.columns >= 2 && square.values.size() % cells == 0 &&
         square.values.size() / cells == slices && all_finite(square.values);
}

// Whether each square is a density: nowhere negative, and somewhere positive between its nodes.
bool has_densities(const SquareTable& square) {
  const std::size_t cells = std::size_t{square.rows} * square.columns;
  for (std::size_t at = 0; at < square.values.size(); at += cells) {
    const auto slice = std::span(square.values).subspan(at, cells);
    if (std::ranges::any_of(slice, [](float x) { return x < 0; }) ||
        std::ranges::none_of(slice, [](float x) { return x > 0; }))
      return false;
  }
  return true;
}

const char* fault(const AdaptiveTable& t) {
  if (!ascends(t.phi_i) || !ascends(t.theta_i) || !ascends(t.wavelengths_nm))
    return "the nodes of a measured table are out of order";
  const std::size_t incidences = t.phi_i.size() * t.theta_i.size();
  if (!is_whole(t.normals, 1) || !is_whole(t.projected_area, 1) || !is_whole(t.visible_normals, incidences) ||
      !is_whole(t.luminance, incidences) || !is_whole(t.spectra, incidences * t.wavelengths_nm.size()))
    return "a measured table is not whole";
  if (!has_densities(t.visible_normals) || !has_densities(t.luminance))
    return "a measured table has nothing to sample";
  return nullptr;
}

}  // namespace

const char* fault_of(const ScatteringTable& table) {
  return std::visit([](const auto& t) { return fault(t); }, table);
}

}  // namespace vitrail
