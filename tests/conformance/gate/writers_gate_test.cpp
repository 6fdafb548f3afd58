// SPDX-License-Identifier: Apache-2.0
// What writers write, before those who have to read it: Mitsuba 3 itself, and pbrt-v4's grammar. Of the cross
// product of scene_parts.h all pairs of values, a share of them with VITRAIL_GATE_SHARE=i/n, or with
// VITRAIL_GATE=short scenes that show every value.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <set>

#include "importers/import.h"
#include "importers/mitsuba/write/write_mitsuba.h"
#include "importers/pbrt/write/write_pbrt.h"
#include "tests/conformance/gate/cross_product.h"
#include "tests/conformance/gate/gate_report.h"
#include "tests/conformance/gate/mitsuba_sources.h"
#include "tests/conformance/gate/pairs.h"
#include "tests/conformance/gate/pbrt_grammar.h"
#include "tests/conformance/gate/renderings.h"
#include "tests/conformance/gate/scene_parts.h"
#include "tests/support/equal_scenes.h"
#include "tests/support/temporary_directory.h"

namespace vitrail::test::writers_gate_test {
namespace {

using Row = CrossProduct::Row;

bool is_short() {
  const char* form = std::getenv("VITRAIL_GATE");
  return form && std::string_view(form) == "short";
}
// Every n-th row where VITRAIL_GATE_SHARE is "i/n", from the i-th on: n runs make a whole.
std::vector<Row> share_of(const std::vector<Row>& rows) {
  const char* text = std::getenv("VITRAIL_GATE_SHARE");
  if (!text) return rows;
  std::size_t first = 0, step = 0;
  if (std::sscanf(text, "%zu/%zu", &first, &step) != 2 || first >= step)
    throw UsageError(fmt::format("VITRAIL_GATE_SHARE is \"{}\", not i/n with i < n", text));
  std::vector<Row> share;
  for (std::size_t i = first; i < rows.size(); i += step) share.push_back(rows[i]);
  return share;
}
// Of `product`'s rows, those whose names have VITRAIL_GATE_ONLY in them.
std::vector<Row> chosen(const auto& product, const std::vector<Row>& rows) {
  std::vector<Row> some = is_short() ? short_form(rows) : share_of(rows);
  if (const char* words = std::getenv("VITRAIL_GATE_ONLY"))
    std::erase_if(some, [&](const Row& row) { return product.name(row).find(words) == std::string::npos; });
  return some;
}
Sampling sampling() { return is_short() ? Sampling{8, 12} : Sampling{}; }

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "" : "; ") + line;
  return text;
}
std::string joined(const Diagnostics& diagnostics) {
  std::vector<std::string> lines;
  for (const Diagnostic& d : diagnostics) lines.push_back(d.message);
  return joined(lines);
}

