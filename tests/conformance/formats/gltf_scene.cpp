// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "tests/conformance/formats/feature_cases.h"

namespace vitrail::test {

namespace {

// Accessors of a square: positions, (u,v) twice, positions again, indices.
constexpr const char* geometry =
    R"("buffers":[{"byteLength":92,"uri":"data:application/octet-stream;base64,AACAvwAAAAAAAIA/AACAPwAAAAAAAIA/AACAPwAAAAAAAIC/AACAvwAAAAAAAIC/AAABAAIAAAACAAMAAAAAAAAAgD8AAIA/AACAPwAAgD8AAAAAAAAAAAAAAAA="}],
"bufferViews":[{"buffer":0,"byteLength":48},{"buffer":0,"byteOffset":48,"byteLength":12},{"buffer":0,"byteOffset":60,"byteLength":32}],
"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":4},{"bufferView":2,"componentType":5126,"type":"VEC2","count":4},
{"bufferView":2,"componentType":5126,"type":"VEC2","count":4},{"bufferView":0,"componentType":5126,"type":"VEC3","count":4},{"bufferView":1,"componentType":5123,"type":"SCALAR","count":6}])";

// "a,b" of what is not empty.
std::string members(std::initializer_list<std::string> all) {
  std::string joined;
  for (const std::string& each : all)
    if (!each.empty()) joined += (joined.empty() ? "" : ",") + each;
  return joined;
}

}  // namespace

// A square seen by a camera under a lamp.
std::string gltf_scene(const PluginCase& plugin, const std::string& parameters) {
  const std::string word = plugin.name.substr(0, plugin.name.find(' '));
  const std::string type = plugin.name.size() > word.size() ? plugin.name.substr(word.size() + 1) : "";
  const std::string text = members({plugin.needs, parameters});
  const auto of = [&](const char* what, const std::string& otherwise) {
    return word == what ? text : otherwise;
  };
  const std::string camera = word == "camera" ? type : "perspective",
                    light = word == "light" ? type : "point";
  const bool in_extension = word == "extension";
  const bool volume = type == "KHR_materials_volume", strength = type == "KHR_materials_emissive_strength";
  std::string extensions;
  if (in_extension) extensions = fmt::format("\"{}\":{{{}}}", type, text);
  if (volume) extensions += R"(,"KHR_materials_transmission":{"transmissionFactor":1})";
  const std::string textured =
      fmt::format(R"("baseColorTexture":{{"index":0{}}})",
                  word == "texture" ? fmt::format(R"(,"extensions":{{"{}":{{{}}}}})", type, text) : "");
  const std::string pbr = members(
      {R"("metallicFactor":0)", word == "texture" || word == "sampler" ? textured : "", of("pbr", "")});
  const std::string material =
      members({R"("doubleSided":true)", fmt::format("\"pbrMetallicRoughness\":{{{}}}", pbr),
               strength ? R"("emissiveFactor":[1,1,1])" : "", of("material", ""),
               extensions.empty() ? "" : fmt::format("\"extensions\":{{{}}}", extensions)});
  return fmt::format(
      R"({{"asset":{{"version":"2.0"}},{},
"scenes":[{{"nodes":[0,1,2]}}],"nodes":[{{"camera":0,"translation":[0,1,9]}},{{"mesh":0{}}},
{{"translation":[1,4,2],"rotation":[-0.6,0,0,0.8],"extensions":{{"KHR_lights_punctual":{{"light":0}}}}}},{{"mesh":0,"translation":[0,1,0]}}],
"cameras":[{{"type":"{}","{}":{{{}}}}}],"extensions":{{"KHR_lights_punctual":{{"lights":[{{"type":"{}",{}}}]}}}},
"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0,"TEXCOORD_0":1,"TEXCOORD_1":2}},"material":0{}}}]}}],
"images":[{{"uri":"a.png"}}],"textures":[{{"source":0,"sampler":0}}],"samplers":[{{{}}}],"materials":[{{{}}}]}})",
      geometry, word == "node" && !text.empty() ? "," + text : "", camera, camera,
      of("camera", R"("yfov":0.6,"znear":0.1)"), light, of("light", R"("intensity":9)"),
      word == "primitive" && !text.empty() ? "," + text : R"(,"indices":4)", of("sampler", ""), material);
}

}  // namespace vitrail::test
