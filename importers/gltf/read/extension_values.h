// SPDX-License-Identifier: Apache-2.0
// These functions read members of an extension's object, with their defaults.
#pragma once

#include <optional>
#include <string>

#include "importers/gltf/tinygltf.h"
#include "scene/spectra/color.h"

namespace vitrail::gltf {

// Returns the extension of that name, or nullptr.
inline const tinygltf::Value* extension(const tinygltf::ExtensionMap& all, const char* name) {
  const auto found = all.find(name);
  return found == all.end() || !found->second.IsObject() ? nullptr : &found->second;
}

inline double number(const tinygltf::Value& object, const char* name, double otherwise) {
  if (!object.Has(name)) return otherwise;
  const tinygltf::Value& value = object.Get(name);
  return value.IsNumber() ? value.GetNumberAsDouble() : otherwise;
}

inline RGB color(const tinygltf::Value& object, const char* name, RGB otherwise) {
  if (!object.Has(name)) return otherwise;
  const tinygltf::Value& list = object.Get(name);
  if (!list.IsArray() || list.ArrayLen() != 3) return otherwise;
  for (int i = 0; i < 3; ++i)
    if (!list.Get(i).IsNumber()) return otherwise;
  return {list.Get(0).GetNumberAsDouble(), list.Get(1).GetNumberAsDouble(), list.Get(2).GetNumberAsDouble()};
}

// Returns −1 where there is none.
inline int index(const tinygltf::Value& object, const char* name) {
  return object.Has(name) && object.Get(name).IsInt() ? object.Get(name).GetNumberAsInt() : -1;
}

// Returns a textureInfo.
inline std::optional<tinygltf::TextureInfo> texture_info(const tinygltf::Value& object, const char* name) {
  if (!object.Has(name) || !object.Get(name).IsObject()) return {};
  const tinygltf::Value& value = object.Get(name);
  tinygltf::TextureInfo info;
  info.index = index(value, "index");
  info.texCoord = std::max(0, index(value, "texCoord"));
  if (value.Has("extensions") && value.Get("extensions").IsObject())
    for (const std::string& key : value.Get("extensions").Keys())
      info.extensions[key] = value.Get("extensions").Get(key);
  return info;
}

}  // namespace vitrail::gltf
