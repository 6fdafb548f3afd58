// SPDX-License-Identifier: Apache-2.0
#include "cli/convert/own_picture.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <regex>
#include <sstream>
#include <utility>

#include "cli/common/run_program.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

namespace fs = std::filesystem;

constexpr const char* mitsuba_script =
#include "cli/convert/mitsuba_peer.inc"
    ;

constexpr std::array programs{OwnProgram{".xml", "Mitsuba", "python3"},
                              OwnProgram{".pov", "POV-Ray", "povray"}, OwnProgram{".pbrt", "pbrt", "pbrt"}};

std::string text_of(const std::string& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

OwnPicture run_to_show(const std::vector<std::string>& words, const std::string& picture, SmallPicture size,
                       const TemporaryFolder& folder) {
  const std::string errors = folder.file("errors");
  const ForeignEnd end = run_foreign(words, folder.file("said"), errors);
  if (!end.found) return {{}, words.front() + " is not there", true};
  if (end.status > 128)
    return {{},
            fmt::format("it was ended by signal {} ({})", end.status - 128, ::strsignal(end.status - 128)),
            false};
  if (end.status != 0 || !fs::exists(picture)) return {{}, last_words(errors), false};
  return {{block_luminances(picture, size), {}}, {}, false};
}

// It looks for images in its working directory and in those of +L, not beside the scene.
OwnPicture by_povray(const std::string& program, const fs::path& scene, SmallPicture size,
                     const TemporaryFolder& folder) {
  const std::string picture = folder.file(scene.stem().string() + "-own.exr");
  return run_to_show({program, "+I" + scene.string(), "+L" + scene.parent_path().string(),
                      fmt::format("+W{}", size.width * SmallPicture::block),
                      fmt::format("+H{}", size.height * SmallPicture::block), "-D", "+A0.0", "+AM1", "+R4",
                      "-J", "+FE", "+O" + picture},
                     picture, size, folder);
}

// The scene's text with a film of that size; empty where it does not say how large its film is.
std::string resized(std::string text, SmallPicture size) {
  const auto put = [&](const char* parameter, int pixels) {
    const std::regex pattern(fmt::format(R"x("integer\s+{}"\s*\[?\s*\d+\s*\]?)x", parameter));
    if (!std::regex_search(text, pattern)) return false;
    text = std::regex_replace(text, pattern, fmt::format("\"integer {}\" [ {} ]", parameter, pixels));
    return true;
  };
  const bool is_sized = put("xresolution", size.width * SmallPicture::block) &&
                        put("yresolution", size.height * SmallPicture::block);
  static const std::regex crop(R"x("(float\s+cropwindow|integer\s+pixelbounds)"\s*\[[^\]]*\])x");
  return is_sized ? std::regex_replace(text, crop, "") : "";
}

// A file that is gone whichever way its scope is left.
struct RemovedAtEnd {
  fs::path file;
  explicit RemovedAtEnd(fs::path path) : file(std::move(path)) {}
  RemovedAtEnd(const RemovedAtEnd&) = delete;
  RemovedAtEnd& operator=(const RemovedAtEnd&) = delete;
  ~RemovedAtEnd() {
    std::error_code ignored;
    fs::remove(file, ignored);
  }
};

// Twice, by two seeds, whose difference is the noise.
OwnPicture by_pbrt(const std::string& program, const fs::path& scene, SmallPicture size,
                   const TemporaryFolder& folder) {
  const std::string text = resized(text_of(scene.string()), size);
  if (text.empty()) return {{}, "its main file does not say how large its picture is", false};
  const RemovedAtEnd copy{scene.parent_path() /
                          fmt::format(".{}-{}-compared.pbrt", scene.stem().string(), ::getpid())};
  std::ofstream(copy.file) << text;
  OwnPicture pictures[2];
  for (int seed = 0; seed < 2; ++seed) {
    const std::string picture = folder.file(fmt::format("{}-{}.exr", scene.stem().string(), seed));
    pictures[seed] = run_to_show({program, "--quiet", "--spp", "16", "--seed", std::to_string(seed),
                                  "--outfile", picture, copy.file.string()},
                                 picture, size, folder);
    if (pictures[seed].luminances.means.empty()) break;
  }
  for (const OwnPicture& picture : pictures)
    if (picture.luminances.means.empty()) return picture;
  Luminances& both = pictures[0].luminances;
  const std::vector<double>& other = pictures[1].luminances.means;
  std::vector<double> relative;
  for (std::size_t i = 0; i < other.size(); ++i) {
    const double mean = (both.means[i] + other[i]) / 2;
    if (mean > 0) relative.push_back(std::abs(both.means[i] - other[i]) / 2 / mean);
    both.means[i] = mean;
  }
  // Of two seeds a pixel's own noise is by chance next to nothing: the root mean square of all.
  double squares = 0;
  for (const double r : relative) squares += r * r;
  const double noise = relative.empty() ? 0 : std::sqrt(squares / static_cast<double>(relative.size()));
  for (const double mean : both.means) both.noise.push_back(noise * mean);
  return pictures[0];
}

OwnPicture by_mitsuba(const std::string& python, const fs::path& scene, SmallPicture size,
                      const TemporaryFolder& folder) {
  constexpr int samples = 128;  // for each of eight seeds
  const Answer answer = ask_mitsuba(
      python,
      {scene.string(), "-", std::to_string(size.width), std::to_string(size.height), std::to_string(samples)},
      folder);
  if (answer.json.is_null()) return {{}, answer.said, answer.is_missing};
  const auto& spectral = answer.json.at("variants").back();
  if (!spectral.contains("luminances")) return {{}, spectral.value("said", "nothing was said"), false};
  return {{spectral.at("luminances"), spectral.at("noise")}, {}, false};
}

}  // namespace

