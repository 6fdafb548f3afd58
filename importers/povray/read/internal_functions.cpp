// SPDX-License-Identifier: Apache-2.0
// Formulas of functions.inc, as its comments and POV-Ray's documentation name them. Surfaces are by the
// equations under which they are known. What povray prints decides their signs, factors and limits: the
// coefficients of its polynomials were found by least squares (read_include_formulas_test.cpp has numbers).
#include "importers/povray/read/internal_functions.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "importers/povray/read/function.h"
#include "scene/models/pattern_noise.h"

namespace vitrail::pov {

namespace {

using Op = PatternStep::Op;

// ---- Functions of both kinds of numbers

double square_of(double a) { return a * a; }
double cube_of(double a) { return a * a * a; }
double root_of(double a) { return std::sqrt(std::max(a, 0.0)); }
double size_of(double a) { return std::abs(a); }
double cosine_of(double a) { return std::cos(a); }
double sine_of(double a) { return std::sin(a); }
double exponential_of(double a) { return std::exp(a); }
double power_of(double a, double b) { return std::pow(a, b); }
double angle_of(double a, double b) { return std::atan2(a, b); }
double larger_of(double a, double b) { return std::max(a, b); }
double smaller_of(double a, double b) { return std::min(a, b); }
double first_if(double truth, double a, double b) { return truth >= 0 ? a : b; }

Steps square_of(const Steps& a) { return Steps::of(Op::square, {a}); }
Steps cube_of(const Steps& a) { return Steps::of(Op::power, {a, 3}); }
Steps root_of(const Steps& a) { return Steps::of(Op::sqrt, {a}); }
Steps size_of(const Steps& a) { return Steps::of(Op::absolute, {a}); }
Steps cosine_of(const Steps& a) { return Steps::of(Op::cos, {a}); }
Steps sine_of(const Steps& a) { return Steps::of(Op::sin, {a}); }
Steps exponential_of(const Steps& a) { return Steps::of(Op::exp, {a}); }
Steps power_of(const Steps& a, const Steps& b) { return Steps::of(Op::power, {a, b}); }
Steps angle_of(const Steps& a, const Steps& b) { return Steps::of(Op::atan2, {a, b}); }
Steps larger_of(const Steps& a, const Steps& b) { return Steps::of(Op::max, {a, b}); }
Steps smaller_of(const Steps& a, const Steps& b) { return Steps::of(Op::min, {a, b}); }
Steps first_if(const Steps& truth, const Steps& a, const Steps& b) {
  return Steps::of(Op::choose, {truth, b, a, a});
}

// ---- Points

template <class N>
struct Arguments {
  N x, y, z;
  const N* p;  // the parameters

