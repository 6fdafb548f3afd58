// SPDX-License-Identifier: Apache-2.0
#include "cli/check_conversion.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <fstream>

#include "cli/run_program.h"
#include "scene/diagnostics.h"

namespace vitrail {

namespace {

namespace fs = std::filesystem;

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "vitrail-check-XXXXXX").string();
    if (!::mkdtemp(name.data())) throw MachineError("cannot make " + name + ": " + std::strerror(errno));
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::string file(const char* name) const { return (path_ / name).string(); }

 private:
  fs::path path_;
};

}  // namespace

void require_checkable(const fs::path& out) {
  const std::string format = out.extension().string();
  if (format == ".pov")
    throw UsageError("--check reads the scene that was written, and POV-Ray's is not read");
  if (format == ".obj" || format == ".ply")
    throw UsageError("--check compares pictures, and " + format.substr(1) + " has no camera");
}

nlohmann::ordered_json compare_pictures(const fs::path& in, const std::vector<std::string>& options,
                                        const fs::path& out, const FilmSettings& film) {
  constexpr double longer_side = 64;
  const double scale = std::clamp(longer_side / std::max(film.width, film.height), 0.001, 1.0);
  const TemporaryFolder folder;
  const auto render = [&](const fs::path& scene, const std::string& to, const char* seed,
                          std::vector<std::string> words) {
    words.insert(words.end(), {scene.string(), "-o", to, "--spp", "32", "--scale", fmt::format("{}", scale),
                               "--seed", seed, "--aov", "none", "--quiet"});
    run_program("vitrail-render", words);
  };
  const std::string before = folder.file("before.film"), after = folder.file("after.film");
  render(in, before, "1", options);
  render(out, after, "2", {});
  const std::string said = folder.file("comparison.json");
  run_program("vitrail-compare", {after, before, "--metric", "ztest", "--worst", "0", "--json"}, nullptr,
              said);
  return nlohmann::ordered_json::parse(std::ifstream(said));
}

std::string pictures_in_words(const nlohmann::ordered_json& pictures) {
  constexpr double two_sided_95 = 1.96;
  return fmt::format("{}: luminance {:+.2f} % ± {:.2f} %, {:.2f} % of the pixels differ by more than noise",
                     pictures.at("passed").get<bool>() ? "looks the same" : "looks different",
                     100 * (pictures.at("luminance_ratio").get<double>() - 1),
                     100 * two_sided_95 * pictures.at("luminance_ratio_error").get<double>(),
                     100 * pictures.at("value").get<double>());
}

}  // namespace vitrail
