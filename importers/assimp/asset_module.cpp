// SPDX-License-Identifier: Apache-2.0
// The module that speaks assimp.
#include <assimp/commonMetaData.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cstdlib>
#include <numbers>
#include <string_view>

#include "importers/assimp/asset.h"

namespace vitrail::assimp {

namespace {

constexpr double degrees = 180 / std::numbers::pi;

// In any letter case.
bool has_suffix(const std::string& file, std::string_view suffix) {
  return file.size() >= suffix.size() &&
         std::equal(suffix.begin(), suffix.end(), file.end() - static_cast<std::ptrdiff_t>(suffix.size()),
                    [](char a, char b) { return a == (b >= 'A' && b <= 'Z' ? b + 32 : b); });
}

Transform transform_of(const aiMatrix4x4& m) {
  Transform t;
  for (unsigned r = 0; r < 4; ++r)
    for (unsigned c = 0; c < 4; ++c) t.m[r][c] = static_cast<double>(m[r][c]);
  return t;
}

Vector3d vector_of(const aiVector3D& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

AssetMesh mesh_of(const aiMesh& in) {
  AssetMesh mesh;
  mesh.name = in.mName.C_Str();
  mesh.material = in.mMaterialIndex;
  for (unsigned i = 0; i < in.mNumVertices; ++i) {
    const aiVector3D& p = in.mVertices[i];
    mesh.positions.push_back({p.x, p.y, p.z});
    if (in.mNormals) mesh.normals.push_back({in.mNormals[i].x, in.mNormals[i].y, in.mNormals[i].z});
    if (const aiVector3D* uv = in.mTextureCoords[0]) mesh.uvs.push_back({uv[i].x, uv[i].y});
  }
  for (unsigned i = 0; i < in.mNumFaces; ++i)
    if (const aiFace& face = in.mFaces[i]; face.mNumIndices == 3)
      mesh.triangles.push_back({face.mIndices[0], face.mIndices[1], face.mIndices[2]});
  return mesh;
}

std::optional<std::array<double, 3>> color_of(const aiMaterial& in, const char* key, unsigned type,
                                              unsigned index) {
  aiColor3D c;
  if (in.Get(key, type, index, c) != AI_SUCCESS) return {};
  return std::array{static_cast<double>(c.r), static_cast<double>(c.g), static_cast<double>(c.b)};
}

std::optional<double> number_of(const aiMaterial& in, const char* key, unsigned type, unsigned index) {
  ai_real value = 0;
  if (in.Get(key, type, index, value) != AI_SUCCESS) return {};
  return static_cast<double>(value);
}

std::optional<AssetImage> image_of(const aiScene& scene, const aiMaterial& in,
                                   std::initializer_list<aiTextureType> types) {
  for (const aiTextureType type : types) {
    aiString name;
    aiTextureMapMode modes[3] = {aiTextureMapMode_Wrap, aiTextureMapMode_Wrap, aiTextureMapMode_Wrap};
    if (in.GetTextureCount(type) == 0 ||
        in.GetTexture(type, 0, &name, nullptr, nullptr, nullptr, nullptr, modes) != AI_SUCCESS)
      continue;
    const aiTexture* inside = scene.GetEmbeddedTexture(name.C_Str());
    AssetImage image{name.C_Str(),
                     inside != nullptr,
                     {},
                     modes[0] == aiTextureMapMode_Clamp,
                     modes[0] == aiTextureMapMode_Mirror};
    if (inside && inside->mHeight == 0)
      image.bytes.assign(reinterpret_cast<const char*>(inside->pcData), inside->mWidth);
    return image;
  }
  return {};
}

AssetMaterial material_of(const aiScene& scene, const aiMaterial& in) {
  AssetMaterial material;
  material.name = in.GetName().C_Str();
  int model = aiShadingMode_Phong;
  in.Get(AI_MATKEY_SHADING_MODEL, model);
  material.is_shiny = model != aiShadingMode_Gouraud && model != aiShadingMode_Flat &&
                      model != aiShadingMode_NoShading && model != aiShadingMode_OrenNayar;
  material.diffuse = color_of(in, AI_MATKEY_COLOR_DIFFUSE);
  if (!material.diffuse) material.diffuse = color_of(in, AI_MATKEY_BASE_COLOR);
  material.specular = color_of(in, AI_MATKEY_COLOR_SPECULAR);
  if (const auto strength = number_of(in, AI_MATKEY_SHININESS_STRENGTH); strength && material.specular)
    for (double& c : *material.specular) c *= *strength;
  material.emission = color_of(in, AI_MATKEY_COLOR_EMISSIVE);
  material.opacity = number_of(in, AI_MATKEY_OPACITY);
  material.shininess = number_of(in, AI_MATKEY_SHININESS);
  // What assimp says of a COLLADA material that has no highlight.
  if (material.specular == std::array{0.4f * 1.0, 0.4f * 1.0, 0.4f * 1.0} && material.shininess == 10)
    material.specular.reset();
  material.index = number_of(in, AI_MATKEY_REFRACTI);
  material.diffuse_image = image_of(scene, in, {aiTextureType_DIFFUSE, aiTextureType_BASE_COLOR});
  material.specular_image = image_of(scene, in, {aiTextureType_SPECULAR});
  material.emission_image = image_of(scene, in, {aiTextureType_EMISSIVE, aiTextureType_EMISSION_COLOR});
  material.opacity_image = image_of(scene, in, {aiTextureType_OPACITY});
  material.height_image = image_of(scene, in, {aiTextureType_HEIGHT});
  material.normal_image = image_of(scene, in, {aiTextureType_NORMALS, aiTextureType_NORMAL_CAMERA});
  return material;
}

AssetLight light_of(const aiLight& in, std::size_t node) {
  AssetLight light;
  light.node = node;
  light.kind = in.mType == aiLightSource_POINT         ? AssetLight::Kind::point
               : in.mType == aiLightSource_SPOT        ? AssetLight::Kind::spot
               : in.mType == aiLightSource_DIRECTIONAL ? AssetLight::Kind::directional
                                                       : AssetLight::Kind::other;
  light.position = Point3d{} + vector_of(in.mPosition);
  light.direction = vector_of(in.mDirection);
  light.color = {static_cast<double>(in.mColorDiffuse.r), static_cast<double>(in.mColorDiffuse.g),
                 static_cast<double>(in.mColorDiffuse.b)};
  light.constant = static_cast<double>(in.mAttenuationConstant);
  light.linear = static_cast<double>(in.mAttenuationLinear);
  light.quadratic = static_cast<double>(in.mAttenuationQuadratic);
  // The cones from edge to edge, in all three formats.
  light.inner_deg = static_cast<double>(in.mAngleInnerCone) * degrees / 2;
  light.outer_deg = static_cast<double>(in.mAngleOuterCone) * degrees / 2;
  return light;
}

AssetCamera camera_of(const aiCamera& in, std::size_t node) {
  AssetCamera camera;
  camera.node = node;
  camera.position = Point3d{} + vector_of(in.mPosition);
  camera.direction = vector_of(in.mLookAt);
  camera.up = vector_of(in.mUp);
  camera.horizontal_fov_deg = static_cast<double>(in.mHorizontalFOV) * degrees;
  camera.aspect = static_cast<double>(in.mAspect);
  return camera;
}

// Of FBX, whose lights have no units of their own. Blender's have since 2.80.
std::optional<double> units_of_blender(const aiScene& scene) {
  constexpr std::string_view blender = "Blender (stable FBX IO) - ";
  aiString generator;
  float centimetres = 1;
  if (!scene.mMetaData || !scene.mMetaData->Get(AI_METADATA_SOURCE_GENERATOR, generator) ||
      !std::string_view(generator.C_Str()).starts_with(blender) ||
      std::strtod(generator.C_Str() + blender.size(), nullptr) < 2.8)
    return {};
  scene.mMetaData->Get("UnitScaleFactor", centimetres);
  return centimetres > 0 ? std::optional(100 / static_cast<double>(centimetres)) : std::nullopt;
}

// assimp takes the grey .8 of another template where Blender leaves out a lamp's colour, which is white.
void brighten_white_lamps(Asset& asset) {
  for (AssetLight& light : asset.lights)
    if (light.color[0] == light.color[1] && light.color[1] == light.color[2])
      for (double& c : light.color) c /= 0.8;
}

// Nodes in the order of the file. Lights and cameras stand in the nodes of their names. Those that assimp
// made of parts of a transform are parts of the next one.
void add_nodes(const aiScene& scene, Asset& asset) {
  struct Open {
    const aiNode* node;
    std::size_t parent;
    aiMatrix4x4 before;
  };
  std::vector<Open> open{{scene.mRootNode, 0, {}}};
  while (!open.empty()) {
    const auto [node, parent, before] = open.back();
    open.pop_back();
    const aiMatrix4x4 to_parent = before * node->mTransformation;
    const bool is_part =
        std::string_view(node->mName.C_Str()).find("_$AssimpFbx$_") != std::string_view::npos;
    if (is_part && node->mNumMeshes == 0 && node != scene.mRootNode) {
      for (unsigned i = node->mNumChildren; i-- > 0;) open.push_back({node->mChildren[i], parent, to_parent});
      continue;
    }
    const std::size_t index = asset.nodes.size();
    asset.nodes.push_back({node->mName.C_Str(),
                           parent,
                           transform_of(to_parent),
                           {node->mMeshes, node->mMeshes + node->mNumMeshes}});
    for (unsigned i = 0; i < scene.mNumLights; ++i)
      if (scene.mLights[i]->mName == node->mName) asset.lights.push_back(light_of(*scene.mLights[i], index));
    for (unsigned i = 0; i < scene.mNumCameras; ++i)
      if (scene.mCameras[i]->mName == node->mName)
        asset.cameras.push_back(camera_of(*scene.mCameras[i], index));
    for (unsigned i = node->mNumChildren; i-- > 0;) open.push_back({node->mChildren[i], index, {}});
  }
}

// FBX states how many centimetres its unit has. A light's attenuation is by the file's unit.
void in_metres(const aiScene& scene, Asset& asset) {
  float centimetres = 0;
  if (!scene.mMetaData || !scene.mMetaData->Get("UnitScaleFactor", centimetres) || !(centimetres > 0)) return;
  const double unit = static_cast<double>(centimetres) / 100;
  for (std::size_t row = 0; row < 3; ++row)
    for (double& v : asset.nodes.front().to_parent.m[row]) v *= unit;
  for (AssetLight& light : asset.lights) light.linear /= unit, light.quadratic /= unit * unit;
  if (asset.units_of_blender) asset.units_of_blender = 1;
}

}  // namespace

}  // namespace vitrail::assimp

// Called from C++ alone: by its plain name, which dlsym finds.
// NOLINTNEXTLINE(clang-diagnostic-return-type-c-linkage)
extern "C" std::string vitrail_read_asset(const std::string& file, vitrail::assimp::Asset& asset) {
  using namespace vitrail::assimp;
  Assimp::Importer importer;
  // With the parts of FBX's transforms as nodes of their own: joined by assimp, PostRotation turns the wrong
  // way.
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, true);
  unsigned steps = aiProcess_Triangulate | aiProcess_SortByPType | aiProcess_JoinIdenticalVertices;
  // assimp loses normals by vertices of FBX, as Blender writes them of what is smooth all over.
  constexpr float crease_deg = 60;
  importer.SetPropertyFloat(AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, crease_deg);
  if (has_suffix(file, "fbx")) steps |= aiProcess_GenSmoothNormals;
  const aiScene* scene = importer.ReadFile(file, steps);
  if (!scene || !scene->mRootNode) return importer.GetErrorString();
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
    const aiMesh& mesh = *scene->mMeshes[i];
    asset.points_and_lines += (mesh.mPrimitiveTypes & (aiPrimitiveType_POINT | aiPrimitiveType_LINE)) != 0;
    asset.bones += mesh.mNumBones;
    asset.colored_meshes += mesh.HasVertexColors(0);
    asset.meshes.push_back(mesh_of(mesh));
  }
  for (unsigned i = 0; i < scene->mNumMaterials; ++i)
    asset.materials.push_back(material_of(*scene, *scene->mMaterials[i]));
  asset.animations = scene->mNumAnimations;
  asset.units_of_blender = units_of_blender(*scene);
  add_nodes(*scene, asset);
  if (has_suffix(file, "fbx")) in_metres(*scene, asset);
  if (asset.units_of_blender) brighten_white_lamps(asset);
  // COLLADA has one angle and an exponent, of which assimp makes another angle.
  if (has_suffix(file, "dae"))
    for (AssetLight& light : asset.lights) light.outer_deg = light.inner_deg;
  // assimp has those of 3DS look elsewhere.
  if (has_suffix(file, "3ds")) asset.cameras.clear();
  return {};
}
