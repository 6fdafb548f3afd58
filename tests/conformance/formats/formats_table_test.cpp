// SPDX-License-Identifier: Apache-2.0
// docs/reference/formats.md: made from what the readers, the partitioner and the writers say of each plugin
// and parameter. The test fails where the page is not what they say now; VITRAIL_WRITE_DOCS=1 writes it anew.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "importers/export.h"
#include "importers/import.h"
#include "partitioner/appearance/appearance.h"
#include "tests/conformance/formats/feature_cases.h"
#include "tests/conformance/gate/scene_parts.h"
#include "tests/support/equal_scenes.h"
#include "tests/support/paths.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::formats_table_test {
namespace {

namespace fs = std::filesystem;

enum class Verdict { exact, no_effect, approximated, dropped, refused };

// What one step says of a scene: each message with its weight.
using Said = std::map<std::string, Verdict>;

constexpr std::array steps{"read", "rendered", "PBRT", "Mitsuba", "POV-Ray", "glTF"};
constexpr std::array<const char*, steps.size()> files{"", "", "out.pbrt", "out.xml", "out.pov", "out.glb"};
using Outcome = std::array<Said, steps.size()>;

struct Tried {
  std::optional<Scene> scene;  // none: refused
  Outcome said;
};

class Trials {
 public:
  Trials() {
    write_part_images(folder_.path());
    write_case_files(folder_.path());
  }

  Tried of(SceneFormat format, const PluginCase& plugin, const std::string& parameters) {
    const bool pbrt = format == SceneFormat::pbrt_v3 || format == SceneFormat::pbrt_v4;
    const bool gltf = format == SceneFormat::gltf;
    const bool obj = format == SceneFormat::obj;
    const fs::path file = folder_ / (pbrt ? "in.pbrt" : gltf ? "in.gltf" : obj ? "in.obj" : "in.xml");
    if (obj) std::ofstream(folder_ / "in.mtl") << mtl_library(plugin, parameters);
    std::ofstream(file) << host_scene(format, plugin, parameters);
    Tried tried;
    guard(tried.said[0], [&] {
      ImportOptions options;
      options.replace_missing = true;
      ImportedScene imported = import_scene(file, MeshMemory{}, {}, options);
      note(tried.said[0], imported.diagnostics);
      tried.scene = std::move(imported.scene);
    });
    if (!tried.scene) return tried;
    guard(tried.said[1], [&] { note(tried.said[1], appearance_of(*tried.scene, {}).diagnostics); });
    for (std::size_t step = 2; step < steps.size(); ++step) {
      fs::remove_all(folder_ / "out-images");  // so that names of images do not depend on what came before
      guard(tried.said[step],
            [&] { note(tried.said[step], export_scene(*tried.scene, folder_ / files[step])); });
    }
    return tried;
  }

 private:
  void note(Said& said, const Diagnostics& diagnostics) const {
    for (const Diagnostic& d : diagnostics)
      said.emplace(lasting(d.message),
                   d.fidelity == Fidelity::dropped ? Verdict::dropped : Verdict::approximated);
  }

  template <class Body>
  void guard(Said& said, Body&& body) const {
    try {
      body();
    } catch (const Error& e) {
      said.emplace(lasting(e.what()), Verdict::refused);
    }
  }

  // Without the temporary folder's name.
  std::string lasting(std::string message) const {
    const std::string place = folder_.path().string() + "/";
    for (std::size_t at; (at = message.find(place)) != std::string::npos;) message.erase(at, place.size());
    return message;
  }

  TemporaryDirectory folder_;
};

// Footnotes of one table: a text once.
class Notes {
 public:
  std::size_t number(const std::string& text) {
    const auto found = std::ranges::find(texts_, text);
    const auto index = static_cast<std::size_t>(found - texts_.begin());
    if (found == texts_.end()) texts_.push_back(text);
    return index + 1;
  }
  std::string list() const {
    std::string all;
    for (std::size_t i = 0; i < texts_.size(); ++i) all += fmt::format("{}. {}\n", i + 1, texts_[i]);
    return all;
  }

 private:
  std::vector<std::string> texts_;
};

using Counts = std::array<std::map<Verdict, int>, steps.size()>;

// What is said of `tried` beyond what is said without it. `around`: whether the plugin itself is exact there.
std::string cell(const Said& tried, const Said& without, bool changes, bool around_exact, Notes& notes,
                 std::map<Verdict, int>& counts) {
  Verdict worst = changes ? Verdict::exact : Verdict::no_effect;
  std::set<std::size_t> numbers;
  for (const auto& [message, verdict] : tried)
    if (!without.contains(message)) {
      worst = std::max(worst, verdict);
      numbers.insert(notes.number(message));
    }
  ++counts[worst == Verdict::exact && !around_exact ? Verdict::approximated : worst];
  constexpr std::array marks{"✓", "·", "≈", "✗", "refused"};
  if (worst == Verdict::exact && !around_exact) return "(≈)";
  return fmt::format("{} {}", marks[static_cast<std::size_t>(worst)], fmt::join(numbers, " "));
}

std::string cells(const Tried& tried, const Tried& without, const Tried* around, Notes& notes,
                  Counts& counts) {
  const bool changes = !tried.scene || !without.scene || !difference(*tried.scene, *without.scene).empty();
  std::string line;
  for (std::size_t step = 0; step < steps.size(); ++step) {
    if (step > 0 && !tried.scene) {
      line += " |";
      continue;
    }
    const bool around_exact = !around || std::ranges::all_of(without.said[step], [&](const auto& said) {
      return around->said[step].contains(said.first);
    });
    line += " | " + cell(tried.said[step], without.said[step], changes, around_exact, notes, counts[step]);
  }
  return line + " |\n";
}

// Parameters of one plugin of which the same is said, in one row: "float xradius, yradius".
class Rows {
 public:
  void add(const std::string& name, const std::string& cells) {
    const auto found = std::ranges::find(rows_, cells, &Row::cells);
    if (found == rows_.end()) {
      rows_.push_back({name, cells, type_of(name)});
      return;
    }
    const std::string type = type_of(name);
    found->names += ", " + (type == found->type ? name.substr(type.size()) : name);
    found->type = type;
  }
  std::string text() const {
    std::string all;
    for (const Row& row : rows_) all += "| " + row.names + row.cells;
    return all;
  }

