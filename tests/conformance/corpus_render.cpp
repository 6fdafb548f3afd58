// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/corpus_render.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

#include "tests/support/command.h"

namespace vitrail::test {

namespace {

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream in(text);
  for (std::string part; std::getline(in, part, at);) parts.push_back(part);
  return parts;
}

}  // namespace

std::string CorpusScene::name() const { return std::filesystem::path(path).stem().string(); }

std::vector<CorpusScene> corpus_scenes() {
  std::vector<CorpusScene> scenes;
  std::ifstream table(corpus() / "INDEX.tsv");
  std::string line;
  std::getline(table, line);  // the heads
  while (std::getline(table, line)) {
    const std::vector<std::string> row = split(line, '\t');
    if (row.size() < 5) continue;
    scenes.push_back({row[1], row[2], row[4], split(row[3], ',')});
  }
  return scenes;
}

void PrintTo(const CorpusScene& scene, std::ostream* out) { *out << scene.path; }

std::string render_scene(const std::filesystem::path& scene, const std::filesystem::path& picture,
                         const std::string& arguments) {
  const std::filesystem::path bundle = picture.parent_path() / "bundle.vit";
  if (!std::filesystem::exists(bundle)) {
    const CommandResult made = run(fmt::format("{} '{}' -o '{}' --domains 1 --quiet", vitrail("partition"),
                                               scene.string(), bundle.string()));
    if (made.status != 0) return made.output;
  }
  const CommandResult done =
      run(fmt::format("{} '{}' -o '{}' {}", vitrail("render"), bundle.string(), picture.string(), arguments));
  return done.status == 0 ? "" : done.output;
}

nlohmann::json compare_pictures(const std::filesystem::path& image, const std::filesystem::path& reference,
                                const std::string& arguments) {
  const CommandResult result = run(fmt::format("{} '{}' '{}' --json {}", vitrail("compare"), image.string(),
                                               reference.string(), arguments));
  EXPECT_LE(result.status, 1) << result.output;
  return nlohmann::json::parse(result.output, nullptr, false);
}

MeanXyz mean_xyz(const nlohmann::json& comparison) {
  MeanXyz mean;
  for (const char* channel : {"mean_ratio_x", "mean_ratio_y", "mean_ratio_z"}) {
    const nlohmann::json& ratio = comparison[channel];
    const double r = ratio.is_number() ? ratio.get<double>() : 0;
    mean.worst = std::max(mean.worst, std::abs(r - 1));
    mean.text += fmt::format(" {:.4f}", r);
  }
  return mean;
}

void conclude(bool passed, const std::string& scene, const std::string& what) {
  fmt::print("{:4} {:50} {}\n", passed ? "ok" : "FAIL", scene, what);
  std::fflush(stdout);
  if (!passed) ADD_FAILURE() << scene << " " << what;
}

std::string case_name(const std::string& name) {
  std::string text = name;
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return text;
}

}  // namespace vitrail::test
