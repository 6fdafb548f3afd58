// SPDX-License-Identifier: Apache-2.0
// Constructive solid geometry (Requicha 1980) makes sets of points from others.
//
//   Csg bored = difference({solid(box({0, 0, 0}, {1, 1, 1}), 0), half_space({{0, 1, 0}, 0.5}, 1)});
//   CsgResult result = evaluate(bored, {.reach = 100});
//   for (std::uint32_t surface : surfaces_of(result.solid)) … mesh_of(result.solid, surface)
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "importers/solids/solid.h"

namespace vitrail::solids {

// It is the set where dot(normal, p) ≤ distance · |normal|: POV-Ray's plane {normal, distance} and its
// inside.
struct HalfSpace {
  Vector3d normal;
  double distance = 0;
};

// It is a set that no closed mesh encloses. It gives at least its part in the box that is asked for, closed
// by `unseen` triangles that are not in its faces.
using Unbounded = std::function<Solid(const Bounds3d& within)>;

// It is a tree of sets. What it holds depends on the kind; build it by the functions below.
struct Csg {
  enum class Kind {
    solid,         // closed, of bodies that may overlap; inside is what any of them holds
    unbounded,     //
    unite,         // its bodies stay apart where nothing is cut from them: inner surfaces remain
    merge,         // without inner surfaces
    intersect,     //
    complement,    // of its only operand
    cut_surfaces,  // the surface of the first operand inside all others, left open there (clipped_by)
  };
  Kind kind = Kind::unite;
  Solid solid;
  Unbounded within;
  std::vector<Csg> operands;
  std::optional<Bounds3d>
      bounds;  // a box that holds the set: sets without end in it are looked at there alone
};

// These functions make sets; `surface` is the number that the triangles get, wherever they end up.
Csg solid(Solid solid, std::uint32_t surface);
Csg unbounded(Unbounded within, std::uint32_t surface);
Csg half_space(const HalfSpace& half_space, std::uint32_t surface);
Csg unite(std::vector<Csg> operands);
Csg merge(std::vector<Csg> operands);
Csg intersection(std::vector<Csg> operands);
// Returns the first set without all others.
Csg difference(std::vector<Csg> operands);
Csg complement(Csg operand);
// `object` may be open: a patch, a disc. The others are closed or unbounded, or made of such.
Csg cut_surfaces(Csg object, std::vector<Csg> by);

Csg transformed(Csg csg, const Transform& to);
// Gives a number to all surfaces that are seen.
void set_surface(Csg& csg, std::uint32_t surface);

struct CsgOptions {
  double reach = 1e4;  // half the side of the cube about the origin that stands for infinity
};

struct CsgResult {
  Solid solid;  // `closed` says whether it is; empty where nothing is left
  // Each is an operation that could not be carried out, with the reason. What was to be cut off then remains,
  // what was to be merged stays a body of its own.
  std::vector<std::string> refused;
  // Operands were moved by at most this fraction of their size, because without that their result touches
  // itself along an edge or at a vertex. It is 0 where none was moved.
  double perturbation = 0;
  bool reaches_infinity = false;  // where the cube was met; those sides are `unseen`
};

// Decisions are exact (CGAL's corefinement); places of cuts are rounded to double precision.
CsgResult evaluate(const Csg& csg, const CsgOptions& options = {});

}  // namespace vitrail::solids
