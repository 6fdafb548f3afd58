// SPDX-License-Identifier: Apache-2.0
// Scenes of the corpus, rendered and compared by the programs that users run.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/temporary_directory.h"

namespace vitrail::test {

// A line of the corpus' INDEX.tsv.
struct CorpusScene {
  std::string format, path, reference_kind;
  std::vector<std::string> references;
  std::string name() const;  // of the file, without folders and extension
};
void PrintTo(const CorpusScene& scene, std::ostream* out);

// Of the whole index; empty where there is no corpus.
std::vector<CorpusScene> corpus_scenes();

// Renders. `arguments` go to render. Returns what went wrong, or "". Partitions into one domain, once for all
// pictures in a folder: they are of one scene.
std::string render_scene(const std::filesystem::path& scene, const std::filesystem::path& picture,
                         const std::string& arguments);

// vitrail compare with --json, whatever it decides.
nlohmann::json compare_pictures(const std::filesystem::path& image, const std::filesystem::path& reference,
                                const std::string& arguments);

// Means of X, Y and Z over those of the reference, and by how much the worst is off.
struct MeanXyz {
  std::string text;  // "1.0010 0.9990 1.0000"
  double worst = 0;
};
MeanXyz mean_xyz(const nlohmann::json& comparison);

// Prints the line of a table, which fails the test unless `passed`.
void conclude(bool passed, const std::string& scene, const std::string& what);

// Letters, digits and underscores, as GoogleTest wants the name of a case.
std::string case_name(const std::string& name);

}  // namespace vitrail::test
