// SPDX-License-Identifier: Apache-2.0
#include "cli/convert/check_conversion.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <optional>

#include "cli/common/run_program.h"
#include "scene/system/diagnostics.h"
#include "scene/system/temporary_folder.h"

namespace vitrail {

namespace {

namespace fs = std::filesystem;

constexpr double two_sided_95 = 1.96;
// Errors of the mean (95 %): beyond the first, more samples are worth their time; beyond the second nothing
// is seen.
constexpr double wanted_error = 0.02, blind_error = 0.1;
constexpr std::array sample_counts{32, 256};

// Nothing where the reference is black.
std::optional<double> number(const nlohmann::ordered_json& pictures, const char* key) {
  const auto& value = pictures.at(key);
  return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

double error_of(const nlohmann::ordered_json& pictures) {
  return two_sided_95 * number(pictures, "luminance_ratio_error").value_or(0);
}

}  // namespace

void require_checkable(const fs::path& out) {
  const std::string format = out.extension().string();
  if (format == ".obj" || format == ".ply")
    throw UsageError("--check compares pictures, and " + format.substr(1) + " has no camera");
}

nlohmann::ordered_json compare_pictures(const fs::path& in, const std::vector<std::string>& options,
                                        const fs::path& out, const FilmSettings& film) {
  constexpr double longer_side = 64;
  const double scale = std::clamp(longer_side / std::max(film.width, film.height), 0.001, 1.0);
  std::vector<std::string> extent{"--scale", fmt::format("{}", scale)};
  if (out.extension() == ".pov") {  // which does not say how large its picture is
    const auto side = [&](int pixels) { return std::max(1, static_cast<int>(std::lround(scale * pixels))); };
    const int width = side(film.width), height = side(film.height);
    extent = {"--width",  std::to_string(width),
              "--height", std::to_string(height),
              "--crop",   fmt::format("0,{},0,{}", width, height)};
  }
  const TemporaryFolder folder;
  const auto render = [&](const fs::path& scene, const std::string& to, const std::string& spp,
                          const char* seed, std::vector<std::string> words) {
    words.insert(words.end(), extent.begin(), extent.end());
    words.insert(words.end(),
                 {scene.string(), "-o", to, "--spp", spp, "--seed", seed, "--aov", "none", "--quiet"});
    run_program("vitrail-render", words);
  };
  nlohmann::ordered_json pictures;
  for (const int count : sample_counts) {
    const std::string spp = std::to_string(count), name = folder.file(spp), before = name + "-before.film",
                      after = name + "-after.film", said = name + ".json";
    render(in, before, spp, "1", options);
    render(out, after, spp, "2", {});
    run_program("vitrail-compare", {after, before, "--metric", "ztest", "--worst", "0", "--json"}, nullptr,
                said);
    pictures = nlohmann::ordered_json::parse(std::ifstream(said));
    pictures["samples"] = count;
    if (error_of(pictures) <= wanted_error) break;
  }
  return pictures;
}

std::string pictures_in_words(const nlohmann::ordered_json& pictures) {
  const double error = error_of(pictures);
  const char* verdict = !pictures.at("passed").get<bool>() ? "looks different"
                        : error > blind_error              ? "is too noisy to tell"
                                                           : "looks the same";
  const std::optional<double> ratio = number(pictures, "luminance_ratio");
  if (!ratio) return fmt::format("{}: the scene shows nothing", verdict);
  return fmt::format("{}: luminance {:+.2f} % ± {:.2f} %, {:.2f} % of the pixels differ by more than noise",
                     verdict, 100 * (*ratio - 1), 100 * error, 100 * pictures.at("value").get<double>());
}

}  // namespace vitrail
