// SPDX-License-Identifier: Apache-2.0
// A film gathers the picture: this file says its pixels, their filter, and the layers that it keeps beside
// colours.
#pragma once

#include <variant>

#include "scene/records/film_layers.h"
#include "scene/spectra/spectral_bins.h"

namespace vitrail {

// It is one of the pixel reconstruction filters, which are all normalised; radii and σ are in pixels. The
// Gaussian is pbrt's: lowered to reach 0 at its radius.
struct BoxFilter {
  double radius_x = 0.5, radius_y = 0.5;
  bool operator==(const BoxFilter&) const = default;
};
// It falls linearly to 0 at the radius.
struct TriangleFilter {
  double radius_x = 2, radius_y = 2;
  bool operator==(const TriangleFilter&) const = default;
};
// It is a Gaussian less its value at the radius.
struct GaussianFilter {
  double radius_x = 1.5, radius_y = 1.5, sigma = 0.5;
  bool operator==(const GaussianFilter&) const = default;
};
// It is Mitchell and Netravali's (1988), with their B and C; its two radii of support are stretched to the
// radius.
struct MitchellFilter {
  double radius_x = 2, radius_y = 2, b = 1.0 / 3, c = 1.0 / 3;
  bool operator==(const MitchellFilter&) const = default;
};
// It is sinc(x)·sinc(x/τ): Lanczos' window of τ lobes, cut at the radius.
struct SincFilter {
  double radius_x = 4, radius_y = 4, tau = 3;
  bool operator==(const SincFilter&) const = default;
};
using Filter = std::variant<BoxFilter, TriangleFilter, GaussianFilter, MitchellFilter, SincFilter>;

// It is the pixels x in [x0,x1), y in [y0,y1), from the top left.
struct PixelRect {
  int x0 = 0, x1 = 0, y0 = 0, y1 = 0;
  bool operator==(const PixelRect&) const = default;
};

// It stands for sRGB's curve in place of an exponent.
inline constexpr double srgb_gamma = 0;

// It holds size, filter, spectrum and layers of a film.
struct FilmSettings {
  int width = 1280, height = 720;
  PixelRect crop{0, 1280, 0, 720};
  Filter filter = GaussianFilter{};
  double imaging_ratio = 1;  // every pixel is multiplied by it (pbrt: exposure time · ISO / 100)
  SpectralBins spectrum;     // kept beside the colours; none: colours alone
  FilmLayers layers;         // of the first surfaces, kept too
  // Light is sum^gamma, of red, green and blue each, as in POV-Ray's scenes of another assumed_gamma than 1:
  // they add up colours of a screen. srgb_gamma stands for sRGB's curve.
  double working_gamma = 1;
  bool operator==(const FilmSettings&) const = default;
};

}  // namespace vitrail
