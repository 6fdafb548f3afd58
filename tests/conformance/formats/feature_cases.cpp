// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/formats/feature_cases.h"

#include <cstdint>
#include <fstream>
#include <stdexcept>

namespace vitrail::test {

namespace {

void write(const std::filesystem::path& file, const std::string& text) {
  std::ofstream(file, std::ios::binary) << text;
}

// Mitsuba's volume of 2 × 1 × 1 numbers: "VOL", version 3, type float, sizes, channels, box, values.
std::string volume_file() {
  std::string bytes = "VOL\3";
  for (const std::int32_t n : {1, 2, 1, 1, 1}) bytes.append(reinterpret_cast<const char*>(&n), sizeof n);
  for (const float x : {-1.0F, -1.0F, -1.0F, 1.0F, 1.0F, 1.0F, 0.4F, 0.8F})
    bytes.append(reinterpret_cast<const char*>(&x), sizeof x);
  return bytes;
}

}  // namespace

std::vector<PluginCase> read_cases(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in) throw std::runtime_error("there is no " + file.string());
  std::vector<PluginCase> cases;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    if (line[0] == ' ') {
      cases.back().parameters.push_back(line.substr(2));
      continue;
    }
    const std::size_t end = line.find(" ; ");
    cases.push_back({line.substr(0, end), end == std::string::npos ? "" : line.substr(end + 3), {}});
  }
  return cases;
}

std::string parameter_name(SceneFormat format, const std::string& parameter) {
  if (format == SceneFormat::obj) return "`" + parameter + "`";
  if (parameter[0] == '"') return parameter.substr(1, parameter.find('"', 1) - 1);
  const std::string tag = parameter.substr(1, parameter.find_first_of(" >") - 1);
  const auto attribute = [&](const std::string& name) {
    const std::size_t at = parameter.find(name + "='");
    if (at == std::string::npos) return std::string();
    const std::size_t begin = at + name.size() + 2;
    return parameter.substr(begin, parameter.find('\'', begin) - begin);
  };
  const std::string name = attribute("name");
  return tag + " " + (tag == "phase" || name.empty() ? attribute("type") : name);
}

void write_opened_files(const std::filesystem::path& folder) {
  write(folder / "mesh.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\n");
  write(folder / "mesh.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  write(folder / "curve.txt", "0 0 0 .1\n.3 .3 0 .1\n.6 .3 0 .1\n1 0 0 .1\n");
  write(folder / "grid.vol", volume_file());
  write(folder / "lens.dat", "29 2 1.6 20\n0 1 0 15\n-29 2 1 20\n");
}

}  // namespace vitrail::test
