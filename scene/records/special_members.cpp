// SPDX-License-Identifier: Apache-2.0
// What copies, moves, destroys and compares the large records: compiled here and nowhere else.
#include "scene/records/scene.h"

namespace vitrail {

TextureModel::TextureModel() = default;
TextureModel::TextureModel(const TextureModel&) = default;
TextureModel::TextureModel(TextureModel&&) noexcept = default;
TextureModel& TextureModel::operator=(const TextureModel&) = default;
TextureModel& TextureModel::operator=(TextureModel&&) noexcept = default;
TextureModel::~TextureModel() = default;
bool TextureModel::operator==(const TextureModel&) const = default;

MaterialModel::MaterialModel() = default;
MaterialModel::MaterialModel(const MaterialModel&) = default;
MaterialModel::MaterialModel(MaterialModel&&) noexcept = default;
MaterialModel& MaterialModel::operator=(const MaterialModel&) = default;
MaterialModel& MaterialModel::operator=(MaterialModel&&) noexcept = default;
MaterialModel::~MaterialModel() = default;
bool MaterialModel::operator==(const MaterialModel&) const = default;

LightModel::LightModel() = default;
LightModel::LightModel(const LightModel&) = default;
LightModel::LightModel(LightModel&&) noexcept = default;
LightModel& LightModel::operator=(const LightModel&) = default;
LightModel& LightModel::operator=(LightModel&&) noexcept = default;
LightModel::~LightModel() = default;
bool LightModel::operator==(const LightModel&) const = default;

Scene::Scene() = default;
Scene::Scene(const Scene&) = default;
Scene::Scene(Scene&&) noexcept = default;
Scene& Scene::operator=(const Scene&) = default;
Scene& Scene::operator=(Scene&&) noexcept = default;
Scene::~Scene() = default;

}  // namespace vitrail
