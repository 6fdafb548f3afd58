// SPDX-License-Identifier: Apache-2.0
#include "importers/gltf/read/primitive.h"

#include <fmt/format.h>

#include "importers/gltf/read/accessors.h"

namespace vitrail::gltf {

bool PrimitiveReader::has_data(const std::string& name) const {
  const auto& accessors = document_.model().accessors;
  const auto at = primitive_.attributes.find(name);
  return at != primitive_.attributes.end() &&
         document_.element(accessors, at->second, "accessors", "meshes", mesh_).bufferView >= 0;
}

int PrimitiveReader::color_channels() const {
  const auto color = primitive_.attributes.find("COLOR_0");
  if (color == primitive_.attributes.end()) return 0;
  const int channels = components_of(document_, color->second);
  if (channels != 3 && channels != 4)
    fail(fmt::format("COLOR_0 has {} channels, and 3 or 4 are meant", channels));
  return channels;
}

std::size_t PrimitiveReader::vertices() const {
  return count_of(document_, primitive_.attributes.at("POSITION"));
}

std::vector<float> PrimitiveReader::attribute(const std::string& name, int components) const {
  std::vector<float> values = read_floats(document_, primitive_.attributes.at(name), components);
  const std::size_t count = values.size() / static_cast<std::size_t>(components);
  if (count != vertices()) fail(fmt::format("{} of {} vertices, of {} positions", name, count, vertices()));
  return values;
}

std::vector<std::array<std::uint32_t, 3>> PrimitiveReader::triangles() const {
  std::vector<std::uint32_t> corners;
  if (primitive_.indices >= 0) {
    corners = read_indices(document_, primitive_.indices);
    for (std::size_t i = 0; i < corners.size(); ++i)
      if (corners[i] >= vertices())
        fail(fmt::format("index {} of its corners is {}, and it has {} vertices", i, corners[i], vertices()));
  } else {
    corners.resize(vertices());
    for (std::size_t i = 0; i < corners.size(); ++i) corners[i] = static_cast<std::uint32_t>(i);
  }
  std::vector<std::array<std::uint32_t, 3>> triangles;
  const int mode = primitive_.mode < 0 ? TINYGLTF_MODE_TRIANGLES : primitive_.mode;
  const std::size_t n = corners.size();
  if (mode == TINYGLTF_MODE_TRIANGLES) {
    triangles.reserve(n / 3);
    for (std::size_t i = 0; i + 2 < n; i += 3)
      triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
  } else if (mode == TINYGLTF_MODE_TRIANGLE_STRIP) {
    for (std::size_t i = 0; i + 2 < n; ++i)
      triangles.push_back({corners[i], corners[i + 1 + i % 2], corners[i + 2 - i % 2]});
  } else if (mode == TINYGLTF_MODE_TRIANGLE_FAN) {
    for (std::size_t i = 0; i + 2 < n; ++i) triangles.push_back({corners[i + 1], corners[i + 2], corners[0]});
  } else if (mode > TINYGLTF_MODE_TRIANGLE_FAN) {
    fail(fmt::format("mode {} is none of glTF's", mode));
  }
  std::erase_if(triangles, [](const auto& t) { return t[0] == t[1] || t[1] == t[2] || t[2] == t[0]; });
  return triangles;
}

void PrimitiveReader::morph(const std::string& name, const std::vector<double>& weights,
                            std::vector<float>& values) const {
  for (std::size_t i = 0; i < primitive_.targets.size() && i < weights.size(); ++i) {
    const auto target = primitive_.targets[i].find(name);
    if (weights[i] == 0 || target == primitive_.targets[i].end()) continue;
    const std::vector<float> delta = read_floats(document_, target->second, 3);
    if (delta.size() != values.size()) fail(fmt::format("morph target {} has other vertices", i));
    for (std::size_t k = 0; k < delta.size(); ++k) values[k] += static_cast<float>(weights[i]) * delta[k];
  }
}

std::vector<Transform> PrimitiveReader::skin(const std::vector<Transform>& joints) const {
  Transform zero;
  for (auto& row : zero.m) row = {};
  std::vector<Transform> sums(vertices(), zero);
  for (int set = 0; has(fmt::format("JOINTS_{}", set)) && has(fmt::format("WEIGHTS_{}", set)); ++set) {
    const auto indices = read_integers(document_, primitive_.attributes.at(fmt::format("JOINTS_{}", set)), 4);
    const auto weights = attribute(fmt::format("WEIGHTS_{}", set), 4);
    if (indices.size() != weights.size()) fail("its JOINTS and WEIGHTS have not the same length");
    for (std::size_t i = 0; i < weights.size(); ++i) {
      if (weights[i] == 0) continue;
      if (indices[i] >= joints.size())
        fail(fmt::format("joint {} of its skin's {}", indices[i], joints.size()));
      for (std::size_t r = 0; r < 4; ++r)
        for (std::size_t c = 0; c < 4; ++c)
          sums[i / 4].m[r][c] += static_cast<double>(weights[i]) * joints[indices[i]].m[r][c];
    }
  }
  for (Transform& t : sums)  // weights that do not sum to 1
    if (const double w = t.m[3][3]; w != 0 && w != 1)
      for (auto& row : t.m)
        for (double& v : row) v /= w;
  return sums;
}

}  // namespace vitrail::gltf
