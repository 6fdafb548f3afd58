// SPDX-License-Identifier: Apache-2.0
// A meridian is turned about the y axis.
#pragma once

#include <span>
#include <vector>

#include "importers/solids/solid.h"

namespace vitrail::solids {

// It is a chord of a meridian in (radius, y), radius ≥ 0, with the normals of the surface at its ends.
struct MeridianChord {
  Point2d from, to;
  Point2d normal_from, normal_to;
  std::uint32_t surface = 0;
};

// Appends chords of an arc about `center`, counter-clockwise from `begin_rad` to `end_rad`, at most
// `tolerance` from it.
void append_arc(std::vector<MeridianChord>& chords, Point2d center, double radius, double begin_rad,
                double end_rad, double tolerance);
// Appends a straight line with its normal on the right.
void append_line(std::vector<MeridianChord>& chords, Point2d from, Point2d to, std::uint32_t surface = 0);

// Returns the number of chords of a whole circle, at least 12 and a multiple of 4.
int circle_chords(double radius, double tolerance);

// Chords follow each other with what is inside on their left. The solid is closed if they begin and end on
// the axis, or where they began.
Solid revolve(std::span<const MeridianChord> chords, int segments);

}  // namespace vitrail::solids
