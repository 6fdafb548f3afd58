// SPDX-License-Identifier: Apache-2.0
// Properties that are neither position, normal nor texture coordinate become attributes of the mesh.
#pragma once

#include <string>
#include <vector>

#include "importers/ply/read/ply_body.h"

namespace vitrail::ply {

// It has one or three properties of one element.
struct AttributePlan {
  std::string name;  // of the attribute: "vertex_color"
  bool per_face = false;
  std::size_t element = 0;
  std::vector<std::size_t> properties;
};

// Returns attributes named as Mitsuba names them: NAME_0 NAME_1 NAME_2, or counted from 1, or with _x _y _z,
// become NAME; with _r _g _b they become NAME_color; r g b and red green blue become color. "vertex_" or
// "face_" goes before. A face's number face_indices keeps its name.
std::vector<AttributePlan> plan_attributes(const Header& header, const BodyPlan& plan);

// Reads values as they are in the file, of whatever type, once more through the body. Faces that became
// several triangles give each of them their values, those that became patches give them to these.
void read_attributes(const InputBytes& bytes, const TextCursor& cursor, const Header& header,
                     const BodyPlan& plan, const std::vector<AttributePlan>& attributes, Body& body);

}  // namespace vitrail::ply
