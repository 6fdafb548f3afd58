// SPDX-License-Identifier: Apache-2.0
#include "tracer/textures/noise.h"

#include <algorithm>
#include <cstdint>

#include "scene/geometry/portable_math.h"

namespace vitrail {

namespace {

// Perlin's permutation of 0 … 255 (2002).
constexpr std::array<std::uint8_t, 256> permutation{
    151, 160, 137, 91,  90,  15,  131, 13,  201, 95,  96,  53,  194, 233, 7,   225, 140, 36,  103, 30,
    69,  142, 8,   99,  37,  240, 21,  10,  23,  190, 6,   148, 247, 120, 234, 75,  0,   26,  197, 62,
    94,  252, 219, 203, 117, 35,  11,  32,  57,  177, 33,  88,  237, 149, 56,  87,  174, 20,  125, 136,
    171, 168, 68,  175, 74,  165, 71,  134, 139, 48,  27,  166, 77,  146, 158, 231, 83,  111, 229, 122,
    60,  211, 133, 230, 220, 105, 92,  41,  55,  46,  245, 40,  244, 102, 143, 54,  65,  25,  63,  161,
    1,   216, 80,  73,  209, 76,  132, 187, 208, 89,  18,  169, 200, 196, 135, 130, 116, 188, 159, 86,
    164, 100, 109, 198, 173, 186, 3,   64,  52,  217, 226, 250, 124, 123, 5,   202, 38,  147, 118, 126,
    255, 82,  85,  212, 207, 206, 59,  227, 47,  16,  58,  17,  182, 189, 28,  42,  223, 183, 170, 213,
    119, 248, 152, 2,   44,  154, 163, 70,  221, 153, 101, 155, 167, 43,  172, 9,   129, 22,  39,  253,
    19,  98,  108, 110, 79,  113, 224, 232, 178, 185, 112, 104, 218, 246, 97,  228, 251, 34,  242, 193,
    238, 210, 144, 12,  191, 179, 162, 241, 81,  51,  145, 235, 249, 14,  239, 107, 49,  192, 214, 31,
    181, 199, 106, 157, 184, 84,  204, 176, 115, 121, 50,  45,  127, 4,   150, 254, 138, 236, 205, 93,
    222, 114, 67,  29,  24,  72,  243, 141, 128, 195, 78,  66,  215, 61,  156, 180};

std::uint8_t permuted(int i) { return permutation[static_cast<std::size_t>(i & 255)]; }

// A gradient of ±1 along two axes, times the offset from its corner.
double gradient(int x, int y, int z, double dx, double dy, double dz) {
  const int hash = permuted(permuted(permuted(x) + y) + z) & 15;
  const bool flat = hash == 12 || hash == 13;  // in x and y, as the first four are
  const double u = hash < 8 || flat ? dx : dy, v = hash < 4 || flat ? dy : dz;
  return (hash & 1 ? -u : u) + (hash & 2 ? -v : v);
}

double mix(double t, double a, double b) { return (1 - t) * a + t * b; }
double fade(double t) { return t * t * t * (t * (6 * t - 15) + 10); }

struct Cell {
  int index = 0;      // modulo 256
  double offset = 0;  // in [0, 1)
};
Cell cell_of(double x) {
  const double cell = std::floor(x);
  return {static_cast<int>(cell - 256 * std::floor(cell / 256)), x - cell};
}

Point3d scaled(Point3d p, double by) { return {p.x * by, p.y * by, p.z * by}; }

// Calls f(weight, point) for every octave; gives the weight of the one that would follow.
template <class F>
double for_octaves(Point3d p, double omega, int octaves, F&& f) {
  constexpr double lacunarity = 1.99;
  double weight = 1, frequency = 1;
  for (int i = 0; i < octaves; ++i, weight *= omega, frequency *= lacunarity) f(weight, scaled(p, frequency));
  return weight;
}

// Which of marble's colours each of the nine points of its curve has.
constexpr std::array<std::size_t, 9> curve{0, 0, 0, 1, 2, 0, 0, 3, 0};

}  // namespace

double perlin_noise(Point3d p) {
  constexpr double integers_only = 4503599627370496.0;  // 2⁵²: nothing lies between corners beyond it
  if (!(std::abs(p.x) < integers_only && std::abs(p.y) < integers_only && std::abs(p.z) < integers_only))
    return 0;
  const Cell x = cell_of(p.x), y = cell_of(p.y), z = cell_of(p.z);
  const auto corner = [&](int i, int j, int k) {
    return gradient(x.index + i, y.index + j, z.index + k, x.offset - i, y.offset - j, z.offset - k);
  };
  const double wx = fade(x.offset), wy = fade(y.offset), wz = fade(z.offset);
  const auto along_x = [&](int j, int k) { return mix(wx, corner(0, j, k), corner(1, j, k)); };
  const auto along_y = [&](int k) { return mix(wy, along_x(0, k), along_x(1, k)); };
  return mix(wz, along_y(0), along_y(1));
}

double fractal_noise(Point3d p, double omega, int octaves) {
  double sum = 0;
  for_octaves(p, omega, octaves, [&](double weight, Point3d q) { sum += weight * perlin_noise(q); });
  return sum;
}

double turbulence(Point3d p, double omega, int octaves) {
  double sum = 0;
  const double rest = for_octaves(
      p, omega, octaves, [&](double weight, Point3d q) { sum += weight * std::abs(perlin_noise(q)); });
  return sum + 0.2 * rest;
}

double noise_value(const NoiseTexture& texture, Point3d p) {
  const double omega = static_cast<double>(texture.roughness);
  switch (texture.kind) {
    case NoiseTexture::Kind::wrinkled:
      return turbulence(p, omega, texture.octaves);
    case NoiseTexture::Kind::windy:
      return std::abs(fractal_noise(scaled(p, 0.1), 0.5, 3)) * fractal_noise(p, 0.5, 6);
    default:
      return fractal_noise(p, omega, texture.octaves);
  }
}

// A cubic Bézier curve through segments of four colours, by the sine of a wave that noise disturbs.
std::array<double, marble_color_count> marble_weights(const NoiseTexture& texture, Point3d p) {
  const Point3d q = scaled(p, static_cast<double>(texture.scale));
  const double wave = q.y + static_cast<double>(texture.variation) *
                                fractal_noise(q, static_cast<double>(texture.roughness), texture.octaves);
  constexpr std::size_t segments = curve.size() - 3;
  const double along = (0.5 + 0.5 * portable_sin(wave)) * segments;
  const auto first = std::min(static_cast<std::size_t>(along), segments - 1);
  const double t = along - static_cast<double>(first), s = 1 - t;
  const std::array<double, 4> bernstein{s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t};
  std::array<double, marble_color_count> weights{};
  for (std::size_t k = 0; k < 4; ++k) weights[curve[first + k]] += bernstein[k];
  return weights;
}

constexpr std::array<SigmoidSpectrum, marble_color_count> marble_colors{
    {{1.36677891e-05f, -0.015844807f, 5.67737675f, {0.87f, 0.87f, 0.9f}},
     {0, 0, 0.577350259f, {0.75f, 0.75f, 0.75f}},
     {1.12742418e-06f, -6.74929979e-05f, 0.91115582f, {0.9f, 0.885f, 0.87f}},
     {2.35829157e-05f, -0.0275279935f, 7.57252026f, {0.3f, 0.3f, 0.495f}}}};

bool inside_dot(double s, double t) {
  constexpr double radius = 0.35, most_shift = 0.5 - radius;
  const double cell_s = std::floor(s + 0.5), cell_t = std::floor(t + 0.5);
  const auto noise = [&](double ds, double dt) { return perlin_noise({cell_s + ds, cell_t + dt, 0.5}); };
  if (!(noise(0.5, 0.5) > 0)) return false;
  const double from_s = s - (cell_s + most_shift * noise(1.5, 2.8)),
               from_t = t - (cell_t + most_shift * noise(4.5, 9.8));
  return from_s * from_s + from_t * from_t < radius * radius;
}

}  // namespace vitrail
