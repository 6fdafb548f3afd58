// SPDX-License-Identifier: Apache-2.0
#include "measure/runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "compare/web_page.h"
#include "film/develop.h"
#include "film/film_progress.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

namespace fs = std::filesystem;
using RunJson = nlohmann::json;

// FNV-1a of 64 bits: names files after what is in them; the whole key stands in the file.
std::string short_name(const std::string& key) {
  std::uint64_t hash = 0xcbf29ce484222325;
  for (const char c : key) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3;
  return fmt::format("{:016x}", hash);
}

// Empty where the file is missing or no JSON: it is then made again.
RunJson read_json(const fs::path& file) {
  std::ifstream in(file);
  return in ? RunJson::parse(in, nullptr, false) : RunJson();
}

// Little-endian floats, three a pixel.
void write_pixels(const fs::path& file, const Image& image) {
  static_assert(std::endian::native == std::endian::little);
  write_whole(file,
              {reinterpret_cast<const char*>(image.values.data()), image.values.size() * sizeof(float)});
}

bool read_pixels(const fs::path& file, Image& image) {
  std::ifstream in(file, std::ios::binary);
  const auto bytes = static_cast<std::streamsize>(image.values.size() * sizeof(float));
  return in && in.read(reinterpret_cast<char*>(image.values.data()), bytes) && in.gcount() == bytes;
}

std::uint64_t bytes_of(const fs::path& folder) {
  std::uint64_t sum = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) sum += entry.file_size();
  return sum;
}

}  // namespace

Runs::Runs(fs::path scene, fs::path folder, int width, Execute execute)
    : scene_(std::move(scene)), folder_(std::move(folder)), width_(width), execute_(std::move(execute)) {
  for (const char* part : {"bundles", "runs"}) fs::create_directories(folder_ / part);
}

fs::path Runs::bundle(const std::vector<std::string>& partition) {
  if (fs::exists(scene_ / "manifest.json")) {
    if (!partition.empty())
      throw Error("a bundle cannot be cut or decimated again: measure the scene it was made of",
                  {scene_.string()});
    return scene_;
  }
  const std::string key = fmt::format("{}", fmt::join(partition, " "));
  fs::path made = folder_ / "bundles" / (short_name(key) + ".vit");
  const fs::path manifest = made / "manifest.json";
  std::error_code none;
  const auto made_at = fs::last_write_time(manifest, none);
  if (!none && made_at > fs::last_write_time(scene_)) return made;
  std::vector<std::string> arguments{scene_.string(), "-o", made.string(), "--quiet", "--force", "--no-sync"};
  arguments.insert(arguments.end(), partition.begin(), partition.end());
  execute_("vitrail-partition", arguments, {});
  return made;
}

std::string Runs::key(const RunRequest& r) {
  std::error_code none;
  const bool is_bundle = fs::exists(scene_ / "manifest.json");
  const fs::path changes = is_bundle ? scene_ / "manifest.json" : scene_;
  const auto at = fs::last_write_time(changes, none).time_since_epoch().count();
  return fmt::format("{} of {} bytes at {}; partition {}; render {}; width {}; spp {}; seed {}",
                     fs::absolute(scene_).string(), fs::file_size(changes), at, fmt::join(r.partition, " "),
                     fmt::join(r.render, " "), width_, r.spp, r.seed);
}

fs::path Runs::record(const RunRequest& r) { return folder_ / "runs" / (short_name(key(r)) + ".json"); }