std::vector<std::string> lines_of(const std::filesystem::path& file) {
  std::vector<std::string> lines;
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

// Which record of its kind an element was written from, counted from 1 as in the scenes of the cross product:
// the names of records without one end with their index. What gets no name is there but once.
int record_of(const std::string& element) {
  const std::string_view name = "id=\"_unnamed_";
  const std::size_t start = element.find(name);
  if (start == std::string::npos) return 1;
  return std::stoi(element.substr(element.find('_', start + name.size()) + 1)) + 1;
}

// Reads what was written; "" where nothing of it is inexact, and where it is the same scene, or looks the
// same.
// What the writer said of a record the reader may say, too.
std::string read_again(const std::filesystem::path& file, const Scene* exact,
                       const Diagnostics& written = {}) {
  const ImportedScene again = import_scene(file);
  const std::vector<std::string> lines = lines_of(file);
  Diagnostics more = again.diagnostics;
  std::erase_if(more, [&](const Diagnostic& d) {
    if (d.item.line < 1) return false;
    const int record = record_of(lines.at(static_cast<std::size_t>(d.item.line - 1)));
    return std::ranges::any_of(
        written, [&](const Diagnostic& w) { return w.kind == d.kind && w.item.line == record; });
  });
  // Of how hair on a mesh is shown, whatever the file says.
  std::erase_if(more, [](const Diagnostic& d) { return d.message.starts_with("hair on what is no round"); });
  if (!more.empty()) return "not read exactly: " + joined(more);
  const std::string unequal = exact ? difference(*exact, again.scene) : "";
  if (unequal.empty()) return "";
  const std::string seen =
      difference_of_means(rendered(*exact, sampling()), rendered(again.scene, sampling()));
  return seen.empty() ? "" : fmt::format("read back with another {}, and seen: {}", unequal, seen);
}

TEST(WritersGate, EveryTwoValuesStandInOneRow) {
  const std::vector<std::size_t> sizes{7, 3, 5, 1, 4};
  const auto rows = rows_of_all_pairs(sizes);
  EXPECT_LE(rows.size(), 50u);
  for (std::size_t i = 0; i < sizes.size(); ++i)
    for (std::size_t j = i + 1; j < sizes.size(); ++j) {
      std::set<std::pair<std::size_t, std::size_t>> pairs;
      for (const Row& row : rows) pairs.insert({row[i], row[j]});
      EXPECT_EQ(pairs.size(), sizes[i] * sizes[j]);
    }
  EXPECT_LE(rows_of_all_values(rows).size(), 19u);  // 20 values, two of them at least in the first row
}

TEST(WritersGate, PbrtTakesWhatIsWritten) {
  const TemporaryDirectory folder;
  const CrossProduct product(folder.path());
  GateReport report("pbrt"), round("pbrt, read again");
  for (const Row& row : chosen(product, product.rows())) {
    const Scene scene = product.scene(row);
    write_pbrt(scene, folder / "scene.pbrt");
    report.check(product.name(row), joined(pbrt_complaints(folder / "scene.pbrt")));
    round.check(product.name(row), read_again(folder / "scene.pbrt", nullptr));
  }
}

TEST(WritersGate, WhatIsWrittenForPbrtExactlyIsReadBack) {
  const TemporaryDirectory folder;
  const CrossProduct product(folder.path());
  GateReport round("pbrt, exactly");
  for (const Row& row : chosen(product, product.rows_that([&](const Scene& scene) {
         return write_pbrt(scene, folder / "scene.pbrt").empty();
       }))) {
    const Scene scene = product.scene(row);
    if (write_pbrt(scene, folder / "scene.pbrt").empty() && renders_exactly(scene))
      round.check(product.name(row), read_again(folder / "scene.pbrt", &scene));
  }
}

TEST(WritersGate, MitsubaTakesWhatIsWritten) {
  if (python_with_mitsuba().empty()) GTEST_SKIP() << "skipped: Mitsuba 3 is not installed";
  const TemporaryDirectory folder;
  const CrossProduct product(folder.path());
  const std::vector<Row> rows = chosen(product, product.rows());
  std::vector<std::filesystem::path> files;
  std::vector<Diagnostics> written;
  for (const Row& row : rows) {
    files.push_back(folder / fmt::format("{:03}.xml", files.size()));
    written.push_back(write_mitsuba(product.scene(row), files.back()));
  }
  const std::vector<MitsubaAnswer> answers = rendered_by_mitsuba(files, {1, 0}, folder.path());
  GateReport load("Mitsuba"), round("Mitsuba, read again");
  for (std::size_t n = 0; n < rows.size(); ++n) {
    load.check(product.name(rows[n]), answers[n].refused + joined(answers[n].warnings));
    round.check(product.name(rows[n]), read_again(files[n], nullptr, written[n]));
  }
}

TEST(WritersGate, MitsubaShowsWhatIsWrittenExactly) {
  if (python_with_mitsuba().empty()) GTEST_SKIP() << "skipped: Mitsuba 3 is not installed";
  const TemporaryDirectory folder;
  const CrossProduct product(folder.path());
  std::vector<Row> rows;
  std::vector<std::filesystem::path> files;
  for (const Row& row : chosen(product, product.rows_that([&](const Scene& scene) {
         return renders_exactly(scene) && write_mitsuba(scene, folder / "plain.xml").empty();
       }))) {
    const std::filesystem::path file = folder / fmt::format("{:03}.xml", files.size());
    const Scene scene = product.scene(row);
    if (!write_mitsuba(scene, file).empty() || !renders_exactly(scene)) continue;
    rows.push_back(row);
    files.push_back(file);
  }
  const std::vector<MitsubaAnswer> answers = rendered_by_mitsuba(files, sampling(), folder.path());
  GateReport show("Mitsuba, shown");
  for (std::size_t n = 0; n < rows.size(); ++n) {
    const Scene scene = product.scene(rows[n]);
    const std::string refused = answers[n].refused + joined(answers[n].warnings);
    show.check(product.name(rows[n]), refused.empty()
                                          ? difference_of_means(rendered(scene, sampling()), answers[n].means)
                                          : refused);
  }
}

// Mitsuba's own files: read as Mitsuba reads them, and written so that Mitsuba shows the same again.
TEST(WritersGate, MitsubaFilesAreReadAsMitsubaReadsThem) {
  if (python_with_mitsuba().empty()) GTEST_SKIP() << "skipped: Mitsuba 3 is not installed";
  const TemporaryDirectory folder;
  write_part_images(folder.path());
  const MitsubaSources sources(folder.path());
  const std::vector<Row> rows = chosen(sources, sources.rows());
  std::vector<std::filesystem::path> files, again;
  std::vector<ImportedScene> scenes;
  std::vector<Diagnostics> written;
  GateReport pbrt("Mitsuba to pbrt");
  for (const Row& row : rows) {
    files.push_back(folder / fmt::format("{:03}.xml", files.size()));
    again.push_back(folder / fmt::format("again{:03}.xml", again.size()));
    sources.write(row, files.back());
    scenes.push_back(import_scene(files.back()));
    written.push_back(write_mitsuba(scenes.back().scene, again.back()));
    write_pbrt(scenes.back().scene, folder / "scene.pbrt");
    pbrt.check(sources.name(row), joined(pbrt_complaints(folder / "scene.pbrt")));
  }
  const std::vector<MitsubaAnswer> first = rendered_by_mitsuba(files, sampling(), folder.path()),
                                   second = rendered_by_mitsuba(again, sampling(), folder.path());
  GateReport read("Mitsuba's files, read"), show("Mitsuba's files, written again");
  for (std::size_t n = 0; n < rows.size(); ++n) {
    const std::string name = sources.name(rows[n]);
    if (!first[n].refused.empty()) {
      ADD_FAILURE() << "Mitsuba refuses the file itself: " << name << "\n    " << first[n].refused;
      continue;
    }
    const std::string refused = second[n].refused + joined(second[n].warnings);
    const bool exact = scenes[n].diagnostics.empty();
    if (exact && renders_exactly(scenes[n].scene))
      read.check(name, difference_of_means(rendered(scenes[n].scene, sampling()), first[n].means));
    if (!refused.empty() || (exact && written[n].empty()))
      show.check(name, refused.empty() ? difference_of_means(second[n].means, first[n].means) : refused);
  }
}

}  // namespace
}  // namespace vitrail::test::writers_gate_test
