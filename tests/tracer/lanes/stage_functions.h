// SPDX-License-Identifier: Apache-2.0
// Functions in lanes that read tables and geometry.
#pragma once

#include "tests/tracer/lanes/context.h"
#include "tests/tracer/lanes/lane_table.h"
#include "tracer/lanes/lamps.h"
#include "tracer/lanes/light_tree.h"
#include "tracer/lanes/rays.h"
#include "tracer/lanes/spectra.h"
#include "tracer/lights/point_emitter_lanes.h"

namespace vitrail::lane_tests {
namespace {

LANE_FUNCTION(sigmoid, 4, 1) { out.number(lanes::sigmoid(in.d(0), in.d(1), in.d(2), in.f(3))); }
LANE_FUNCTION(table_value, 2, 2) {
  out.number(lanes::table_value(context.d65, in.f(0)));
  out.number(lanes::table_value_of_each(
      [&](int j) { return context.tables[static_cast<int>(lanes::lane(in.d(1), j))]; }, in.f(0)));
}
// The spectrum of that number at four wavelengths.
LANE_FUNCTION(flat_spectrum, 5, 4) {
  out.four(lanes::flat_values<lanes::Doubles<W>>(
      [&](int j) -> const FlatSpectrum& {
        return context.flat_spectra[static_cast<int>(lanes::lane(in.d(0), j))];
      },
      [&](int i) { return in.f(1 + i); }));
}
LANE_FUNCTION(wavelengths, 2, 20) {
  const auto w = lanes::sample_wavelengths(context.wavelengths, in.f(0));
  out.four(w.lambda_nm), out.four(w.pdf);
  const auto sensor = lanes::sensor_weights(context.observer, w, lanes::fill<lanes::Doubles<W>>(1.5));
  out.four(sensor.x), out.four(sensor.y), out.four(sensor.z);
}
// Of triangle 8·in[0] + in[1] of a domain, met at (u, v) and t.
template <int domain, int W>
VITRAIL_LANES void put_interaction(const Context& context, const In<W>& in, Out<W>& out) {
  Hit hits[W];
  for (int j = 0; j < W; ++j) {
    const auto number = [&](int k) { return in.numbers[j * in.stride + k]; };
    hits[j].cluster = static_cast<std::uint32_t>(number(0)),
    hits[j].lane = static_cast<std::uint32_t>(number(1));
    hits[j].u = number(2), hits[j].v = number(3), hits[j].t = number(4);
  }
  using D = lanes::Doubles<W>;
  const auto at = lanes::triangle_interaction<D>(
      [&](int) -> const lanes::DomainTables& { return context.domain[domain]; },
      [&](int j) -> const Hit& { return hits[j]; }, lanes::to_floats(in.vector(5)));
  out.vector(at.p), out.vector(at.out), out.vector(at.geometric), out.vector(at.shading), out.vector(at.dpdu);
  out.number(at.u), out.number(at.v), out.number(at.rounding), out.number(at.side());
}
LANE_FUNCTION(plain_interaction, 8, 19) { put_interaction<0>(context, in, out); }
LANE_FUNCTION(interaction_with_normals, 8, 19) { put_interaction<1>(context, in, out); }
LANE_FUNCTION(interaction_with_uv, 8, 19) { put_interaction<2>(context, in, out); }
LANE_FUNCTION(interaction_with_both, 8, 19) { put_interaction<3>(context, in, out); }
// The emitter of that number, and a point.
LANE_FUNCTION(draw_emitter, 4, 7) {
  using D = lanes::Doubles<W>;
  const auto s = lanes::draw_emitter<D>(in.vector(1), [&](int j) -> const PointEmitter& {
    return context.emitters[static_cast<int>(lanes::lane(in.d(0), j))];
  });
  out.mask(s.arrives), out.vector(s.to_light), out.number(s.distance), out.number(s.part * 0.3f);
  out.number(s.part * 0.3f * s.weakening);
}
LANE_FUNCTION(offset_origin, 10, 3) {
  out.vector(lanes::offset_origin(in.vector(0), in.vector(3), in.d(6), 1e-14, in.vector(7)));
}
LANE_FUNCTION(depart, 12, 14) {
  using D = lanes::Doubles<W>;
  const lanes::Four<lanes::Floats<W>> throughput{{in.f(8), in.f(9), in.f(10), in.f(11)}};
  const auto ray = lanes::depart<D>(in.l(0), lanes::fill<lanes::Longs<W>>(0x1234567),
                                    lanes::to_floats(in.vector(2)), in.vector(5), throughput);
  out.vector(ray.origin), out.vector(ray.direction), out.number(ray.code.first), out.number(ray.code.second);
  out.word64(ray.random), out.four(ray.throughput);
}
// With a second number for the same points.
template <int W>
VITRAIL_LANES void put_chosen(const LightTree& tree, const In<W>& in, Out<W>& out) {
  using D = lanes::Doubles<W>;
  LightWeights root[W];
  for (int again = 0; again < 2; ++again) {
    lanes::ChosenLights<W> chosen;
    lanes::choose_lights<D>(tree, in.vector(0), in.d(3 + again), in.d(5) > 0, root, again > 0, chosen);
    const auto put = [&](const auto& get) { out.number(lanes::gather<D>(get)); };
    put([&](int j) { return chosen.any[j] ? 1 : 0; });
    put([&](int j) { return chosen.any[j] ? chosen.slot[j] : 0; });
    put([&](int j) { return chosen.any[j] ? chosen.probability[j] : 0; });
    put([&](int j) { return chosen.any[j] ? chosen.rest[j] : 0; });
  }
}
LANE_FUNCTION(choose_of_few_lights, 6, 8) { put_chosen(*context.trees[0], in, out); }
LANE_FUNCTION(choose_of_many_lights, 6, 8) { put_chosen(*context.trees[1], in, out); }
LANE_FUNCTION(choose_by_power, 6, 8) { put_chosen(*context.trees[2], in, out); }
LANE_FUNCTION(choose_of_none, 6, 8) { put_chosen(*context.trees[3], in, out); }
LANE_FUNCTION(choose_of_two_lights, 6, 8) { put_chosen(*context.trees[4], in, out); }
// From in[0…3) to a light in direction in[3…6) at distance in[6], with normal in[7…10), tilt in[10].
LANE_FUNCTION(aim, 12, 8) {
  using D = lanes::Doubles<W>;
  const auto p = in.vector(0);
  const auto aimed =
      lanes::aim<D>(p, lanes::to_floats(p * in.d(11)), {in.vector(3), in.d(6), in.vector(7), in.d(10)});
  out.number(aimed.code.first), out.number(aimed.code.second), out.vector(aimed.direction);
  out.number(aimed.end), out.number(aimed.cosine), out.number(lanes::shadow_end<D>(aimed.end));
}
LANE_FUNCTION(shadow_radiance, 4, 4) {
  out.four(lanes::shadow_radiance<lanes::Floats<W>>({{in.f(0), in.f(1), in.f(2), in.f(3)}}));
}
LANE_FUNCTION(draw_triangle, 6, 10) {
  using D = lanes::Doubles<W>;
  const auto which = [&](int j) { return static_cast<int>(in.numbers[j * in.stride]); };
  const auto s = lanes::draw_triangle<D>(
      in.vector(1), in.f(4), in.f(5),
      [&](int j) -> const LightSampler::Slot& { return context.slots[which(j)]; },
      [&](int j) -> const LightSampler::Face& { return context.faces[which(j)]; },
      [&](int j) { return context.two_sided[which(j)]; });
  const auto kept = [&](D x) { return lanes::select<D>(s.arrives, x, lanes::fill<D>(0)); };
  out.mask(s.arrives);
  out.number(kept(s.to_light.x)), out.number(kept(s.to_light.y)), out.number(kept(s.to_light.z));
  out.number(kept(s.normal.x)), out.number(kept(s.normal.y)), out.number(kept(s.normal.z));
  out.number(kept(s.distance)), out.number(kept(s.tilt_rad)), out.number(kept(s.pdf));
}

}  // namespace
}  // namespace vitrail::lane_tests
