// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/pigment_patterns.h"

#include <algorithm>

#include "importers/povray/read/pattern_kinds.h"

namespace vitrail::pov {

namespace {

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

// Along a piece of the inner map whose greys are g0 … g1: where it has those of entries of the outer map.
void add_piece(std::vector<BlendEntry>& result, const std::vector<BlendEntry>& outer, const BlendEntry& from,
               const BlendEntry& to) {
  const double g0 = grey_of(from.color), g1 = grey_of(to.color);
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

}  // namespace

double grey_of(const Numbers& c) { return 0.297 * c.v[0] + 0.589 * c.v[1] + 0.114 * c.v[2]; }

std::optional<Pigment> colored_by_grey(const Pigment& inner, const std::vector<BlendEntry>& outer) {
  const auto has_pigment = [](const BlendEntry& e) { return e.pigment != nullptr; };
  if (outer.empty() || std::ranges::any_of(outer, has_pigment)) return std::nullopt;
  Pigment result = inner;
  if (inner.color) {
    result.color = color_at(outer, grey_of(*inner.color));
    return result;
  }
  const auto kind = pattern_kind(inner.pattern.kind);
  const std::vector<BlendEntry> entries =
      inner.map ? inner.map->entries : default_entries(inner.pattern.kind);
  if (!kind || entries.empty() || std::ranges::any_of(entries, has_pigment)) return std::nullopt;
  BlendMap map;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    BlendEntry entry = entries[i];
    entry.color = color_at(outer, grey_of(entry.color));
    map.entries.push_back(std::move(entry));
    if (!is_of_places(*kind) && i + 1 < entries.size())
      add_piece(map.entries, outer, entries[i], entries[i + 1]);
  }
  result.map = std::make_shared<BlendMap>(std::move(map));
  return result;
}

}  // namespace vitrail::pov
