// SPDX-License-Identifier: Apache-2.0
// Some packages of CGAL are under GPL-3.0-or-later. Which folders include them, which libraries and programs
// contain them, and that these say so. THIRD_PARTY.md names whatever else is not ours.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "cli/help/licence.h"
#include "cli/help/verbs.h"
#include "tests/support/command.h"
#include "tests/support/paths.h"

namespace vitrail::test::licences_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using Names = std::set<std::string>;

// In two parts: this line states nothing of this file.
const std::string tag = std::string("SPDX-License") + "-Identifier: ";

constexpr const char* folders[] = {"scene",       "glazing", "images",  "importers", "bundle",
                                   "partitioner", "film",    "denoise", "tracer",    "farm",
                                   "compare",     "measure", "cli",     "python"};

std::string text_of(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

// What is compiled into programs, libraries and the Python package; tests are not distributed.
std::vector<fs::path> distributed_sources() {
  std::vector<fs::path> files;
  for (const char* folder : folders)
    for (const auto& entry : fs::recursive_directory_iterator(project_file(folder))) {
      const fs::path relative = entry.path().lexically_relative(source_dir());
      const std::string extension = entry.path().extension().string();
      if (relative.string().starts_with("python/tests/")) continue;
      if (extension == ".h" || extension == ".cpp" || extension == ".inl" || extension == ".txt")
        files.push_back(relative);
    }
  files.emplace_back("cmake/precompiled.h");
  return files;
}

// "CGAL/Surface_mesh.h" of `#include <CGAL/Surface_mesh.h>`.
std::vector<std::string> foreign_includes(const std::string& text) {
  static const std::regex include(R"(^[ \t]*#[ \t]*include[ \t]*<([^>]+)>)", std::regex::multiline);
  std::vector<std::string> headers;
  for (std::sregex_iterator at(text.begin(), text.end(), include), end; at != end; ++at)
    headers.push_back((*at)[1]);
  return headers;
}

bool includes_cgal(const fs::path& source) {
  return std::ranges::any_of(foreign_includes(text_of(project_file(source.string()))),
                             [](const std::string& header) { return header.starts_with("CGAL/"); });
}

// Where the compiler finds CGAL: the folders that it is given, and its own.
std::vector<fs::path> include_folders() {
  std::vector<fs::path> found{"/usr/include", "/usr/local/include"};
  std::ifstream in(fs::path(bin_dir()).parent_path() / "compile_commands.json");
  static const std::regex folder(R"(-(?:I|isystem) ?(\S+))");
  for (const auto& entry : nlohmann::json::parse(in)) {
    const std::string command = entry.at("command");
    if (command.find("importers/solids/") == std::string::npos) continue;
    for (std::sregex_iterator at(command.begin(), command.end(), folder), end; at != end; ++at)
      found.emplace_back((*at)[1].str());
  }
  return found;
}

// The licences of the header, and of all of CGAL's that it includes, whatever their conditions say.
class CgalHeaders {
 public:
  CgalHeaders() : folders_(include_folders()) {}

  void collect(const std::string& header, std::map<std::string, std::string>& licences) const {
    if (licences.contains(header)) return;
    const auto folder =
        std::ranges::find_if(folders_, [&](const fs::path& f) { return fs::exists(f / header); });
    if (folder == folders_.end()) return;  // of a package that is not installed
    const std::string text = text_of(*folder / header);
    static const std::regex spdx(tag + "([^\n]*[^\n ])");
    std::smatch found;
    licences[header] = std::regex_search(text, found, spdx) ? found[1].str() : "";
    for (const std::string& inner : foreign_includes(text))
      if (inner.starts_with("CGAL/")) collect(inner, licences);
  }

 private:
  std::vector<fs::path> folders_;
};

TEST(Licences, CgalIsIncludedByTwoFoldersAndByNoHeader) {
  int seen = 0;
  for (const fs::path& file : distributed_sources()) {
    if (!includes_cgal(file)) continue;
    ++seen;
    const std::string folder = file.parent_path().string();
    EXPECT_TRUE(folder == "importers/solids" || folder == "partitioner/meshes") << file;
    EXPECT_EQ(file.extension(), ".cpp") << file << ": what includes it contains CGAL too";
  }
  EXPECT_GT(seen, 3);
}

TEST(Licences, OfCgalAreThoseThatWeSay) {
  const CgalHeaders cgal;
  std::map<std::string, std::string> licences;
  for (const fs::path& file : distributed_sources())
    for (const std::string& header : foreign_includes(text_of(project_file(file.string()))))
      if (header.starts_with("CGAL/")) cgal.collect(header, licences);
  int under_gpl = 0;
  for (const auto& [header, licence] : licences) {
    if (licence.empty()) continue;  // macros that CGAL's configuration or its users write
    EXPECT_TRUE(licence.find("GPL-3.0-or-later") != std::string::npos || licence == "BSL-1.0")
        << header << " is under " << licence;
    under_gpl += licence.starts_with("GPL-3.0-or-later") || licence.starts_with("( GPL-3.0-or-later");
  }
  EXPECT_GT(under_gpl, 50);
}

// Which libraries each of the installed libraries needs, as CMake exports it.
std::map<std::string, Names> library_needs() {
  std::map<std::string, Names> needs;
  const fs::path exported = fs::path(bin_dir()).parent_path() / "CMakeFiles/Export";
  static const std::regex entry(
      R"rx(set_target_properties\(vitrail::(\w+) PROPERTIES\n((?:  [^\n]*\n)*)\))rx"),
      needed(R"(vitrail::(\w+))");
  for (const auto& file : fs::recursive_directory_iterator(exported)) {
    if (file.path().filename() != "vitrailTargets.cmake") continue;
    const std::string text = text_of(file.path());
    for (std::sregex_iterator at(text.begin(), text.end(), entry), end; at != end; ++at) {
      const std::string properties = (*at)[2];
      Names& own = needs[(*at)[1]];
      for (std::sregex_iterator n(properties.begin(), properties.end(), needed); n != end; ++n)
        own.insert((*n)[1]);
    }
  }
  return needs;
}

bool needs_cgal(const std::string& library, const std::map<std::string, Names>& needs) {
  if (library == "solids" || library == "meshes") return true;
  const auto found = needs.find(library);
  return found != needs.end() &&
         std::ranges::any_of(found->second, [&](const std::string& n) { return needs_cgal(n, needs); });
}

// Whoever links one of these distributes the program under GPL-3.0-or-later.
TEST(Licences, OfLibrariesThatBringCgalAreWrittenDown) {
  const std::map<std::string, Names> needs = library_needs();
  ASSERT_GT(needs.size(), 30u) << "no file of exported libraries";
  Names with_cgal;
  for (const auto& [library, unused] : needs)
    if (needs_cgal(library, needs)) with_cgal.insert(library);
  EXPECT_EQ(with_cgal, (Names{"importers", "meshes", "povray", "solids"}));
  const std::string page = text_of(project_file("docs/how-to/link-the-libraries.md"));
  for (const std::string& library : with_cgal) EXPECT_THAT(page, HasSubstr("`vitrail::" + library + "`"));
}

TEST(Licences, ThePythonPackageLinksNoCgal) {
  const std::map<std::string, Names> needs = library_needs();
  const std::string text = text_of(project_file("python/CMakeLists.txt"));
  static const std::regex library(R"(vitrail::(\w+))");
  int seen = 0;
  for (std::sregex_iterator at(text.begin(), text.end(), library), end; at != end; ++at, ++seen)
    EXPECT_FALSE(needs_cgal((*at)[1], needs)) << (*at)[1];
  EXPECT_GT(seen, 2);
}

// By the mangled name of its namespace.
bool has_symbols_of_cgal(const fs::path& binary) {
  const CommandResult symbols = run(fmt::format("nm '{}' 2>/dev/null", binary.string()));
  EXPECT_EQ(symbols.status, 0) << binary;
  EXPECT_TRUE(symbols.output.find("_Z") != std::string::npos) << binary << " has no symbols to look at";
  return symbols.output.find("4CGAL") != std::string::npos;
}

TEST(Licences, LibrariesWithSymbolsOfCgalAreTwo) {
  Names with_cgal;
  int seen = 0;
  const fs::path build = fs::path(bin_dir()).parent_path();
  for (const char* folder : folders) {
    if (!fs::exists(build / folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(build / folder))
      if (entry.path().extension() == ".a") {
        ++seen;
        if (has_symbols_of_cgal(entry.path())) with_cgal.insert(entry.path().filename().string());
      }
  }
  EXPECT_GT(seen, 30);
  EXPECT_EQ(with_cgal, (Names{"libvitrail_meshes.a", "libvitrail_solids.a"}));
}

TEST(Licences, ProgramsWithSymbolsOfCgalSayGpl) {
  const auto expect = [](const fs::path& program, std::string_view verb) {
    const bool with_cgal = has_symbols_of_cgal(program);
    EXPECT_EQ(licence_of(verb), with_cgal ? "GPL-3.0-or-later" : "Apache-2.0") << program;
    const std::string said = run(fmt::format("'{}' --version", program.string())).output;
    EXPECT_THAT(said, HasSubstr(with_cgal ? ": GPL-3.0-or-later, " : ": Apache-2.0")) << program;
  };
  expect(fs::path(bin_dir()) / "vitrail", "");
  for (const Verb& verb : verbs())
    expect(fs::path(bin_dir()) / ("vitrail-" + std::string(verb.name)), verb.name);
  for (const char* module : {"vitrail-assimp.so", "vitrail-openimageio.so"})
    EXPECT_FALSE(has_symbols_of_cgal(fs::path(bin_dir()) / module)) << module;
  EXPECT_EQ(licence_of("render"), "Apache-2.0");
}

// What stands before the first slash, or the header, and how THIRD_PARTY.md calls it. Empty: of the system.
const std::map<std::string, std::string>& third_parties() {
  static const std::map<std::string, std::string> names{{"CGAL", "CGAL"},
                                                        {"CLI", "CLI11"},
                                                        {"Imath", "Imath"},
                                                        {"OpenColorIO", "OpenColorIO"},
                                                        {"OpenEXR", "OpenEXR"},
                                                        {"OpenImageIO", "OpenImageIO"},
                                                        {"OpenMesh", "OpenMesh"},
                                                        {"assimp", "assimp"},
                                                        {"embree3", "Embree"},
                                                        {"fast_float", "fast_float"},
                                                        {"fmt", "{fmt}"},
                                                        {"ft2build.h", "FreeType"},
                                                        {"jpeglib.h", "libjpeg-turbo"},
                                                        {"jerror.h", "libjpeg-turbo"},
                                                        {"mpi.h", "Open MPI"},
                                                        {"nanobind", "nanobind"},
                                                        {"nanovdb", "NanoVDB"},
                                                        {"nlohmann", "JSON for Modern C++"},
                                                        {"png.h", "libpng"},
                                                        {"pugixml.hpp", "pugixml"},
                                                        {"sleef.h", "SLEEF"},
                                                        {"tbb", "oneTBB"},
                                                        {"tiny_gltf.h", "tinygltf"},
                                                        {"xxhash.h", "xxHash"},
                                                        {"zlib.h", "zlib"}};
  return names;
}

bool is_of_the_system(const std::string& header) {
  static const Names system{"dlfcn.h",   "fcntl.h", "immintrin.h", "link.h", "malloc.h", "netdb.h",
                            "pthread.h", "sched.h", "spawn.h",     "sys",    "time.h",   "unistd.h"};
  return header.find_first_of("./") == std::string::npos ||
         system.contains(header.substr(0, header.find('/')));
}

TEST(ThirdParty, EveryHeaderThatIsNotOursIsNamed) {
  const std::string page = text_of(project_file("THIRD_PARTY.md"));
  Names seen;
  for (const fs::path& file : distributed_sources())
    for (const std::string& header : foreign_includes(text_of(project_file(file.string())))) {
      if (is_of_the_system(header)) continue;
      // Debian's OpenEXR gives the folder of its headers itself.
      const std::string place = header.starts_with("Imf") ? "OpenEXR" : header.substr(0, header.find('/'));
      const auto party = third_parties().find(place);
      ASSERT_NE(party, third_parties().end()) << file << " includes " << header << ": whose is it?";
      EXPECT_THAT(page, HasSubstr("| " + party->second + " |")) << file << " includes " << header;
      seen.insert(party->second);
    }
  EXPECT_GT(seen.size(), 15u);
}

TEST(ThirdParty, EveryTableOfNumbersIsNamed) {
  const std::string page = text_of(project_file("THIRD_PARTY.md"));
  int seen = 0;
  for (const auto& entry : fs::directory_iterator(project_file("scripts"))) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with("generate_")) continue;
    ++seen;
    EXPECT_THAT(page, HasSubstr("`scripts/" + name + "`"));
  }
  EXPECT_GT(seen, 5);
  int texts = 0;
  for (const fs::path& file : distributed_sources()) {
    if (file.extension() != ".txt" || file.filename() == "CMakeLists.txt") continue;
    ++texts;
    EXPECT_THAT(page, HasSubstr("`" + file.string() + "`"));
    EXPECT_TRUE(text_of(project_file(file.string())).starts_with("# " + tag)) << file;
  }
  EXPECT_GT(texts, 3);
}

