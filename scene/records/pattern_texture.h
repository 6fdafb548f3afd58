// SPDX-License-Identifier: Apache-2.0
// These are POV-Ray's patterns (its documentation, "Patterns" and "Pattern modifiers"), under their names
// there: a number at every point of space, and a map from numbers to values.
#pragma once

#include <cstdint>
#include <vector>

#include "scene/geometry/transform.h"
#include "scene/records/parameter.h"
#include "scene/records/pattern_formula.h"

namespace vitrail {

// It is `turbulence <amount>`, `octaves`, `lambda`, `omega`: the point is moved by amount · Σ
// omegaⁱ·n(lambdaⁱ·p) of a vector n of noises.
struct PatternTurbulence {
  Vector3d amount{0, 0, 0};
  int octaves = 6;  // 1 … 10
  float lambda = 2, omega = 0.5f;
  bool operator==(const PatternTurbulence&) const = default;
};

// It is `brick_size`, `mortar`: bricks repeat by their size from 0 on; so much of the end of each is mortar.
struct PatternBrick {
  Vector3d size{8, 3, 4.5};
  float mortar = 0.5f;
  bool operator==(const PatternBrick&) const = default;
};

// It is `crackle` with `form`, `metric`, `offset`, `solid`. d1, d2, d3 are the distances to the nearest
// points of a random set, one a unit cell (by Minkowski's metric of that exponent, the offset being how far
// they all are along a fourth axis). The value is form.x·d1 + form.y·d2 + form.z·d3 in [0, 1], or where solid
// a random number of the nearest point.
struct PatternCrackle {
  Vector3d form{-1, 1, 0};
  float metric = 2;  // 1: Manhattan, 2: Euclid
  float offset = 0;
  bool solid = false;
  bool operator==(const PatternCrackle&) const = default;
};

// It is an entry of `color_map`, `pigment_map` …: `[at value]`.
struct PatternStop {
  float at = 0;  // 0 … 1, not below the one before
  SpectrumParameter value;
  bool operator==(const PatternStop&) const = default;
};

// It is `noise_generator`: 1 cuts off what leaves 0 … 1, 2 is scaled so that it seldom does. POV-Ray's third
// has another lattice; it is the second here.
enum class NoiseGenerator : std::uint8_t { original, corrected };

// It gives the value v of a pattern at a point p of its space. Between the stops of the map values are mixed
// linearly; the first and the last hold beyond.
struct PatternTexture {
  enum class Kind : std::uint8_t {
    // These choose a value of the map by its place in it: `at` is not looked at, nor the wave.
    checker,  // unit cubes, in turn the first and the second; the first has (0,0,0) … (1,1,1)
    hexagon,  // of side 1 in x and z, three values
    brick,    // mortar, bricks

    gradient,     // p · direction, with the direction as a unit vector: what is beyond whole numbers
    boxed,        // 1 − max(|x|,|y|,|z|), 0 outside of the cube
    cylindrical,  // 1 − √(x² + z²), 0 outside of the cylinder
    planar,       // 1 − |y|, 0 beyond 1
    spherical,    // 1 − |p|, 0 outside of the sphere
    cells,        // a random number for each unit cube
    leopard,      // ((sin x + sin y + sin z)/3)²
    marble,       // x; turbulence moves it along x
    onion,        // |p|: what is beyond whole numbers
    radial,       // by the angle around y: 0 at +x, ¼ at −z, ½ at −x, ¾ at +z
    spiral1,      // `arms` around z, that turn by one arm a unit of the distance to it and of z
    wood,         // √(x² + y²), turbulence moves it in x and y

    agate,     // bands of a sine that noise turns
    bozo,      // noise
    bumps,     // noise
    crackle,   // PatternCrackle
    dents,     // noise³
    granite,   // Σ min(|1 − 2·noise(4·2ⁱ·p)|, ½)/2ⁱ, i < 6; of the original |½ − noise|
    ripples,   // the mean of sines of the distances to ten points around
    waves,     // likewise, of ten wavelengths and heights
    wrinkles,  // ½·Σ wide noise(2ⁱ·p)/2ⁱ, i < 10
    mandel,    // steps of z ↦ z² + x + iy, from x + iy, after which |z| ≤ 2, over `iterations`
    formula,   // what is left on the stack by `steps`
  };
  // It is `ramp_wave` …, a function of t, the part of frequency · v + phase beyond whole numbers.
  enum class Wave : std::uint8_t {
    ramp,      // t
    triangle,  // 0 at 0 and 1, 1 at ½; POV-Ray's default for marble and wood
    sine,      // (1 + sin 2πt)/2
    scallop,   // |sin πt|
    cubic,     // t²(3 − 2t)
    poly,      // t^exponent
  };
  Kind kind = Kind::checker;
  // The pattern is looked up at the point of the world under the inverse of this, whatever instance has it;
  // then in the first tile, then moved by turbulence. By (u,v) it is (u, v, 0) in place of that of the world.
  // Normals are tilted by the world's alone.
  Transform texture_to_world;
  bool by_uv = false;
  Vector3d repeat{0, 0, 0};  // `warp { repeat }`: tiles from 0 to this along an axis; 0: none along it
  PatternTurbulence turbulence;
  NoiseGenerator noise = NoiseGenerator::corrected;
  float frequency = 1, phase = 0;
  Wave wave = Wave::ramp;
  float exponent = 1;           // of `poly_wave`
  Vector3d direction{1, 0, 0};  // of a gradient
  PatternBrick brick;
  PatternCrackle crackle;
  int arms = 1;                  // of spiral1
  float agate_turb = 1;          // of agate
  int iterations = 100;          // of mandel, at most 10000
  std::vector<PatternStop> map;  // empty: the number itself, as grey
  // These are for a formula. Its patterns are no formulas, and have constants in their maps.
  std::vector<PatternStep> steps;
  std::vector<PatternFractal> fractals;
  std::vector<PatternTexture> patterns;
  bool operator==(const PatternTexture&) const = default;
};

// Returns whether values of the map are chosen by their places in it.
inline bool is_of_places(PatternTexture::Kind kind) { return kind <= PatternTexture::Kind::brick; }

}  // namespace vitrail