 private:
  static std::string type_of(const std::string& name) { return name.substr(0, name.find(' ') + 1); }
  struct Row {
    std::string names, cells, type;  // the type of the last of the names
  };
  std::vector<Row> rows_;
};

std::string table_of(SceneFormat format, const std::string& cases, Trials& trials, Counts& counts) {
  const Tried host = trials.of(format, {}, "");
  EXPECT_TRUE(host.scene) << "the scene around the plugins is refused: " << host.said[0].begin()->first;
  std::string table =
      "| | read | rendered | → PBRT | → Mitsuba | → POV-Ray | → glTF |\n|---|---|---|---|---|---|---|\n";
  Notes notes;
  for (const PluginCase& plugin : read_cases(project_file("tests/conformance/formats/") + cases)) {
    const Tried alone = trials.of(format, plugin, "");
    table += "| **" + plugin.name + "**" + cells(alone, host, nullptr, notes, counts);
    if (!alone.scene) continue;
    Rows rows;
    for (const std::string& parameter : plugin.parameters)
      rows.add(parameter_name(format, parameter),
               cells(trials.of(format, plugin, parameter), alone, &host, notes, counts));
    table += rows.text();
  }
  return table + "\n" + notes.list();
}

std::string count_line(const char* step, const std::map<Verdict, int>& counts) {
  const auto of = [&](Verdict v) { return counts.contains(v) ? counts.at(v) : 0; };
  return fmt::format("| {} | {} | {} | {} | {} | {} |\n", step, of(Verdict::exact), of(Verdict::no_effect),
                     of(Verdict::approximated), of(Verdict::dropped), of(Verdict::refused));
}

std::string page() {
  constexpr std::array<std::tuple<const char*, const char*, SceneFormat>, 6> formats{{
      {"PBRT v4", "pbrt-v4.txt", SceneFormat::pbrt_v4},
      {"PBRT v3", "pbrt-v3.txt", SceneFormat::pbrt_v3},
      {"Mitsuba 3", "mitsuba-3.txt", SceneFormat::mitsuba_3},
      {"Mitsuba 0.6", "mitsuba-0.6.txt", SceneFormat::mitsuba_06},
      {"glTF 2.0", "gltf.txt", SceneFormat::gltf},
      {"OBJ and MTL", "obj.txt", SceneFormat::obj},
  }};
  Trials trials;
  std::string sections, summary;
  for (const auto& [title, cases, format] : formats) {
    Counts counts;
    sections += fmt::format("\n## {}\n\n{}", title, table_of(format, cases, trials, counts));
    summary += fmt::format("\n| {} | ✓ | · | ≈ | ✗ | refused |\n|---|---|---|---|---|---|\n", title);
    for (std::size_t step = 0; step < steps.size(); ++step) summary += count_line(steps[step], counts[step]);
  }
  return R"(# What is read, rendered and written

Made by `tests/conformance/formats` from what the programs say; do not edit. Each plugin stands in a small scene,
and each parameter in it gets an unusual value. A row says what reading, rendering and writing report
beyond what they report without it.

✓ exact · no effect on what is kept of a scene ≈ approximated ✗ dropped (≈) the parameter is exact, its plugin is approximated.
Numbers are of the list below each table. What comes out exactly is held by pictures
(`tests/conformance/gate`), not by this page.
)" + summary +
         sections;
}

TEST(Formats, ThePageIsWhatTheProgramsSay) {
  const fs::path file = project_file("docs/reference/formats.md");
  const std::string made = page();
  if (std::getenv("VITRAIL_WRITE_DOCS")) std::ofstream(file) << made;
  std::ifstream in(file);
  const std::string kept((std::istreambuf_iterator<char>(in)), {});
  std::istringstream now(made), then(kept);
  std::string a, b;
  for (int line = 1; std::getline(now, a); ++line)
    if (!std::getline(then, b) || a != b) {
      ADD_FAILURE() << file << ":" << line << "\n  says    " << b << "\n  is now  " << a
                    << "\nIf that is meant: VITRAIL_WRITE_DOCS=1 test_formats_table";
      return;
    }
  EXPECT_EQ(made.size(), kept.size());
}

}  // namespace
}  // namespace vitrail::test::formats_table_test
