// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/gate/renderings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>

#include "farm/render.h"
#include "film/film_progress.h"
#include "partitioner/appearance/appearance.h"
#include "partitioner/partition.h"
#include "tests/support/command.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test {

std::vector<BlockMeans> rendered(const Scene& scene, const Sampling& sampling) {
  const TemporaryDirectory directory;
  PartitionOptions partitioning;
  partitioning.domains = 1;
  partition(scene, directory / "scene.vit", partitioning);
  RenderOptions options;
  options.bundle = directory / "scene.vit";
  options.outputs.film = directory / "scene.film";
  options.picture.samples_per_pixel = sampling.samples;
  options.outputs.force = true;  // each seed is read before the next takes its name
  int argc = 0;
  char** argv = nullptr;
  const auto transport = make_transport(&argc, &argv);
  std::vector<BlockMeans> means;
  for (int seed = 0; seed < sampling.seeds; ++seed) {
    options.picture.seed = static_cast<std::uint64_t>(seed);
    render(*transport, options);
    means.push_back(block_means(read_film(options.outputs.film, nullptr)));
  }
  return means;
}

bool renders_exactly(const Scene& scene) { return appearance_of(scene, "").diagnostics.empty(); }

namespace {

// As far as Mitsuba gets.
std::vector<MitsubaAnswer> ask_mitsuba(std::span<const std::filesystem::path> scenes,
                                       const Sampling& sampling, const std::filesystem::path& folder,
                                       std::string& ended_with) {
  nlohmann::json request{{"variant", "scalar_spectral"},
                         {"blocks", blocks_a_side},
                         {"samples", sampling.samples},
                         {"seeds", sampling.seeds},
                         {"scenes", nlohmann::json::array()}};
  for (const auto& scene : scenes) request["scenes"].push_back(scene.string());
  const std::string asked = (folder / "request.json").string(), said = (folder / "answers.jsonl").string();
  std::ofstream(asked) << request;
  std::filesystem::remove(said);
  ended_with = run(fmt::format("{} {}/tests/conformance/gate/mitsuba_gate.py '{}' '{}'",
                               python_with_mitsuba(), source_dir(), asked, said))
                   .output;
  std::vector<MitsubaAnswer> answers;
  std::ifstream in(said);
  for (std::string line; std::getline(in, line);) {
    const auto answer = nlohmann::json::parse(line);
    answers.push_back({answer.value("error", ""), answer.value("warnings", std::vector<std::string>{}),
                       answer.value("means", std::vector<BlockMeans>{})});
  }
  return answers;
}

}  // namespace

std::vector<MitsubaAnswer> rendered_by_mitsuba(const std::vector<std::filesystem::path>& scenes,
                                               const Sampling& sampling,
                                               const std::filesystem::path& folder) {
  std::vector<MitsubaAnswer> answers;
  while (answers.size() < scenes.size()) {
    std::string ended_with;
    std::ranges::move(ask_mitsuba(std::span(scenes).subspan(answers.size()), sampling, folder, ended_with),
                      std::back_inserter(answers));
    if (answers.size() < scenes.size()) answers.push_back({"Mitsuba itself ended: " + ended_with, {}, {}});
  }
  return answers;
}

const std::string& python_with_mitsuba() {
  static const std::string found = [] {
    const char* chosen = std::getenv("VITRAIL_MITSUBA_PYTHON");
    for (const std::string& python :
         {std::string(chosen ? chosen : ""), std::string("python3"), std::string("/usr/bin/python3")})
      if (!python.empty() && run(python + " -c 'import mitsuba, numpy'").status == 0) return python;
    return std::string();
  }();
  return found;
}

}  // namespace vitrail::test
