// SPDX-License-Identifier: Apache-2.0
#include "compare/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

#include "compare/metrics.h"
#include "scene/spectra/color.h"

namespace vitrail {

namespace {

using std::numbers::pi;

// One value a pixel, row by row.
using Plane = std::vector<float>;
using Planes = std::array<Plane, 3>;

struct Size {
  int width, height;
};

// ---- filters, as rows of weights from −radius to radius -----------------------------------------------

using Taps = std::vector<float>;

Taps taps(int radius, const std::function<double(int)>& weight) {
  Taps row;
  for (int x = -radius; x <= radius; ++x) row.push_back(static_cast<float>(weight(x)));
  return row;
}

// So that what is positive sums to 1, and what is negative to −1.
Taps normalised(Taps row) {
  double positive = 0, negative = 0;
  for (const float w : row) (w > 0 ? positive : negative) += static_cast<double>(w);
  for (float& w : row) w = static_cast<float>(static_cast<double>(w) / (w > 0 ? positive : -negative));
  return row;
}

// Along rows (step 1) or columns; beyond its border an image goes on as it ends.
void convolve_rows(const Plane& in, Plane& out, Size size, const Taps& row) {
  const int radius = static_cast<int>(row.size()) / 2;
  Plane padded(static_cast<std::size_t>(size.width + 2 * radius));
  for (int y = 0; y < size.height; ++y) {
    const float* from = &in[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width)];
    for (int x = -radius; x < size.width + radius; ++x)
      padded[static_cast<std::size_t>(x + radius)] = from[std::clamp(x, 0, size.width - 1)];
    float* to = &out[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width)];
    std::fill(to, to + size.width, 0.f);
    for (std::size_t k = 0; k < row.size(); ++k)
      for (int x = 0; x < size.width; ++x) to[x] += row[k] * padded[static_cast<std::size_t>(x) + k];
  }
}

void convolve_columns(const Plane& in, Plane& out, Size size, const Taps& column) {
  const int radius = static_cast<int>(column.size()) / 2;
  for (int y = 0; y < size.height; ++y) {
    float* to = &out[static_cast<std::size_t>(y) * static_cast<std::size_t>(size.width)];
    std::fill(to, to + size.width, 0.f);
    for (std::size_t k = 0; k < column.size(); ++k) {
      const int row = std::clamp(y + static_cast<int>(k) - radius, 0, size.height - 1);
      const float* from = &in[static_cast<std::size_t>(row) * static_cast<std::size_t>(size.width)];
      for (int x = 0; x < size.width; ++x) to[x] += column[k] * from[x];
    }
  }
}

Plane convolved(const Plane& in, Size size, const Taps& row, const Taps& column) {
  Plane between(in.size()), out(in.size());
  convolve_rows(in, between, size, row);
  convolve_columns(between, out, size, column);
  return out;
}

// ---- colour ---------------------------------------------------------------------------------------------

struct Lab {
  double l, a, b;
};

const XYZ& white() {
  static const XYZ of_srgb = srgb_to_xyz({1, 1, 1});
  return of_srgb;
}

// YCxCz, a linear variant of CIELAB (2020, section 4.1).
Lab to_opponent(RGB c) {
  const XYZ v = srgb_to_xyz(c), w = white();
  return {116 * v.y / w.y - 16, 500 * (v.x / w.x - v.y / w.y), 200 * (v.y / w.y - v.z / w.z)};
}

RGB from_opponent(Lab c) {
  const XYZ w = white();
  const double y = (c.l + 16) / 116;
  return xyz_to_srgb({w.x * (y + c.a / 500), w.y * y, w.z * (y - c.b / 200)});
}

double cube_root_or_line(double t) {
  constexpr double delta = 6.0 / 29;
  return t > delta * delta * delta ? std::cbrt(t) : t / (3 * delta * delta) + 4.0 / 29;
}

// CIELAB with a and b less where it is dark, after Hunt (2020, equation 4).
Lab hunt_adjusted(RGB c) {
  const XYZ v = srgb_to_xyz(c), w = white();
  const double x = cube_root_or_line(v.x / w.x), y = cube_root_or_line(v.y / w.y),
               z = cube_root_or_line(v.z / w.z);
  const double l = 116 * y - 16;
  return {l, 0.01 * l * 500 * (x - y), 0.01 * l * 200 * (y - z)};
}

// The HyAB distance (Abasi, Tehran, Fairchild 2019), to the power of 0.7.
double color_distance(Lab a, Lab b) {
  return std::pow(std::abs(a.l - b.l) + std::hypot(a.a - b.a, a.b - b.b), 0.7);
}

