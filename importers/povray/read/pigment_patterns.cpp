// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/pigment_patterns.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "importers/povray/read/function.h"
#include "importers/povray/read/pattern_kinds.h"

namespace vitrail::pov {

namespace {

using NumberOfColor = std::function<double(const Numbers&)>;

Numbers color_at(const std::vector<BlendEntry>& map, double x) {
  const auto above = std::ranges::find_if(map, [&](const BlendEntry& e) { return x < e.at; });
  if (above == map.begin()) return map.front().color;
  if (above == map.end()) return map.back().color;
  const BlendEntry& low = *(above - 1);
  const double share = (x - low.at) / (above->at - low.at);
  Numbers color = Finish::grey(0);
  for (std::size_t i = 0; i < 5; ++i) color.v[i] = (1 - share) * low.color.v[i] + share * above->color.v[i];
  return color;
}

// A place of the inner map, and the number of the outer one there.
struct Crossing {
  double at = 0, number = 0;
};

// Along a piece of the inner map: where it has the numbers of entries of the outer map.
void add_piece(std::vector<BlendEntry>& result, const std::vector<BlendEntry>& outer, const Crossing& from,
               const Crossing& to) {
  const double g0 = from.number, g1 = to.number;
  const auto add = [&](const BlendEntry& entry) {
    if (g0 == g1 || entry.at < std::min(g0, g1) || entry.at > std::max(g0, g1)) return;
    BlendEntry crossed = entry;
    crossed.at = from.at + (entry.at - g0) / (g1 - g0) * (to.at - from.at);
    result.push_back(std::move(crossed));
  };
  if (g0 < g1)
    for (const BlendEntry& entry : outer) add(entry);
  else
    for (auto entry = outer.rbegin(); entry != outer.rend(); ++entry) add(*entry);
}

std::vector<Crossing> crossings(const std::vector<BlendEntry>& inner, const NumberOfColor& number,
                                int pieces) {
  std::vector<Crossing> result;
  for (std::size_t i = 0; i < inner.size(); ++i) {
    result.push_back({inner[i].at, number(inner[i].color)});
    for (int k = 1; k < pieces && i + 1 < inner.size(); ++k) {
      const double share = static_cast<double>(k) / pieces;
      Numbers color = inner[i].color;
      for (std::size_t c = 0; c < 5; ++c) color.v[c] += share * (inner[i + 1].color.v[c] - color.v[c]);
      result.push_back({inner[i].at + share * (inner[i + 1].at - inner[i].at), number(color)});
    }
  }
  return result;
}

std::optional<Pigment> colored_by(const Pigment& inner, const std::vector<BlendEntry>& outer,
                                  const NumberOfColor& number, int pieces) {
  const auto has_pigment = [](const BlendEntry& e) { return e.pigment != nullptr; };
  if (outer.empty() || std::ranges::any_of(outer, has_pigment)) return std::nullopt;
  Pigment result = inner;
  if (inner.color) {
    result.color = color_at(outer, number(*inner.color));
    return result;
  }
  const auto kind = pattern_kind(inner.pattern.kind);
  const std::vector<BlendEntry> entries = inner.map ? inner.map->entries : default_entries(inner.pattern);
  if (!kind || entries.empty() || std::ranges::any_of(entries, has_pigment)) return std::nullopt;
  constexpr std::size_t most_crossings = 1 << 20;
  if (outer.size() > most_crossings / (entries.size() * static_cast<std::size_t>(pieces)))
    return std::nullopt;
  const bool list = is_of_places(*kind);
  const std::vector<Crossing> places = crossings(entries, number, list ? 1 : pieces);
  BlendMap map;
  for (std::size_t i = 0; i < places.size(); ++i) {
    BlendEntry entry;
    entry.at = places[i].at;
    entry.color = color_at(outer, places[i].number);
    map.entries.push_back(std::move(entry));
    if (!list && i + 1 < places.size()) add_piece(map.entries, outer, places[i], places[i + 1]);
  }
  result.map = std::make_shared<BlendMap>(std::move(map));
  return result;
}

}  // namespace

double grey_of(const Numbers& c) { return 0.297 * c.v[0] + 0.589 * c.v[1] + 0.114 * c.v[2]; }

std::optional<Pigment> as_pattern_of_pigment(const Pattern& pattern, const std::vector<BlendEntry>& map) {
  constexpr int pieces = 8;  // of a formula between two entries
  if (pattern.kind == Word::pigment_pattern_ && pattern.pigment)
    return colored_by(*pattern.pigment, map, grey_of, 1);
  if (pattern.kind != Word::function_ || !pattern.function) return std::nullopt;
  const auto formula = formula_of_color(*pattern.function);
  if (!formula) return std::nullopt;
  const auto number = [&](const Numbers& color) {
    const double argument = component_of(color, formula->component);
    const double value = evaluate(formula->function, &argument);
    if (value >= 0 && value <= 1) return value;
    return std::isfinite(value) ? value - std::floor(value) : 0.0;
  };
  return colored_by(*formula->pigment, map, number, pieces);
}

}  // namespace vitrail::pov
