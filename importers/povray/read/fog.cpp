// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/fog.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "importers/povray/read/reader.h"

namespace vitrail::pov {

namespace {

// Whether a part of fog was read.
bool read_fog_part(Reader& reader, Fog& fog, Word word) {
  switch (word) {
    case Word::fog_type_:
      fog.ground = reader.integer("fog_type") == 2;
      return true;
    case Word::distance_:
      fog.distance = std::abs(reader.number("distance"));
      return true;
    case Word::fog_offset_:
      fog.offset = reader.number("fog_offset");
      return true;
    case Word::fog_alt_:
      fog.alt = std::abs(reader.number("fog_alt"));
      return true;
    case Word::up_:
      fog.up = reader.vector("up");
      return true;
    case Word::turbulence_:
      fog.turbulent = length(reader.vector("turbulence")) > 0;
      return true;
    case Word::turb_depth_:
      fog.turb_depth = reader.number("turb_depth");
      return true;
    case Word::octaves_:
      fog.octaves = reader.integer("octaves");
      return true;
    case Word::omega_:
      fog.omega = reader.number("omega");
      return true;
    case Word::lambda_:
      reader.number("a part of turbulence");
      return true;
    default:
      return false;
  }
}

}  // namespace

Shared<Fog> read_fog_block(Reader& reader) {
  if (const auto named = reader.identifier<Shared<Fog>>()) return *named;
  reader.expect('{', "behind fog");
  Fog fog;
  fog.place = reader.here();
  for (;;) {
    reader.comma();
    if (const auto named = reader.identifier<Shared<Fog>>()) {
      fog = **named;
      continue;
    }
    Transform step;
    if (read_transform(reader, step)) {
      fog.up = transform_vector(step, fog.up);
      continue;
    }
    if (reader.accept('}')) break;
    const Token token = reader.next();
    if (token.kind == TokenKind::word && read_fog_part(reader, fog, token.symbol->word)) continue;
    reader.put_back(token);
    if (!reader.number_follows()) reader.unexpected(reader.next(), "a part of fog");
    fog.color = reader.color();
  }
  if (!(length(fog.up) > 0)) reader.fail("the up of a fog is 0", fog.place);
  fog.up = normalize(fog.up);
  return std::make_shared<Fog>(fog);
}

double turbulent_share(const Fog& fog) {
  if (!fog.turbulent) return 1;
  double sum = 0, weight = 0.5;
  for (int i = 0; i < std::clamp(fog.octaves, 1, 10); ++i, weight *= fog.omega) sum += weight;
  constexpr double mean_transmittance = 0.4;  // e⁻ˣ where fog is seen neither as nothing nor as a wall
  return 1 - mean_transmittance * std::clamp(fog.turb_depth * sum, 0.0, 1.0);
}

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// ∫ of the density from the offset to a height: that height below it, alt·atan u above it.
double column(const Fog& fog, double height) {
  const double above = height - fog.offset;
  if (!fog.ground || above <= 0) return above;
  return fog.alt > 0 ? fog.alt * std::atan(above / fog.alt) : 0;
}

// The height up to which it is so much; ∞ where it never is.
double height_of_column(const Fog& fog, double sum) {
  if (!fog.ground || sum <= 0) return fog.offset + sum;
  const double angle = fog.alt > 0 ? sum / fog.alt : infinity;
  return angle < std::numbers::pi / 2 ? fog.offset + fog.alt * std::tan(angle) : infinity;
}

// The length of densest fog that weakens as much as it may.
double deepest(const Fog& fog) {
  const double t = fog.color.v[4];
  return t > 0 ? -std::log(t) * fog.distance / turbulent_share(fog) : infinity;
}

}  // namespace

double mean_density(const Fog& fog, double low, double high) {
  if (!fog.ground || !std::isfinite(low)) return 1;
  return (column(fog, high) - column(fog, low)) / (high - low);
}

std::array<double, 3> filter_of(const Fog& fog) {
  const double f = fog.color.v[3];
  const auto passed = [&](std::size_t i) { return std::max(1 - f + f * fog.color.v[i], 0.0); };
  return {passed(0), passed(1), passed(2)};
}

FogEdge edge_of(const Fog& fog, double eye_height) {
  const double depth = deepest(fog), here = column(fog, eye_height);
  return {height_of_column(fog, here - depth), height_of_column(fog, here + depth), fog, eye_height};
}

double FogEdge::radius(double height) const {
  const double rise = height - eye, here = column(fog, eye);
  const double nearby = 1e-6 * (std::abs(eye) + fog.alt + 1e-3);
  const double density = std::abs(rise) > nearby ? (column(fog, height) - here) / rise
                                                 : (column(fog, eye + nearby) - here) / nearby;
  const double far = deepest(fog) / density;  // ∞ where there is no fog
  return far > std::abs(rise) ? std::sqrt(far * far - rise * rise) : 0;
}

}  // namespace vitrail::pov
