// SPDX-License-Identifier: Apache-2.0
#include "measure/report.h"

#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "compare/error_images.h"
#include "compare/flip.h"
#include "compare/web_page.h"
#include "film/image_io.h"
#include "measure/measure_html.h"
#include "measure/words.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Estimate& e) { return {{"value", e.value}, {"half_width_95", e.half_width}}; }

Json json_of(const MeasuredSetting& s) {
  Json json{{"name", s.name}, {"setting", s.setting}, {"failure", s.failure}};
  if (!s.failure.empty()) return json;
  json.update({{"identical", s.identical},
               {"effect", name_of(s.effect)},
               {"again", s.again},
               {"spp", s.spp},
               {"relmse", json_of(s.error.relmse)},
               {"noise", json_of(s.error.noise)},
               {"bias", json_of(s.error.bias)},
               {"biased", s.error.is_biased()},
               {"luminance_off", json_of(s.error.luminance)},
               {"flip", json_of(s.error.flip)},
               {"flip_of_mean", s.error.flip_of_mean},
               {"delta_e_2000", json_of(s.error.delta_e)},
               {"cpu_s_per_sample", s.sample_s},
               {"cpu_s", s.cpu_s},
               {"wall_s", s.wall_s},
               {"rays", s.rays},
               {"peak_memory_bytes", s.peak_memory_bytes},
               {"bundle_bytes", s.bundle_bytes}});
  if (s.farm.is_known())
    json.update({{"farm_start_s", s.farm.start_s}, {"farm_s_per_sample", s.farm.sample_s}});
  return json;
}

Json json_of(const Recommendation& r) {
  return {{"goal", r.goal},
          {"found", r.found},
          {"name", r.name},
          {"spp", r.spp},
          {"render", r.render},
          {"partition", r.partition},
          {"relmse", r.error},
          {"relmse_half_width_95", r.error_within},
          {"rendered_spp", r.rendered_spp},
          {"luminance_off", json_of(r.luminance)},
          {"most_bias", r.most_bias},
          {"cpu_s", r.cpu_s},
          {"wall_s", r.wall_s},
          {"farm_s", r.farm_s},
          {"words", advice(r)}};
}

Json json_of(const MeasureOptions& options, const Measurement& m) {
  Json json{{"scene", options.scene.string()},
            {"width", m.reference.mean.width},
            {"height", m.reference.mean.height},
            {"seeds", options.seeds},
            {"full_size", m.full_size},
            {"scene_spp", m.scene_spp},
            {"parallelism", m.parallelism},
            {"farm_ranks", m.farm.ranks},
            {"farm_threads", m.farm.threads},
            {"reference_spp", m.reference_spp},
            {"reference_relmse", m.reference.relmse},
            {"noise_slope", m.law.slope},
            {"start_cpu_s", m.law.start_s}};
  for (const Axis& axis : m.axes) {
    Json labels = Json::array();
    for (const Choice& choice : axis.choices) labels.push_back(choice.label);
    json["axes"].push_back(
        {{"name", axis.name}, {"about", axis.about}, {"effect", name_of(axis.effect)}, {"choices", labels}});
  }
  const std::vector<bool> on_it = front(m);
  for (std::size_t i = 0; i < m.settings.size(); ++i) {
    json["settings"].push_back(json_of(m.settings[i]));
    json["settings"].back()["front"] = static_cast<bool>(on_it[i]);
    json["settings"].back()["words"] = i == 0 ? "" : what_it_buys(m, m.settings[i]);
  }
  for (const MeasuredSetting& s : m.samples) json["samples"].push_back(json_of(s));
  json["findings"] = findings(m);
  for (const Recommendation& r : m.recommendations) json["recommendations"].push_back(json_of(r));
  return json;
}

// A PNG within an address; its file is for a moment among the runs.
std::string png(const std::filesystem::path& folder, const Image& image, double exposure = 1) {
  Picture picture;
  picture.rgb = image;
  for (float& v : picture.rgb.values) v = static_cast<float>(static_cast<double>(v) * exposure);
  const std::filesystem::path file = folder / "runs" / "thumbnail.png";
  write_picture(file, picture);
  std::ifstream in(file, std::ios::binary);
  const std::vector<std::uint8_t> bytes(std::istreambuf_iterator<char>(in), {});
  std::filesystem::remove(file);
  return "data:image/png;base64," + base64(bytes);
}

}  // namespace

void require_own_page(const std::filesystem::path& folder) {
  const std::filesystem::path page = folder / "index.html";
  if (!std::filesystem::exists(page) || std::filesystem::exists(folder / "measure.json")) return;
  throw Error(
      "this file exists, and without a measure.json beside it measure did not make it: name another folder",
      {page.string()});
}

void write_report(const MeasureOptions& options, const Measurement& m) {
  Json json = json_of(options, m);
  const auto dump = [](const Json& j, int indent) {
    return j.dump(indent, ' ', false, Json::error_handler_t::replace);
  };
  write_whole(options.folder / "measure.json", dump(json, 1) + "\n");

  const double exposure = 1 / m.reference.white;
  json["reference_picture"] = png(options.folder, m.reference.mean, exposure);
  for (std::size_t i = 0; i < m.settings.size(); ++i) {
    const MeasuredSetting& s = m.settings[i];
    if (!s.failure.empty() || s.identical) continue;
    const Image& r = m.reference.mean;
    const auto map = [&](const Image& picture) {
      return png(options.folder, heatmap(hdr_flip(picture, r), r.width, r.height, 1, Palette::magma));
    };
    json["settings"][i]["pictures"] = {png(options.folder, s.first, exposure), map(s.first),
                                       png(options.folder, s.mean, exposure), map(s.mean)};
  }
  write_whole(options.folder / "index.html", page_with_data(measure_html, dump(json, -1)));
}

}  // namespace vitrail
