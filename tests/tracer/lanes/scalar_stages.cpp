// SPDX-License-Identifier: Apache-2.0
#include "tests/tracer/lanes/fixtures.h"
#include "tests/tracer/lanes/results.h"
#include "tests/tracer/lanes/scalar_functions.h"
#include "tracer/lights/draw_light.h"
#include "tracer/rays/departing.h"
#include "tracer/rays/ray_records.h"
#include "tracer/surfaces/interaction.h"
#include "tracer/transport/aim.h"

namespace vitrail::lane_tests {

namespace {

Point3f float_point_of(const double* in) { return cast<float>(point_of(in)); }

Argument wavelength() { return float_number(350, 840, {360, 360.5, 829.5, 830, 400}); }

// A triangle that emits, and a point, some in its plane.
Argument lamp_and_point() {
  return {4, {{0, 0, 0, 0}}, [point = position()](Random& random, double* out) {
            const std::uint64_t slot = random() % fixture_lamps;
            const Point3f corner = fixtures().lights.slots[slot].p[0];
            out[0] = static_cast<double>(slot);
            point.random(random, out + 1);
            if (const auto axis = static_cast<int>(random() % 6); axis < 3)
              out[1 + axis] = static_cast<double>(corner[axis]);
          }};
}

ScalarFunction interaction(const char* name, std::size_t domain) {
  return {name,
          {word(fixture_clusters), word(cluster_width), number(0, 1, {0, 1, 0.25}),
           number(0, 1, {0, 1, 0.25}), magnitude(-10, 10, {0, 1e-3, 1e6}), float_direction()},
          [domain](const Context&, const double* in, double* out) {
            Hit hit;
            hit.cluster = static_cast<std::uint32_t>(in[0]), hit.lane = static_cast<std::uint32_t>(in[1]);
            hit.u = in[2], hit.v = in[3], hit.t = in[4];
            const Interaction at =
                make_interaction(fixtures().views[domain], hit, cast<float>(vector_of(in + 5)), 0, 0);
            Results{out} << at.p << at.out << at.geometric << at.shading << at.dpdu << at.uv.x << at.uv.y
                         << at.rounding << at.side();
          }};
}

ScalarFunction choice(const char* name, std::size_t tree) {
  return {name,
          {vector(), unit_number(), number(0, 1, {0, 0x1p-30, 1 - 0x1p-53}), number(-1, 3, {1})},
          [tree](const Context&, const double* in, double* out) {
            Results results{out};
            for (const int again : {0, 1}) {
              const auto chosen =
                  in[5] > 0 ? fixtures().trees[tree].choose(point_of(in), in[3 + again]) : std::nullopt;
              const LightTree::Chosen c = chosen.value_or(LightTree::Chosen{});
              results << chosen.has_value() << c.slot << c.probability << c.rest;
            }
          }};
}

}  // namespace

std::vector<ScalarFunction> stage_functions() {
  const Argument radiance = float_magnitude(-100, 100, {-1, -0.0, 0, 1});
  const double infinity = std::numeric_limits<double>::infinity();
  return {
      {"sigmoid",
       {float_number(-1e-3, 1e-3, {0, 1}), float_number(-0.5, 0.5, {0, -1e20}),
        float_number(-100, 100, {0, infinity, -infinity, 1e30, -1e30}), wavelength()},
       [](const Context&, const double* in, double* out) {
         SigmoidSpectrum s;
         s.c0 = static_cast<float>(in[0]), s.c1 = static_cast<float>(in[1]), s.c2 = static_cast<float>(in[2]);
         SampledWavelengths w;
         w.lambda_nm.fill(static_cast<float>(in[3]));
         Results{out} << static_cast<double>(evaluate(s, w)[0]);
       }},
      {"table_value",
       {wavelength(), word(2)},
       [](const Context&, const double* in, double* out) {
         SampledWavelengths w;
         w.lambda_nm.fill(static_cast<float>(in[0]));
         const TabulatedSpectrum d65{{cie_d65().begin(), cie_d65().end()}},
             own{fixtures().tables[static_cast<std::size_t>(in[1])]};
         Results{out} << static_cast<double>(evaluate(d65, w)[0]) << static_cast<double>(evaluate(own, w)[0]);
       }},
      {"flat_spectrum",
       {word(fixture_spectra), wavelength(), wavelength(), wavelength(), wavelength()},
       [](const Context&, const double* in, double* out) {
         SampledWavelengths w;
         for (std::size_t i = 0; i < hero_count; ++i) w.lambda_nm[i] = static_cast<float>(in[1 + i]);
         Results{out}
             << (evaluate(fixtures().spectra[static_cast<std::size_t>(in[0])], w) * fixture_factor).v;
       }},
      {"wavelengths",
       {unit_number(), word(2)},
       [](const Context&, const double* in, double* out) {
         const SampledWavelengths w = sample_wavelengths(static_cast<float>(in[0]));
         const SensorWeights sensor = sensor_weights(w, 1.5);
         Results{out} << w.lambda_nm << w.pdf << sensor.x << sensor.y << sensor.z;
       }},
      interaction("plain_interaction", 0),
      interaction("interaction_with_normals", 1),
      interaction("interaction_with_uv", 2),
      interaction("interaction_with_both", 3),
      choice("choose_of_few_lights", 0),
      choice("choose_of_many_lights", 1),
      choice("choose_by_power", 2),
      choice("choose_of_none", 3),
      choice("choose_of_two_lights", 4),
      {"draw_emitter",
       {word(fixture_emitters), position()},
       [](const Context&, const double* in, double* out) {
         const auto number = static_cast<std::uint32_t>(in[0]);
         const PointEmitter& emitter = fixtures().lights.emitters[number];
         const std::array<float, 4> u{};
         LastLamp last;
         LightSample s;
         const bool arrives = draw_emitter(
             {fixtures().lights, point_of(in + 1), u, {}, fixtures().some_wavelengths, last}, number, s);
         const SampledSpectrum part = intensity(emitter, -s.to_light, nullptr, fixtures().some_wavelengths);
         Results{out} << arrives << s.to_light << s.distance << static_cast<double>(part[0])
                      << static_cast<double>(s.radiance[0]);
       }},
      {"offset_origin",
       {position(), direction(), magnitude(-60, -20, {0}), direction()},
       [](const Context&, const double* in, double* out) {
         Results{out} << offset_origin(point_of(in), vector_of(in + 3), in[6], 1e-14, vector_of(in + 7));
       }},
      {"depart",
       {long_word(), position(), direction(), radiance, radiance, radiance, radiance},
       [](const Context&, const double* in, double* out) {
         const std::uint64_t seed = static_cast<std::uint64_t>(in[0]) | static_cast<std::uint64_t>(in[1])
                                                                            << 32;
         const Point3f origin = float_point_of(in + 2);
         const DirectionCode code = encode_direction(vector_of(in + 5));
         const std::uint64_t hash = hash_of_ray(seed, origin, code);
         std::array<float, 4> throughput;
         std::uint64_t random = RandomStream(hash + 0x1234567).bits();
         for (std::size_t i = 0; i < 4; ++i, random >>= 16)
           throughput[i] =
               rounded_by_chance(static_cast<float>(in[8 + i]), static_cast<std::uint32_t>(random));
         Results{out} << origin << decode_direction(code) << code << static_cast<double>(hash & 0xffffffff)
                      << static_cast<double>(hash >> 32) << throughput;
       }},
      {"aim",
       {position(), direction(), magnitude(-30, 30, {0, infinity}), direction(), magnitude(-30, 0, {0}),
        number(1 - 1e-6, 1 + 1e-6, {1})},
       [](const Context&, const double* in, double* out) {
         LightSample light;
         light.to_light = vector_of(in + 3), light.distance = in[6];
         light.normal = vector_of(in + 7), light.tilt_rad = in[10];
         const Point3d p = point_of(in);
         const Aimed aimed = aim({p, cast<float>(Point3d{p.x * in[11], p.y * in[11], p.z * in[11]})}, light);
         const float end =
             std::isinf(light.distance) ? std::numeric_limits<float>::max() : float_below(aimed.end);
         Results{out} << aimed.direction << aimed.rounded << aimed.end << aimed.cosine
                      << static_cast<double>(end);
       }},
      {"shadow_radiance",
       {radiance, radiance, radiance, radiance},
       [](const Context&, const double* in, double* out) {
         for (int i = 0; i < 4; ++i)
           out[i] = static_cast<double>(rounded_radiance(std::max(0.0f, static_cast<float>(in[i]))));
       }},
      {"draw_triangle",
       {lamp_and_point(), unit_number(), unit_number()},
       [](const Context&, const double* in, double* out) {
         const LightSampler& lights = fixtures().lights;
         const std::array<float, 4> u{static_cast<float>(in[4]), static_cast<float>(in[5]), 0, 0};
         const std::array<float, 2> far{};
         LastLamp last;
         LightSample s;
         const bool arrives = draw_triangle({lights, point_of(in + 1), u, far, SampledWavelengths{}, last},
                                            lights.slots[static_cast<std::size_t>(in[0])], 0, s);
         if (!arrives) s = {};
         Results{out} << arrives << s.to_light << s.normal << s.distance << s.tilt_rad << s.pdf;
       }},
  };
}

}  // namespace vitrail::lane_tests
