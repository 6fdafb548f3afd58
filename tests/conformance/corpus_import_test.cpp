// SPDX-License-Identifier: Apache-2.0
// Every scene of the corpus is imported, or refused where it is broken or not of a format that is read. What
// is imported is written in its own format and read again: the Scene is equal, bit for bit, up to what the
// writer reports.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "importers/export.h"
#include "importers/import.h"
#include "tests/support/command.h"
#include "tests/support/equal_scenes.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::corpus_import_test {
namespace {

namespace fs = std::filesystem;

struct Entry {
  std::string format;
  fs::path file;     // relative to the corpus
  bool lacks_files;  // perhaps: of people
};

void read_index(const char* file, bool lacks_files, std::vector<Entry>& entries) {
  std::ifstream table(test::corpus() / file);
  std::string line;
  std::getline(table, line);  // the heads
  while (std::getline(table, line)) {
    std::istringstream row(line);
    std::string split, format, path;
    std::getline(row, split, '\t'), std::getline(row, format, '\t'), std::getline(row, path, '\t');
    if (!format.starts_with("povray")) entries.push_back({format, path, lacks_files});
  }
}

// The scenes that must import, and those of people, of which some lack files.
std::vector<Entry> index() {
  std::vector<Entry> entries;
  read_index("INDEX.tsv", false, entries);
  read_index("WILD.tsv", true, entries);
  return entries;
}

// Files that name others from a folder of their own are read from there.
struct WorkingDirectory {
  explicit WorkingDirectory(const fs::path& to) : before(fs::current_path()) { fs::current_path(to); }
  ~WorkingDirectory() { fs::current_path(before); }
  fs::path before;
};

bool is_to_be_refused(const Entry& entry) {
  const std::string name = entry.file.filename().string();
  return entry.format.starts_with("nori") || name.starts_with("invalid-") || name == "test-nan.obj";
}

std::size_t triangles(const Scene& scene) {
  std::size_t count = 0;
  for (const TriangleMesh& mesh : scene.meshes) count += mesh.triangles.size();
  return count;
}

std::size_t count(const Diagnostics& diagnostics, Fidelity fidelity) {
  return static_cast<std::size_t>(std::count_if(diagnostics.begin(), diagnostics.end(),
                                                [&](const Diagnostic& d) { return d.fidelity == fidelity; }));
}

void expect_sound(const Scene& scene) {
  for (const TriangleMesh& mesh : scene.meshes)
    for (const auto& triangle : mesh.triangles)
      ASSERT_LT(std::max({triangle[0], triangle[1], triangle[2]}), mesh.positions.size());
  for (const Shape& shape : scene.shapes) {
    ASSERT_LT(shape.mesh.value, scene.meshes.size());
    ASSERT_LT(shape.material.value, scene.materials.size());
  }
}

// What differs after a round trip through the scene's own format.
std::string round_trip(const Entry& entry, const Scene& scene, Diagnostics& written) {
  const test::TemporaryDirectory folder;
  const bool mitsuba = entry.format.starts_with("mitsuba");
  const fs::path out = folder / (mitsuba ? "out.xml" : "out.pbrt");
  written = export_scene(scene, out);
  return test::difference(scene, import_scene(out).scene);
}

TEST(CorpusImport, EverySceneOfIt) {
  if (!fs::exists(test::corpus() / "INDEX.tsv"))
    GTEST_SKIP() << "no corpus: set VITRAIL_CORPUS to its folder";
  fmt::print("{:<70} {:>9} {:>5} {:>4} {:>4} {:>5}  {}\n", "scene", "triangles", "mats", "tex", "appr",
             "drop", "written in its own format and read again");
  std::size_t imported_scenes = 0, equal = 0, tried = 0;
  for (const Entry& entry : index()) {
    const fs::path file = fs::absolute(test::corpus() / entry.file);
    SCOPED_TRACE(file.string());
    const WorkingDirectory directory(file.parent_path().parent_path());
    try {
      const ImportedScene imported =
          import_scene(file, MeshMemory{}, {}, {.definitions = {}, .replace_missing = entry.lacks_files});
      EXPECT_FALSE(is_to_be_refused(entry));
      expect_sound(imported.scene);
      ++imported_scenes;
      std::string trip = "";
      const bool scene_format = entry.format.starts_with("pbrt") || entry.format.starts_with("mitsuba");
      if (scene_format) {
        Diagnostics written;
        trip = round_trip(entry, imported.scene, written);
        ++tried;
        equal += trip.empty();
        EXPECT_TRUE(trip.empty() || !written.empty()) << trip;
        trip = trip.empty()
                   ? "equal"
                   : fmt::format("{} (reported: {})", trip, written.empty() ? "" : written[0].message);
      }
      fmt::print("{:<70} {:>9} {:>5} {:>4} {:>4} {:>5}  {}\n", entry.file.string(), triangles(imported.scene),
                 imported.scene.materials.size(), imported.scene.textures.size(),
                 count(imported.diagnostics, Fidelity::approximated),
                 count(imported.diagnostics, Fidelity::dropped), trip);
    } catch (const Error& error) {
      EXPECT_TRUE(is_to_be_refused(entry)) << to_string(error.location) << ": " << error.what();
      EXPECT_FALSE(error.location.file.empty()) << error.what();
      fmt::print("{:<70} refused: {}: {}\n", entry.file.string(), to_string(error.location), error.what());
    }
  }
  fmt::print("{} scenes imported; of {} written in their own format, {} come back equal\n", imported_scenes,
             tried, equal);
}

}  // namespace
}  // namespace vitrail::corpus_import_test
