// SPDX-License-Identifier: Apache-2.0
#include "farm/run/work_words.h"

#include <fmt/format.h>

#include <algorithm>

#include "farm/plan/about.h"
#include "farm/plan/job_manifest.h"
#include "farm/plan/rounds.h"
#include "farm/plan/scene_parts.h"
#include "film/picture_fields.h"

namespace vitrail {

namespace {

// "16", "64 at most, adaptive, until 1 jnd".
std::string words(const Goal& goal, double time_limit_s) {
  std::string text = fmt::format("{}{}{}", goal.samples, goal.target || time_limit_s > 0 ? " at most" : "",
                                 goal.adaptive ? ", adaptive" : "");
  if (goal.target)
    text += fmt::format(", until {} {}", goal.target->value, goal.target->just_noticeable ? "jnd" : "relMSE");
  if (time_limit_s > 0) text += fmt::format(", in {} s", time_limit_s);
  return text;
}

}  // namespace

WorkWords words_of_work(const FilmKey& key, const FilmSettings& film, std::string about) {
  WorkWords work{key.scene_hash, std::move(about), {}};
  const std::vector<PictureField> fields = picture_fields(key, film);
  for (std::size_t i = 1; i < fields.size(); ++i)  // the first is the scene
    work.fields.emplace_back(fields[i].name, fields[i].value);
  work.fields.emplace_back("seed", std::to_string(key.seed));
  return work;
}

WorkWords words_of_work(const RenderOptions& options, const Manifest& bundle) {
  const Manifest m = job_manifest(options, bundle).manifest;
  WorkWords work = words_of_work(key_of(m, options.picture), m.film, about(m, options));
  work.fields.emplace_back("samples a pixel",
                           words(goal_of(options, m.settings), options.resources.time_limit_s));
  return work;
}

std::string differences(const WorkWords& held, const WorkWords& asked) {
  std::string text;
  if (held.scene_hash != asked.scene_hash) text = differences_of_scenes(held.about, asked.about);
  for (const auto& [name, wanted] : asked.fields) {
    const auto found = std::ranges::find(held.fields, name, &std::pair<std::string, std::string>::first);
    const std::string has = found == held.fields.end() ? "not told" : found->second;
    if (has != wanted)
      text += fmt::format("{}{}: {}, this command has {}", text.empty() ? "" : "; ", name, has, wanted);
  }
  return text;
}

}  // namespace vitrail
