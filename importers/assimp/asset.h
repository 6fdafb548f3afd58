// SPDX-License-Identifier: Apache-2.0
// An Asset is what assimp knows of a file, as plain values. assimp is in a module of its own, so that the
// programs start without it.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scene/geometry/transform.h"
#include "scene/geometry/vec.h"

namespace vitrail::assimp {

// It has the triangles of one material. Normals and uvs are empty or have one entry a position.
struct AssetMesh {
  std::string name;
  std::size_t material = 0;
  std::vector<Point3f> positions;
  std::vector<Normal3f> normals;
  std::vector<Point2f> uvs;  // v runs up
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

// It is an image of a material.
struct AssetImage {
  std::string name;        // as the file has it
  bool is_inside = false;  // in the file itself
  std::string bytes;       // of a PNG, JPEG … in the file; "" where the file has bare pixels
  bool clamps = false, mirrors = false;
};

// It has a classic model of shading. Colours are as the file has them.
struct AssetMaterial {
  std::string name;
  bool is_shiny = false;  // its model has highlights
  std::optional<std::array<double, 3>> diffuse, specular, emission;
  std::optional<double> opacity, shininess, index;
  std::optional<AssetImage> diffuse_image, specular_image, emission_image, opacity_image, height_image,
      normal_image;
};

// Parents stand before their children; the first node has none.
struct AssetNode {
  std::string name;
  std::size_t parent = 0;
  Transform to_parent;
  std::vector<std::size_t> meshes;
};

struct AssetLight {
  enum class Kind : std::uint8_t { point, spot, directional, other };
  Kind kind = Kind::point;
  std::size_t node = 0;
  Point3d position;    // in its node's space, as the direction
  Vector3d direction;  // where the light goes; not of points
  std::array<double, 3> color{};
  double constant = 1, linear = 0,
         quadratic = 0;                 // what the colour is divided by at distance d: c + l·d + q·d²
  double inner_deg = 0, outer_deg = 0;  // of a spot: from its axis
};

struct AssetCamera {
  std::size_t node = 0;
  Point3d position;  // in its node's space
  Vector3d direction, up;
  double horizontal_fov_deg = 0, vertical_fov_deg = 0, aspect = 0;  // 0: not given
  double half_width = 0, half_height = 0;                           // of an orthographic one; 0: it is none
};

struct Asset {
  std::vector<AssetMesh> meshes;
  std::vector<AssetMaterial> materials;
  std::vector<AssetNode> nodes;
  std::vector<AssetLight> lights;
  std::vector<AssetCamera> cameras;
  // Blender's units hold where it is set: a lamp's colour is in watts, a sun's in W/m². So many of the file's
  // units are a metre.
  std::optional<double> units_of_blender;
  std::size_t animations = 0, bones = 0, points_and_lines = 0, colored_meshes = 0;
};

// Reads a file into `asset`. Returns what went wrong, or nothing.
using ReadAsset = std::string (*)(const std::string& file, Asset& asset);

inline constexpr const char* asset_module = "vitrail-assimp.so";
inline constexpr const char* asset_symbol = "vitrail_read_asset";

}  // namespace vitrail::assimp