  N x2() const { return square_of(x); }
  N y2() const { return square_of(y); }
  N z2() const { return square_of(z); }
  N all2() const { return x2() + y2() + z2(); }
  N around_y2() const { return x2() + z2(); }
  N around_x2() const { return y2() + z2(); }
};

// Returns the arguments of a curve in the plane: x and y, or where the switch p[i] is on √(x² + z²) − p[i+1]
// and y, turned by p[i+2] degrees.
template <class N>
Arguments<N> revolved(const Arguments<N>& a, std::size_t i) {
  const N turn = a.p[i + 2] * N(std::numbers::pi / 180), cosine = cosine_of(turn), sine = sine_of(turn);
  const N out = root_of(a.around_y2()) - a.p[i + 1], on = a.p[i] - N(0.5);
  return {first_if(on, out * cosine - a.y * sine, a.x), first_if(on, out * sine + a.y * cosine, a.y), a.z,
          a.p};
}

template <class N>
N within(const N& value, const N& limit) {
  return larger_of(-limit, smaller_of(value, limit));
}

// ---- Entries of the table; F is a function without state

template <class F>
constexpr InternalFormula free_formula(int number, std::size_t count, F) {
  return {number, count,
          [](const double* a) -> double {
            return F{}(Arguments<double>{a[0], a[1], a[2], a + 3});
          },
          [](const Steps* a) -> Steps {
            return F{}(Arguments<Steps>{a[0], a[1], a[2], a + 3});
          }};
}
// A surface times p[0], its field strength, within ±10.
template <class F>
constexpr InternalFormula surface(int number, std::size_t count, F) {
  return free_formula(number, count, [](auto a) { return within(a.p[0] * F{}(a), decltype(a.x)(10.0)); });
}
// That of a curve, whose last three parameters say how it is revolved.
template <class F>
constexpr InternalFormula curve(int number, std::size_t count, F) {
  switch (count) {
    case 9:
      return surface(number, count, [](auto a) { return F{}(revolved(a, 3)); });
    default:
      return surface(number, count, [](auto a) { return F{}(revolved(a, 4)); });
  }
}
// That of an algebraic curve: within ±p[1].
template <class F>
constexpr InternalFormula cylinder(int number, F) {
  return free_formula(number, 8, [](auto a) { return within(a.p[0] * F{}(revolved(a, 2)), a.p[1]); });
}

// ---- Noise

// By the second generator, whichever the scene's patterns have.
double noise_of(const double* a) { return pattern_noise({a[0], a[1], a[2]}); }
double noise_by_generator(const double* a) {
  return pattern_noise({a[0], a[1], a[2]}, noise_generator(a[3]));
}
Steps noise_of(const Steps* a) { return Steps::of(Op::noise, {a[0], a[1], a[2], 2}); }
template <Op op, std::size_t count>
Steps noise_steps(const Steps* a) {
  return Steps::of(op, {a, a + count});
}

// Apéry's equation of Boy's surface.
constexpr auto boy = [](auto a) {
  const double root = std::numbers::sqrt2;
  const auto r = a.x2() + a.y2(), z = a.z, z2 = a.z2(), above = 1 - z;
  return a.p[1] * (64 * cube_of(above * z) - 48 * square_of(above) * z2 * (3 * r + 2 * z2) +
                   12 * above * z *
                       (27 * square_of(r) - 24 * z2 * r + 36 * root * a.y * z * (a.y2() - 3 * a.x2()) +
                        4 * square_of(z2)) +
                   (9 * r - 2 * z2) * (108 * root * a.x * z * (a.x2() - 3 * a.y2()) - 81 * square_of(r) -
                                       72 * z2 * r + 4 * square_of(z2)));
};
// A torus, inverted at a sphere; povray's has a term more where it is displaced along y.
constexpr auto dupin = [](auto a) {
  const auto big2 = square_of(a.p[1]), small2 = square_of(a.p[2]), s2 = square_of(a.p[5]);
  const auto q = a.all2(), sum = square_of(a.p[3]) + square_of(a.p[4]) + big2 - small2;
  return 4 * big2 * (square_of(s2 * a.x - q * a.p[3]) + square_of(s2 * a.z)) -
         square_of(square_of(s2) - 2 * s2 * (a.x * a.p[3] + a.y * a.p[4]) + q * sum) -
         8 * s2 * a.p[4] * (big2 - small2) * a.y * q;
};
// x⁴ + y⁴ + z⁴, and x²y² + y²z² + z²x².
constexpr auto fourths = [](const auto& a) {
  return square_of(a.x2()) + square_of(a.y2()) + square_of(a.z2());
};
constexpr auto products = [](const auto& a) { return a.x2() * a.y2() + a.y2() * a.z2() + a.z2() * a.x2(); };
constexpr auto cushion = [](auto a) {
  return a.z2() * a.x2() - square_of(a.z2()) - 2 * a.z * a.x2() + 2 * a.z * a.z2() + a.x2() - a.z2() -
         square_of(a.x2() - a.z) - square_of(a.y2()) - 2 * a.x2() * a.y2() - a.y2() * a.z2() +
         2 * a.y2() * a.z + a.y2();
};
constexpr auto piece_of_blob = [](auto a, auto from, auto inverse) {
  const auto rest =
      larger_of(decltype(from)(0.0), 1 - square_of(inverse) * (square_of(a.x - from) + a.around_x2()));
  return square_of(rest);
};

constexpr InternalFormula known[] = {
    // f_algbr_cyl2 … 4: a tacnode, a ramphoid cusp and a trifolium
    cylinder(1,
             [](auto a) {
               return 3 * a.x2() * a.y + 2 * a.y * a.y2() - 2 * square_of(a.x2()) - a.y2() -
                      square_of(a.y2());
             }),
    cylinder(2,
             [](auto a) {
               return 2 * a.x2() * a.y + a.x * a.y2() - a.y2() - square_of(a.x2()) - a.x2() * a.y2();
             }),
    cylinder(3, [](auto a) { return a.y * a.y2() - 3 * a.x2() * a.y - square_of(a.x2() + a.y2()); }),
    surface(4, 5,
            [](auto a) {  // f_bicorn
              const auto size2 = square_of(a.p[1]);
              return a.y2() * (size2 - a.around_y2()) - square_of(a.around_y2() + 2 * a.p[1] * a.y - size2);
            }),
    surface(5, 5, [](auto a) { return a.p[1] * a.y * a.around_y2() - square_of(a.all2()); }),  // f_bifolia
    free_formula(6, 8,
                 [](auto a) {  // f_blob: P0 distance; strength and inverse radius of each
                   return -a.p[1] * piece_of_blob(a, -0.5 * a.p[0], a.p[2]) -
                          a.p[3] * piece_of_blob(a, 0.5 * a.p[0], a.p[4]);
                 }),
    surface(8, 5, boy),                                                        // f_boy_surface
    surface(11, 4, [](auto a) { return a.x2() * a.z2() - a.y; }),              // f_crossed_trough
    surface(12, 4, [](auto a) { return a.z - cube_of(a.x) + cube_of(a.y); }),  // f_cubic_saddle
    surface(13, 4, cushion),
    surface(14, 4,
            [](auto a) {  // f_devils_curve
              return a.y2() * (a.y2() - 0.25) + 0.36 * a.x2() - square_of(a.around_y2());
            }),
    curve(15, 9,
          [](auto a) {  // f_devils_curve_2d
            return a.y2() * (a.y2() - square_of(a.p[2])) - a.x2() * (a.x2() - square_of(a.p[1]));
          }),
    surface(16, 9, dupin),  // f_dupin_cyclid
    free_formula(17, 6,
                 [](auto a) {  // f_ellipsoid
                   return root_of(square_of(a.x * a.p[0]) + square_of(a.y * a.p[1]) +
                                  square_of(a.z * a.p[2]));
                 }),
    surface(20, 6,
            [](auto a) {  // f_folium_surface
              return a.around_x2() * (1 - (4 * a.p[1] - a.p[2]) * a.x) + (1 + a.p[2]) * a.x2();
            }),
    curve(21, 9,
          [](auto a) {  // f_folium_surface_2d
            return -(a.y2() * (1 - (4 * a.p[1] - a.p[2]) * a.x) + (1 + a.p[2]) * a.x2());
          }),
    surface(22, 4,
            [](auto a) {  // f_glob
              return 0.5 * square_of(a.x2()) * (a.x + 1) - a.around_x2();
            }),
    surface(23, 4,
            [](auto a) {  // f_heart (Taubin 1994)
              return (0.1 * a.x2() + a.y2()) * cube_of(a.z) - cube_of(2 * a.x2() + a.around_x2() - 1);
            }),
    {29, 9, hetero_multifractal, noise_steps<Op::hetero_mf, 9>},
    surface(30, 4,
            [](auto a) {  // f_hunt_surface
              return -(4 * cube_of(a.all2() - 13) + 27 * square_of(3 * a.x2() + a.y2() - 4 * a.z2() - 12));
            }),
    surface(31, 6,
            [](auto a) {  // f_hyperbolic_torus
              const auto big2 = square_of(a.p[1]), small2 = square_of(a.p[2]);
              return 4 * big2 * (a.x2() - a.z2()) - square_of(a.x2() + a.y2() - a.z2() + big2 - small2);
            }),
    surface(33, 6,
            [](auto a) {  // f_kampyle_of_eudoxus
              return square_of(a.p[2]) * a.x2() * (a.x2() - square_of(a.p[1])) - a.around_x2();
            }),
    curve(34, 9,
          [](auto a) {  // f_kampyle_of_eudoxus_2d
            return square_of(a.p[2]) * a.x2() * (a.x2() - a.p[1] * a.p[2]) - a.y2();
          }),
    surface(35, 4,
            [](auto a) {  // f_klein_bottle
              const auto below = a.all2() - 2 * a.y - 1;
              return -((a.all2() + 2 * a.y - 1) * (square_of(below) - 8 * a.z2()) + 16 * a.x * a.z * below);
            }),
    surface(36, 4, [](auto a) { return a.all2() + products(a) - fourths(a) - 1; }),  // f_kummer_surface_v1
    surface(37, 7,
            [](auto a) {  // f_kummer_surface_v2
              return 1 - fourths(a) - a.p[1] * a.all2() - a.p[2] * products(a) - a.p[3] * a.x * a.y * a.z;
            }),
    surface(38, 4,
            [](auto a) { return a.x2() - square_of(a.x2()) - a.around_x2(); }),  // f_lemniscate_of_gerono
    curve(39, 9,
          [](auto a) {  // f_lemniscate_of_gerono_2d
            return square_of(a.p[2]) * a.x2() * (square_of(a.p[1]) - a.x2()) - a.y2();
          }),
    surface(41, 4,
            [](auto a) {  // f_mitre
              return a.y2() * (1 - a.around_x2()) - 4 * a.x2() * a.all2();
            }),
    surface(42, 4, [](auto a) { return 6 * a.y * a.z - cube_of(a.y) - cube_of(a.z); }),  // f_nodal_cubic
    surface(43, 4, cushion),                                                             // f_odd
    surface(44, 7,
            [](auto a) {  // f_ovals_of_cassini
              const auto big2 = square_of(a.p[1]);
              return square_of(a.p[2]) + a.p[3] * big2 * a.around_y2() - square_of(a.all2() + big2);
            }),
    surface(45, 4, [](auto a) { return a.y - a.around_y2(); }),  // f_paraboloid
    surface(46, 6,
            [](auto a) {  // f_parabolic_torus
              const auto big2 = square_of(a.p[1]), difference = big2 - square_of(a.p[2]),
                         s = a.x2() + a.y2() - a.z;
              return 2 * big2 * (a.x2() - a.z) - square_of(s) - difference * s - square_of(difference);
            }),
    free_formula(47, 3, [](auto a) { return angle_of(root_of(a.around_y2()), a.y); }),  // f_ph
    surface(48, 4, [](auto a) { return fourths(a) - a.all2(); }),                       // f_pillow
    surface(49, 4, [](auto a) { return a.x2() * (a.x2() - a.x) + a.around_x2(); }),     // f_piriform
    curve(50, 10,
          [](auto a) {  // f_piriform_2d
            return square_of(a.p[3]) * cube_of(a.x) * (a.p[1] + a.p[2] * a.x) - a.y2();
          }),
    free_formula(51, 8,
                 [](auto a) {  // f_poly4: P0 … P4 the radius at each y
                   return root_of(a.around_y2()) -
                          (a.p[0] + a.y * (a.p[1] + a.y * (a.p[2] + a.y * (a.p[3] + a.y * a.p[4]))));
                 }),
    surface(54, 4,
            [](auto a) { return a.y - square_of(a.x2()) - square_of(a.z2()); }),  // f_quartic_paraboloid
    surface(55, 4, [](auto a) { return a.y - square_of(a.x2()) + square_of(a.z2()); }),  // f_quartic_saddle
    surface(56, 6,
            [](auto a) {  // f_quartic_cylinder
              const auto width2 = square_of(a.p[2]);
              return square_of(a.p[1]) * width2 - (width2 + a.y2()) * a.around_y2();
            }),
    free_formula(57, 3, [](auto a) { return root_of(a.all2()); }),  // f_r
    {59, 9, ridged_multifractal, noise_steps<Op::ridged_mf, 9>},
    free_formula(60, 7,
                 [](auto a) {  // f_rounded_box: P0 radius, P1 … P3 half sizes
                   const auto beyond = [&](auto at, auto half) {
                     return square_of(larger_of(decltype(at)(0.0), size_of(at) - (half - a.p[0])));
                   };
                   return root_of(beyond(a.x, a.p[1]) + beyond(a.y, a.p[2]) + beyond(a.z, a.p[3])) - a.p[0];
                 }),
    free_formula(61, 4, [](auto a) { return root_of(a.all2()) - a.p[0]; }),  // f_sphere
    free_formula(63, 7,
                 [](auto a) {  // f_spikes_2d
                   return a.y - a.p[0] * cosine_of(a.p[1] * a.x) * cosine_of(a.p[2] * a.z) *
                                    exponential_of(-a.p[3] * a.around_y2());
                 }),
    surface(65, 4, [](auto a) { return -(products(a) + a.x * a.y * a.z); }),  // f_steiners_roman
    surface(66, 7,
            [](auto a) {  // f_strophoid
              return (a.x - a.p[2]) * a.around_x2() + square_of(a.p[3]) * a.x2() * (a.x + a.p[1]);
            }),
    curve(67, 10,
          [](auto a) {  // f_strophoid_2d
            return (a.x - a.p[2]) * a.y2() + square_of(a.p[3]) * a.x2() * (a.x + a.p[1]);
          }),
    free_formula(68, 5,
                 [](auto a) {  // f_superellipsoid
                   const auto e = 2 / a.p[0], n = a.p[0] / a.p[1];
                   return 1 - power_of(power_of(power_of(size_of(a.x), e) + power_of(size_of(a.y), e), n) +
                                           power_of(size_of(a.z), 2 / a.p[1]),
                                       0.5 * a.p[1]);
                 }),
    free_formula(69, 3, [](auto a) { return angle_of(a.x, a.z); }),  // f_th
    free_formula(70, 5,
                 [](auto a) {  // f_torus
                   return root_of(square_of(root_of(a.around_y2()) - a.p[0]) + a.y2()) - a.p[1];
                 }),
    surface(71, 6,
            [](auto a) {  // f_torus2
              const auto big2 = square_of(a.p[1]), small2 = square_of(a.p[2]);
              return 4 * big2 * a.around_y2() - square_of(a.all2() + big2 - small2);
            }),
    surface(72, 4,
            [](auto a) {  // f_torus_gumdrop
              return 20 * a.all2() - 17 - 17 * a.x2() * a.around_x2() -
                     4 * (square_of(a.x2()) + square_of(a.around_x2()));
            }),
    surface(73, 4, [](auto a) { return a.y * a.z2() - a.x2(); }),                      // f_umbrella
    surface(74, 5, [](auto a) { return a.p[1] * (1 - a.y) - a.y * a.around_y2(); }),   // f_witch_of_agnesi
    curve(75, 9, [](auto a) { return a.p[2] - a.y * (a.x2() + square_of(a.p[1])); }),  // f_witch_of_agnesi_2d
    {76, 3, noise_of, noise_of},                                                       // f_noise3d
    {78, 4, noise_by_generator, noise_steps<Op::noise, 4>},                            // f_noise_generator
};

}  // namespace

const InternalFormula* internal_formula(int number) {
  const auto* found = std::ranges::find(known, number, &InternalFormula::number);
  return found == std::end(known) ? nullptr : found;
}

Shared<Function> internal_function(int number) {
  const InternalFormula* formula = internal_formula(number);
  if (!formula) return nullptr;
  auto function = std::make_shared<Function>();
  function->built_in = formula->value;
  function->count = formula->count, function->number = number;
  return function;
}

}  // namespace vitrail::pov