// To [0, 1], the smaller 40 % of distances to 95 % of it (2020, section 4.1.3).
double redistributed(double distance) {
  static const double greatest = color_distance(hunt_adjusted({0, 1, 0}), hunt_adjusted({0, 0, 1}));
  constexpr double part = 0.4, share = 0.95;
  const double knee = part * greatest;
  return distance < knee ? share / knee * distance
                         : share + (distance - knee) / (greatest - knee) * (1 - share);
}

// ---- the two pipelines -----------------------------------------------------------------------------------

// What of an image the eye resolves: a sum of Gaussians a √(π/b) e^{−π²r²/b} for each opponent channel, r in
// degrees (2020, table 1 and equation 2).
class ContrastFilter {
 public:
  explicit ContrastFilter(double pixels_per_degree) : pixels_per_degree_(pixels_per_degree) {}

  Planes operator()(const Planes& in, Size size) const {
    return {gaussian(in[0], size, 0.0047), gaussian(in[1], size, 0.0053), blue_yellow(in[2], size)};
  }

 private:
  static constexpr double widest = 0.04;

  double weight(int x, double b) const {
    const double degrees = x / pixels_per_degree_;
    return std::exp(-pi * pi * degrees * degrees / b);
  }
  Taps row(double b) const {
    const int radius =
        static_cast<int>(std::ceil(3 * std::sqrt(widest / (2 * pi * pi)) * pixels_per_degree_));
    return taps(radius, [&](int x) { return weight(x, b); });
  }
  Plane gaussian(const Plane& in, Size size, double b) const {
    const Taps once = normalised(row(b));
    return convolved(in, size, once, once);
  }
  Plane blue_yellow(const Plane& in, Size size) const {
    constexpr double a[] = {34.1, 13.5}, b[] = {widest, 0.025};
    double share[2];
    for (int i = 0; i < 2; ++i) {
      double sum = 0;
      for (const float w : row(b[i])) sum += static_cast<double>(w);
      share[i] = a[i] * std::sqrt(pi / b[i]) * sum * sum;
    }
    Plane wide = gaussian(in, size, b[0]);
    const Plane narrow = gaussian(in, size, b[1]);
    const auto first = static_cast<float>(share[0] / (share[0] + share[1]));
    for (std::size_t p = 0; p < wide.size(); ++p) wide[p] = first * wide[p] + (1 - first) * narrow[p];
    return wide;
  }

  double pixels_per_degree_;
};

// Edges and points, as magnitudes of the gradient and of the second derivatives (2020, section 4.2).
struct Features {
  Plane edges, points;
};

Features features(const Plane& achromatic, Size size, double pixels_per_degree) {
  constexpr double width_degrees = 0.082;
  const double sigma = 0.5 * width_degrees * pixels_per_degree;
  const int radius = static_cast<int>(std::ceil(3 * sigma));
  const auto bell = [&](int x) { return std::exp(-x * x / (2 * sigma * sigma)); };
  const Taps smooth = normalised(taps(radius, bell)),
             first = normalised(taps(radius, [&](int x) { return -x * bell(x); })),
             second =
                 normalised(taps(radius, [&](int x) { return (x * x / (sigma * sigma) - 1) * bell(x); }));
  Plane grey = achromatic;
  for (float& v : grey) v = (v + 16) / 116;
  const auto magnitude = [&](const Taps& derivative) {
    Plane along_x = convolved(grey, size, derivative, smooth);
    const Plane along_y = convolved(grey, size, smooth, derivative);
    for (std::size_t p = 0; p < along_x.size(); ++p) along_x[p] = std::hypot(along_x[p], along_y[p]);
    return along_x;
  };
  return {magnitude(first), magnitude(second)};
}

// A shown image on its way through both.
struct Seen {
  std::vector<Lab> colors;
  Features features;
};

// `shown(v)`: what becomes of a channel's value, in [0, 1]. Pixels of `hidden` are black.
Seen see(const Image& image, const std::vector<bool>& hidden, double pixels_per_degree,
         const std::function<double(double)>& shown) {
  const Size size{image.width, image.height};
  Planes planes;
  planes.fill(Plane(image.pixels()));
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t p = 0; p < image.pixels(); ++p) {
    const auto channel = [&](std::size_t c) {
      return hidden[p] ? 0 : shown(static_cast<double>(image.values[channels * p + c]));
    };
    const Lab v = to_opponent({channel(0), channel(1), channel(2)});
    planes[0][p] = static_cast<float>(v.l);
    planes[1][p] = static_cast<float>(v.a);
    planes[2][p] = static_cast<float>(v.b);
  }
  Seen seen;
  seen.features = features(planes[0], size, pixels_per_degree);
  planes = ContrastFilter(pixels_per_degree)(planes, size);
  const auto unit = [](double v) { return std::clamp(v, 0.0, 1.0); };
  for (std::size_t p = 0; p < image.pixels(); ++p) {
    const RGB c = from_opponent({static_cast<double>(planes[0][p]), static_cast<double>(planes[1][p]),
                                 static_cast<double>(planes[2][p])});
    seen.colors.push_back(hunt_adjusted({unit(c.r), unit(c.g), unit(c.b)}));
  }
  return seen;
}