const OwnProgram* own_program(const fs::path& scene) {
  const auto found = std::ranges::find(programs, scene.extension().string(), &OwnProgram::extension);
  return found == programs.end() ? nullptr : &*found;
}

OwnPicture own_picture(const fs::path& scene, const std::string& program, SmallPicture size,
                       const TemporaryFolder& folder) {
  const OwnProgram* own = own_program(scene);
  if (!own) return {};
  const std::string named = program.empty() ? own->usual : program;
  const fs::path whole = fs::absolute(scene);
  const std::string format = own->extension;
  return format == ".pov"    ? by_povray(named, whole, size, folder)
         : format == ".pbrt" ? by_pbrt(named, whole, size, folder)
                             : by_mitsuba(named, whole, size, folder);
}

Answer ask_mitsuba(const std::string& python, const std::vector<std::string>& words,
                   const TemporaryFolder& folder) {
  const std::string script = folder.file("peer.py"), said = folder.file("said.json"),
                    errors = folder.file("errors");
  std::ofstream(script) << mitsuba_script;
  std::vector<std::string> all{python, script};
  all.insert(all.end(), words.begin(), words.end());
  const ForeignEnd end = run_foreign(all, said, errors);
  if (!end.found) return {{}, python + " is not there", true};
  auto result = nlohmann::ordered_json::parse(text_of(said), nullptr, false);
  if (end.status != 0 || !result.is_object()) return {{}, last_words(errors), false};
  if (result.contains("missing")) return {{}, result.at("missing"), true};
  return {std::move(result), {}, false};
}

std::string last_words(const std::string& file) {
  std::istringstream lines(text_of(file));
  std::string last, wrong;
  for (std::string line; std::getline(lines, line);) {
    if (line.find_first_not_of(' ') == std::string::npos) continue;
    last = line;
    if (line.find("Error") != std::string::npos) wrong = line;
  }
  if (!wrong.empty()) return wrong;
  return last.empty() ? "nothing was said" : last;
}

}  // namespace vitrail