// As https://reuse.software asks: LICENSES/ has the text of each licence that a file of the source names.
TEST(Licences, OfFilesHaveTheirTexts) {
  static const std::regex spdx(tag + "([A-Za-z0-9. -]*[A-Za-z0-9])");
  static const std::regex name(R"([A-Za-z]+-[0-9A-Za-z.-]+)");
  Names named;
  for (const fs::path& file : distributed_sources()) {
    const std::string text = text_of(project_file(file.string()));
    std::smatch found;
    if (!std::regex_search(text, found, spdx)) continue;
    const std::string expression = found[1];
    for (std::sregex_iterator at(expression.begin(), expression.end(), name), end; at != end; ++at)
      named.insert(at->str());
  }
  EXPECT_EQ(named, (Names{"Apache-2.0", "BSD-3-Clause"}));
  for (const auto& entry : fs::directory_iterator(project_file("LICENSES")))
    named.insert(entry.path().stem().string());
  const std::string copyright = text_of(project_file("cmake/debian/copyright"));
  for (const std::string& licence : named) {
    EXPECT_TRUE(fs::exists(project_file("LICENSES/" + licence + ".txt"))) << licence;
    EXPECT_THAT(copyright, HasSubstr("\nLicense: " + licence + "\n"));
  }
  // No file of the source is under the licence of programs that contain CGAL: its text stands beside them.
  EXPECT_TRUE(fs::exists(project_file("LICENSE-GPL-3.0-or-later.txt")));
  EXPECT_THAT(copyright, HasSubstr("\nLicense: GPL-3.0-or-later\n"));
}

}  // namespace
}  // namespace vitrail::test::licences_test