// The error of colour to the power of 1 − the error of features (2020, equation 13).
std::vector<double> difference(const Seen& a, const Seen& b) {
  std::vector<double> errors(a.colors.size());
  for (std::size_t p = 0; p < errors.size(); ++p) {
    const double color = redistributed(color_distance(a.colors[p], b.colors[p]));
    const float edge = std::abs(a.features.edges[p] - b.features.edges[p]),
                point = std::abs(a.features.points[p] - b.features.points[p]);
    const double feature = std::sqrt(static_cast<double>(std::max(edge, point)) / std::numbers::sqrt2);
    errors[p] = std::pow(color, 1 - feature);
  }
  return errors;
}

std::vector<bool> not_finite(const Image& image, const Image& reference) {
  require_same_size(image, reference);
  std::vector<bool> hidden(image.pixels());
  for (const Image* of : {&image, &reference})
    for (std::size_t i = 0; i < of->values.size(); ++i)
      if (!std::isfinite(of->values[i])) hidden[i / static_cast<std::size_t>(of->channels)] = true;
  return hidden;
}

void leave_out(std::vector<double>& errors, const std::vector<bool>& hidden) {
  for (std::size_t p = 0; p < errors.size(); ++p)
    if (hidden[p]) errors[p] = std::numeric_limits<double>::quiet_NaN();
}

// (a₀v² + a₁v + a₂)/(a₃v² + a₄v + a₅), Narkowicz's fit (2016) of ACES' curve, at 0.6 v.
constexpr double aces[] = {0.6 * 0.6 * 2.51, 0.6 * 0.03, 0, 0.6 * 0.6 * 2.43, 0.6 * 0.59, 0.14};

double tone(double v) {
  const double up = (aces[0] * v + aces[1]) * v + aces[2], down = (aces[3] * v + aces[4]) * v + aces[5];
  return std::clamp(up / down, 0.0, 1.0);
}

}  // namespace

FlipExposures flip_exposures(const Image& reference) {
  std::vector<double> luminances;
  const auto channels = static_cast<std::size_t>(reference.channels);
  for (std::size_t p = 0; p < reference.pixels(); ++p) {
    const float* v = &reference.values[channels * p];
    const double y =
        srgb_to_xyz({static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])}).y;
    if (std::isfinite(y)) luminances.push_back(y);
  }
  if (luminances.empty()) return {};
  const auto middle = luminances.begin() + static_cast<std::ptrdiff_t>(luminances.size() / 2);
  std::nth_element(luminances.begin(), middle, luminances.end());
  constexpr double dark = 1e-12;  // a median of 0 would ask for exposures without end
  const double median = std::max(*middle, dark),
               greatest = std::max(*std::max_element(luminances.begin(), luminances.end()), median);
  // Where the curve reaches 85 %: the greater root of a quadratic (2021, section 3.1).
  constexpr double shown = 0.85, a = aces[0] - shown * aces[3], b = aces[1] - shown * aces[4],
                   c = aces[2] - shown * aces[5];
  const double at = (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
  FlipExposures exposures{std::log2(at / greatest), std::log2(at / median), 2};
  exposures.count = std::max(2, static_cast<int>(std::ceil(exposures.stop_ev - exposures.start_ev)));
  return exposures;
}

std::vector<double> ldr_flip(const Image& image, const Image& reference, double pixels_per_degree) {
  const std::vector<bool> hidden = not_finite(image, reference);
  const auto clamped = [](double v) { return std::clamp(v, 0.0, 1.0); };
  std::vector<double> errors = difference(see(image, hidden, pixels_per_degree, clamped),
                                          see(reference, hidden, pixels_per_degree, clamped));
  leave_out(errors, hidden);
  return errors;
}

std::vector<double> hdr_flip(const Image& image, const Image& reference, double pixels_per_degree) {
  const std::vector<bool> hidden = not_finite(image, reference);
  const FlipExposures exposures = flip_exposures(reference);
  std::vector<double> greatest(image.pixels());
  for (int i = 0; i < exposures.count; ++i) {
    const double ev =
        exposures.start_ev + i * (exposures.stop_ev - exposures.start_ev) / (exposures.count - 1);
    const auto shown = [gain = std::exp2(ev)](double v) { return tone(gain * std::max(v, 0.0)); };
    const std::vector<double> errors = difference(see(image, hidden, pixels_per_degree, shown),
                                                  see(reference, hidden, pixels_per_degree, shown));
    for (std::size_t p = 0; p < errors.size(); ++p) greatest[p] = std::max(greatest[p], errors[p]);
  }
  leave_out(greatest, hidden);
  return greatest;
}

}  // namespace vitrail
