// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/levels.h"

#include <algorithm>

namespace vitrail::pov {

namespace {

template <class T>
int levels_of(const Shared<T>& thing) {
  return thing ? thing->levels : 0;
}

// Textures are changed once they were read: their own number may be too small.
int levels_of(const Shared<Texture>& texture) {
  return texture ? std::max(texture->levels, 1 + levels_within(*texture)) : 0;
}

}  // namespace

int levels_of(const Value& value) {
  if (const auto* array = std::get_if<std::shared_ptr<Array>>(&value)) return (*array)->levels;
  if (const auto* object = std::get_if<Shared<Object>>(&value)) return levels_of(*object);
  if (const auto* pigment = std::get_if<Shared<Pigment>>(&value)) return levels_of(*pigment);
  if (const auto* bump = std::get_if<Shared<Bump>>(&value)) return levels_of(*bump);
  if (const auto* texture = std::get_if<Shared<Texture>>(&value)) return levels_of(*texture);
  if (const auto* map = std::get_if<Shared<BlendMap>>(&value)) return levels_of(*map);
  if (const auto* function = std::get_if<Shared<Function>>(&value)) return levels_of(*function);
  return 0;
}

int levels_within(const Pattern& pattern) {
  return std::max({levels_of(pattern.function), levels_of(pattern.object), levels_of(pattern.pigment)});
}

int levels_within(const BlendMap& map) {
  int most = 0;
  for (const BlendEntry& e : map.entries)
    most = std::max({most, levels_of(e.pigment), levels_of(e.texture), levels_of(e.bump)});
  return most;
}

int levels_within(const Pigment& pigment) {
  return std::max(levels_within(pigment.pattern), levels_of(pigment.map));
}

int levels_within(const Bump& bump) { return std::max(levels_within(bump.pattern), levels_of(bump.map)); }

int levels_within(const Texture& texture) {
  int most = std::max({levels_of(texture.pigment), levels_of(texture.normal), levels_of(texture.map),
                       texture.pattern ? levels_within(*texture.pattern) : 0});
  for (const auto& layer : texture.layers) most = std::max(most, layer->levels);
  return most;
}

int levels_within(const Interior& interior) {
  int most = 0;
  for (const auto& media : interior.media)
    for (const auto& density : media->densities) most = std::max(most, levels_of(density));
  return most;
}

int levels_within(const Object& object) {
  int most = std::max(levels_of(object.texture), levels_of(object.interior_texture));
  if (object.interior) most = std::max(most, levels_within(*object.interior));
  if (const auto* mesh = std::get_if<MeshShape>(&object.shape))
    for (const auto& part : mesh->parts) most = std::max(most, levels_of(part.texture));
  for (const auto& child : object.children) most = std::max(most, child->levels);
  for (const auto& clip : object.clipped_by) most = std::max(most, clip->levels);
  return most;
}

int levels_within(const Function& function) {
  int most = levels_of(function.source);
  for (const auto& callee : function.callees) most = std::max(most, callee->levels);
  return most;
}

int levels_within(const Array& array) {
  int most = 0;
  for (const Value& element : array.elements) most = std::max(most, levels_of(element));
  return most;
}

}  // namespace vitrail::pov