RunResult Runs::operator()(const RunRequest& request) {
  const fs::path file = record(request), pixels = fs::path(file).replace_extension(".rgb"),
                 profile = fs::path(file).replace_extension(".profile");
  RunJson json = read_json(file);
  RunResult result;
  const auto take = [&] {
    const RunJson& stats = json["stats"];
    result.cpu_s = stats.value("cpu_s", 0.0);
    result.wall_s = stats.value("wall_s", 0.0);
    result.rays =
        stats.value("rays_camera", 0.0) + stats.value("rays_indirect", 0.0) + stats.value("rays_shadow", 0.0);
    result.peak_memory_bytes = stats.value("peak_rss_bytes", 0.0);
    result.bundle_bytes = json.value("bundle_bytes", 0.0);
    result.film_hash = stats.value("film_hash", "");
  };
  if (json.is_object() && json.value("key", "") == key(request) &&
      (!request.profile || fs::exists(profile))) {
    result.picture = black_image(json.value("width", 1), json.value("height", 1), 3);
    if (read_pixels(pixels, result.picture)) {
      take();
      return result;
    }
  }
  const fs::path film_file = fs::path(file).replace_extension(".film"),
                 stats_file = fs::path(file).replace_extension(".stats"), made = bundle(request.partition);
  std::vector<std::string> arguments{made.string(),
                                     "-o",
                                     film_file.string(),
                                     "--spp",
                                     std::to_string(request.spp),
                                     "--seed",
                                     std::to_string(request.seed),
                                     "--stats",
                                     stats_file.string(),
                                     "--width",
                                     std::to_string(width_),
                                     "--progress",
                                     "none",
                                     "--quiet",
                                     "--force"};
  arguments.insert(arguments.end(), request.render.begin(), request.render.end());
  if (request.profile) arguments.insert(arguments.end(), {"--profile", profile.string()});
  execute_("vitrail-render", arguments, {});
  result.picture = develop(read_film(film_file, nullptr)).rgb;
  write_pixels(pixels, result.picture);
  json = {{"key", key(request)},
          {"width", result.picture.width},
          {"height", result.picture.height},
          {"bundle_bytes", bytes_of(made)},
          {"stats", read_json(stats_file)}};
  write_whole(file, json.dump(1));
  fs::remove(film_file);
  fs::remove(stats_file);
  take();
  return result;
}

PlannedJob Runs::plan_job(const RunRequest& request, const Farm& farm, double times) {
  const fs::path profile = record(request).replace_extension(".profile"), made = bundle(request.partition);
  const fs::path file =
      folder_ / "runs" /
      (short_name(fmt::format("{}; {} × {}, {} times", key(request), farm.ranks, farm.threads, times)) +
       ".plan");
  const auto known = [&]() -> std::optional<PlannedJob> {
    const RunJson json = read_json(file);
    if (!json.is_object() || !json.contains("plan")) return std::nullopt;
    const RunJson& point = json["plan"].at(0);
    return PlannedJob{point.value("seconds", 0.0), point.value("efficiency", 0.0), point.value("limit", "")};
  };
  if (const auto job = known()) return *job;
  std::vector<std::string> arguments{made.string(),
                                     "--profile",
                                     profile.string(),
                                     "--ranks",
                                     std::to_string(farm.ranks),
                                     "--threads",
                                     std::to_string(farm.threads),
                                     "--times",
                                     fmt::format("{}", times),
                                     "--json"};
  if (const auto memory = std::ranges::find(request.render, "--memory"); memory != request.render.end())
    arguments.insert(arguments.end(), memory, memory + 2);
  execute_("vitrail-plan", arguments, file);
  return known().value_or(PlannedJob{});
}

double Runs::full_size_ratio() {
  const RunJson manifest = read_json(bundle({}) / "manifest.json");
  const double width = manifest.at("film").value("width_px", 1.0);
  return width * width / (static_cast<double>(width_) * width_);
}

bool Runs::scene_is_direct() {
  const RunJson manifest = read_json(bundle({}) / "manifest.json");
  return manifest.is_object() && manifest.at("settings").value("direct_only", false);
}

int Runs::scene_spp() {
  const RunJson manifest = read_json(bundle({}) / "manifest.json");
  return std::max(1, manifest.at("settings").value("samples_per_pixel", 1));
}

}  // namespace vitrail
