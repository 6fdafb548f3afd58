// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "importers/images/converted_images.h"
#include "importers/writing/conversion_notes.h"
#include "importers/writing/exposed_lights.h"
#include "scene/records/material_traits.h"
#include "scene/records/nesting_limits.h"
#include "scene/records/scene.h"
#include "scene/spectra/color.h"

namespace vitrail::povray {

// POV-Ray's tolerances are lengths (1e-4 and 1e-3) and its meshes hold floats. A scene that is very small,
// very large or far from the origin is written in other units: p' = scale · (p − center).
struct Units {
  Transform to_pov;
  double scale = 1;
  double radius = 1;  // of a sphere around the scene and its camera, in the units of the file
  Point3d center;     // its centre, likewise
  bool is_identity() const { return to_pov == Transform{}; }
};

// It holds what the parts of the writer share.
struct Context : ConversionNotes {
  ExposedLights exposed;
  std::filesystem::path directory;  // of the scene file
  Units units;
  bool has_delta_lights = false;
  ConvertedImages images;
  std::vector<Nesting> nesting = nesting_of(scene.textures);
  std::vector<MaterialTraits> traits = traits_of(scene.materials);
  std::map<std::uint32_t, std::string> interiors = {};  // of materials that others are made of
  std::map<std::uint32_t, std::string> media = {};      // as they were written
  bool has_scattering = false;                          // of a medium
  bool has_facets = false;                              // of rough materials
  std::set<std::uint32_t> sheets = {};                  // materials that only rectangles have
  bool has_caustics = false;                            // of lamps with an extent, by photons
  std::string functions = {};                           // of images, which their pigments call
  int image_functions = 0;
};

inline std::string vector(Vector3d v) { return fmt::format("<{},{},{}>", v.x, v.y, v.z); }
inline std::string vector(Point3d p) { return fmt::format("<{},{},{}>", p.x, p.y, p.z); }
// Colours are floats in POV-Ray.
inline std::string color(RGB c) {
  return fmt::format("rgb <{},{},{}>", static_cast<float>(c.r), static_cast<float>(c.g),
                     static_cast<float>(c.b));
}

inline RGB operator*(RGB c, double s) { return {c.r * s, c.g * s, c.b * s}; }
inline RGB operator*(RGB a, RGB b) { return {a.r * b.r, a.g * b.g, a.b * b.b}; }
inline double largest(RGB c) { return std::max({c.r, c.g, c.b}); }
inline double mean(RGB c) { return (c.r + c.g + c.b) / 3; }

// Returns POV-Ray's matrix of the affine part of t.
inline std::string matrix(const Transform& t) {
  std::string text = "matrix <";
  for (std::size_t column = 0; column < 4; ++column)
    text += fmt::format("{}{},{},{}", column ? ", " : "", t.m[0][column], t.m[1][column], t.m[2][column]);
  return text + ">";
}

// Returns a file's name as a string of POV-Ray's language.
inline std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    result += c;
  }
  return result + '"';
}

}  // namespace vitrail::povray
