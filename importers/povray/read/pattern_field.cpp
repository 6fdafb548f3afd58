// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/pattern_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "importers/povray/read/formula.h"
#include "importers/povray/read/function.h"
#include "importers/povray/read/object_hits.h"
#include "importers/povray/read/pattern_kinds.h"
#include "importers/povray/read/pattern_warps.h"
#include "importers/povray/read/pigment_patterns.h"
#include "importers/povray/read/reader.h"
#include "scene/models/pattern.h"
#include "scene/models/pattern_shapes.h"

namespace vitrail::pov {

namespace {

// What a pattern without a record of its own gives is between 0 and 1: `planar` takes it there unchanged, to
// what frequency, phase and wave make of it.
PatternTexture carrier(PatternTexture record) {
  record.kind = PatternTexture::Kind::planar;
  return record;
}

bool has_values(Word kind) {
  return kind == Word::function_ || kind == Word::image_pattern_ || kind == Word::object_ ||
         kind == Word::pigment_pattern_ || kind == Word::density_file_ || kind == Word::average_ ||
         kind == Word::none;
}

}  // namespace

PatternField::PatternField(Reader& reader, const Pigment& pigment) : pattern_(pigment.pattern) {
  const SourceLocation place = reader.location(pigment.place);
  if (is_invertible(pigment.to_object)) from_object_ = inverse(pigment.to_object);
  plain_ = pigment.color.has_value() || pattern_.kind == Word::none;
  if (plain_) {
    color_ = pigment.color.value_or(mean_color(pigment));
    return;
  }
  if (pattern_.image) {
    if (pattern_.image->filename.empty()) {
      plain_ = true, color_ = Finish::grey(0.5);
      return;
    }
    image_ = std::make_shared<ImageValues>(reader, *pattern_.image, pigment.place);
  }
  if (pattern_.kind == Word::density_file_) {
    density_ = std::make_shared<DensityValues>(pattern_.density_file, pattern_.interpolate > 0);
    if (pattern_.interpolate > 1) reader.notes.approximated("interpolate 2 of a density_file: linear", place);
  }
  if (pattern_.pigment) inner_ = std::make_shared<PatternField>(reader, *pattern_.pigment);
  record_ = record_of(pattern_);
  recorded_ = has_kind(pattern_);
  if (const Word kind = pattern_.kind; !recorded_ && !has_values(kind) && kind != Word::slope_ &&
                                       kind != Word::image_map_ && places_of_list(kind) == 0)
    if (auto formula = pattern_record(pattern_)) record_ = std::move(*formula), recorded_ = true;
  if (!recorded_ && !has_values(pattern_.kind) && pattern_.kind != Word::image_map_)
    reader.notes.approximated(fmt::format("this pattern ({}) in a formula: ½", name_of(pattern_.kind)),
                              place);
  for (const BlendEntry& given : pigment.map ? pigment.map->entries : default_entries(pattern_)) {
    Entry entry{given.at, given.color, nullptr};
    if (given.pigment) entry.pigment = std::make_shared<PatternField>(reader, *given.pigment);
    entries_.push_back(std::move(entry));
  }
}

Point3d PatternField::moved(Point3d p) const {
  p = transform_point(from_object_, p);
  for (auto warp = pattern_.warps.rbegin(); warp != pattern_.warps.rend(); ++warp) p = warped(*warp, p);
  return p;
}

// At a point that warps have moved.
double PatternField::own_value(Point3d p) const {
  if (recorded_) {
    const double value = pattern_value(record_, p);
    return is_of_places(record_.kind) ? value * static_cast<double>(places_of(record_.kind) - 1) : value;
  }
  p = turbulent(pattern_, p);
  double value = 0.5;
  if (pattern_.kind == Word::object_) return pattern_.object && is_inside(*pattern_.object, p) ? 1 : 0;
  if (pattern_.kind == Word::function_ && pattern_.function) {
    const double at[3] = {p.x, p.y, p.z};
    value = evaluate(*pattern_.function, at);
  } else if (image_) {
    value = image_->grey(p);
  } else if (density_) {
    value = density_->at(p);
  } else if (inner_) {
    value = grey_of(inner_->color(p));
  }
  if (!(value >= 0 && value <= 1)) value = std::isfinite(value) ? value - std::floor(value) : 0;
  return pattern_value(carrier(record_), {0, 1 - value, 0});
}

double PatternField::value(Point3d p) const { return plain_ ? grey_of(color_) : own_value(moved(p)); }

// By weights, which stand in the places of a map.
Numbers PatternField::average(Point3d p) const {
  Numbers sum = Finish::grey(0);
  double weights = 0;
  for (const Entry& entry : entries_) {
    const Numbers c = entry.at_point(p);
    for (std::size_t i = 0; i < 5; ++i) sum.v[i] += entry.at * c.v[i];
    weights += entry.at;
  }
  for (double& v : sum.v) v = weights > 0 ? v / weights : 0;
  return sum;
}

Numbers PatternField::blended(Point3d p) const {
  if (pattern_.kind == Word::average_) return average(p);
  const double x = own_value(p);
  const std::size_t last = entries_.size() - 1;
  if (pattern_.kind == Word::object_ || (recorded_ && is_of_places(record_.kind)))
    return entries_[std::min(static_cast<std::size_t>(x), last)].at_point(p);
  std::size_t above = 0;
  while (above <= last && x >= entries_[above].at) ++above;
  if (above == 0) return entries_.front().at_point(p);
  if (above > last) return entries_.back().at_point(p);
  const Entry &low = entries_[above - 1], &high = entries_[above];
  const double share = (x - low.at) / (high.at - low.at);
  const Numbers from = low.at_point(p), to = high.at_point(p);
  Numbers result = Finish::grey(0);
  for (std::size_t i = 0; i < 5; ++i) result.v[i] = (1 - share) * from.v[i] + share * to.v[i];
  return result;
}

// By Fibonacci's spiral, which spreads points evenly.
Numbers PatternField::mean() const {
  constexpr int points = 4096;
  Numbers sum = color({0, 0, 1});
  for (double& v : sum.v) v = 0;
  for (int i = 0; i < points; ++i) {
    const double z = 1 - (2 * i + 1.0) / points, r = std::sqrt(1 - z * z);
    const double angle = i * std::numbers::pi * (3 - std::sqrt(5.0));
    const Numbers here = color({r * std::cos(angle), r * std::sin(angle), z});
    for (std::size_t k = 0; k < 5; ++k) sum.v[k] += here.v[k] / points;
  }
  return sum;
}

Numbers PatternField::color(Point3d p) const {
  Numbers result = color_;
  if (!plain_) {
    const Point3d q = moved(p);
    result = image_ && pattern_.kind == Word::image_map_ ? image_->color(turbulent(pattern_, q))
             : entries_.empty()                          ? Finish::grey(own_value(q))
                                                         : blended(q);
  }
  result.terms = 5, result.is_color = true;
  return result;
}

}  // namespace vitrail::pov
