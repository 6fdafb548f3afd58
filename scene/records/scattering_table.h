// SPDX-License-Identifier: Apache-2.0
// These tables say how a surface scatters light, as their files have them (docs/why/scattering-tables.md).
#pragma once

#include <array>
#include <cstdint>
#include <variant>
#include <vector>

namespace vitrail {

// It holds Fourier series in the difference of azimuths φ (Jakob, d'Eon, Jakob, Marschner, "A Comprehensive
// Framework for Rendering Layered Materials", 2014). With μᵢ the cosine of the direction in which light
// travels and μₒ that towards the eye, f·|μᵢ| = Σ aₖ·cos kφ; the aₖ are splines (Catmull and Rom) between the
// nodes of both. Channel 0 is the luminance; of three, 1 is red and 2 is blue, in linear sRGB.
struct FourierTable {
  float eta = 1;              // index behind the surface / in front of it
  std::uint8_t channels = 1;  // 1 or 3
  std::vector<float> mu;      // nodes from −1 to 1, ascending; 0 may be there twice
  // They say for [μₒ][μᵢ] where the coefficients of that pair begin, [channel][order], and how many orders it
  // has.
  std::vector<std::uint32_t> first, orders;
  std::vector<float> coefficients;
  bool operator==(const FourierTable&) const = default;
};

// It holds values over the unit square, [φᵢ][θᵢ][row][column], bilinear between the outermost of its rows and
// columns.
struct SquareTable {
  std::uint32_t rows = 0, columns = 0;
  std::vector<float> values;
  bool operator==(const SquareTable&) const = default;
};

// It holds measurements over a parametrisation that follows the microfacets (Dupuy and Jakob, "An Adaptive
// Parameterization for Efficient Material Acquisition and Rendering", 2018). Columns of the squares are
// √(2θ/π), rows φ/2π + ½.
struct AdaptiveTable {
  std::vector<float> phi_i, theta_i;    // of incidence, radians, ascending; isotropic: at most two of phi_i
  std::vector<float> wavelengths_nm;    // ascending
  SquareTable normals, projected_area;  // of microfacets; once, not for each incidence
  SquareTable visible_normals, luminance;  // the two warps
  SquareTable spectra;                     // [φᵢ][θᵢ][wavelength][row][column]
  bool normalised = false;                 // spectra are without the microfacets' normals over their area
  bool operator==(const AdaptiveTable&) const = default;
};

// Returns whether turning the surface in its plane changes nothing.
inline bool is_isotropic(const AdaptiveTable& table) { return table.phi_i.size() <= 2; }

using ScatteringTable = std::variant<FourierTable, AdaptiveTable>;

inline constexpr std::uint32_t max_fourier_orders = 4096;

// Returns what is wrong with a table; null where all of its look-ups are of finite numbers that are there.
const char* fault_of(const ScatteringTable& table);

}  // namespace vitrail
