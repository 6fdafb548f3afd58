// SPDX-License-Identifier: Apache-2.0
#include "cli/develop/exposed_films.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "film/cryptomatte.h"
#include "film/film_progress.h"
#include "film/film_seeds.h"
#include "film/picture_memory.h"
#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"
#include "scene/system/say.h"

namespace vitrail {

namespace {

Exposed load(const std::string& file, const DevelopArguments& a, bool in_files) {
  note_input(file);
  FilmProgress progress;
  Exposed e{.file = file};
  if (in_files) {
    e.parts.emplace_back(file, &progress);
    e.film = e.parts[0].rows(0, 1);
  } else {
    e.film = read_film(file, &progress);
  }
  e.seeds = seeds_of(e.film, progress.about);
  e.about = std::move(progress.about);
  e.render_time_s = progress.render_time_s;
  e.samples_per_pixel = progress.samples_per_pixel;
  e.adaptive = progress.adaptive;
  e.complete = progress.complete();
  if (!e.complete && a.strict) throw Error("the film is not finished", {file});
  if (!e.complete && !a.quiet)
    say("vitrail: {}: the film is not finished; pixels may have unequal numbers of samples\n", file);
  return e;
}

// Throws Error where a seed is in both.
void add_seeds(Exposed& sum, const Exposed& film) {
  for (const std::uint64_t seed : film.seeds)
    if (std::ranges::binary_search(sum.seeds, seed))
      throw Error(fmt::format("it has seed {}, as {} has: only films of different seeds are independent",
                              seed, sum.file.string()),
                  {film.file.string()});
  sum.seeds.insert(sum.seeds.end(), film.seeds.begin(), film.seeds.end());
  std::ranges::sort(sum.seeds);
}

std::string difference_of(const Exposed& a, const Exposed& b) {
  return a.parts.empty() ? difference(a.film, b.film) : difference(a.parts[0], b.parts[0]);
}

// `films`: what `more` is a part of.
void merge(Film& film, const Film& more, const std::filesystem::path& films,
           const std::filesystem::path& part) {
  try {
    film.merge(more);
  } catch (const Error& e) {
    throw Error(fmt::format("cannot merge with {}: {}", films.string(), e.what()), {part.string()});
  }
}

// What the render knew of scene and camera.
void put_about(PictureOrigin& origin, const std::string& about) {
  const nlohmann::json json = nlohmann::json::parse(about, nullptr, false);
  if (!json.is_object()) return;
  origin.scene = json.value("scene", "");
  origin.glazing = json.value("glazing", "");
  origin.sampling = json.value("sampling", "");
  const auto matrix = [&](const char* name) {
    std::vector<float> numbers;
    if (const auto found = json.find(name); found != json.end() && found->is_array())
      for (const nlohmann::json& number : *found)
        if (number.is_number()) numbers.push_back(number.get<float>());
    return numbers;
  };
  origin.world_to_camera = matrix("world_to_camera");
  origin.world_to_ndc = matrix("world_to_ndc");
}

// The names of masks, as the render wrote them.
void name_mattes(Picture& picture, const std::string& about) {
  const nlohmann::json json = nlohmann::json::parse(about, nullptr, false);
  if (!json.is_object() || !json.contains("mattes") || !json.at("mattes").is_object()) return;
  for (const LayerKind& kind : layer_kinds)
    for (PictureMattes& mattes : picture.mattes) {
      const auto names = json.at("mattes").find(kind.name);
      if (mattes.layer != kind.channels[0] || names == json.at("mattes").end() || !names->is_array())
        continue;
      std::vector<std::string> list;
      for (const nlohmann::json& name : *names)
        if (name.is_string()) list.push_back(name.get<std::string>());
      mattes.manifest = matte_manifest(list);
    }
}

}  // namespace

Exposed merge_all(const DevelopArguments& a, bool in_files) {
  std::vector<Exposed> films;
  for (const std::string& file : a.films) films.push_back(load(file, a, in_files));
  std::ranges::sort(films, {}, [](const Exposed& film) { return film.seeds.front(); });
  for (const Exposed& film : films)
    if (const std::string what = difference_of(films.front(), film); !what.empty())
      throw Error(fmt::format("cannot merge with {}: {}", films.front().file.string(), what),
                  {film.file.string()});
  Exposed sum = std::move(films.front());
  for (std::size_t i = 1; i < films.size(); ++i) {
    add_seeds(sum, films[i]);
    merge(sum.film, films[i].film, sum.file, films[i].file);
    std::ranges::move(films[i].parts, std::back_inserter(sum.parts));
    sum.render_time_s += films[i].render_time_s;
    sum.samples_per_pixel += films[i].samples_per_pixel;
    sum.adaptive |= films[i].adaptive;
    if (sum.complete && !films[i].complete) sum.complete = false, sum.file = films[i].file;
  }
  return sum;
}

MergedRows::MergedRows(const Exposed& films, int y0, int y1, bool with_sums)
    : films_(films),
      y_(y0),
      end_(y1),
      step_(rows_at_once(films.parts[0].settings(), films.parts[0].key())),
      with_sums_(with_sums) {}

std::optional<Film> MergedRows::next() {
  if (y_ == end_) return std::nullopt;
  const int first = std::exchange(y_, std::min(y_ + step_, end_));
  Film sum = films_.parts[0].rows(first, y_, with_sums_);
  for (const FilmRows& more : std::span(films_.parts).subspan(1))
    merge(sum, more.rows(first, y_, with_sums_), films_.file, more.file());
  return sum;
}

FilmSurvey survey_of(const Exposed& film) {
  if (film.parts.empty()) return survey_of(film.film);
  FilmSurvey survey;
  MergedRows all(film, 0, film.parts[0].height(), film.film.key().clamp > 0);
  while (const std::optional<Film> rows = all.next()) add_rows(survey, *rows);
  survey.hash = hash_of(film.parts);
  return survey;
}

void write_merged(const std::filesystem::path& file, const Exposed& film) {
  if (!film.complete)
    throw Error("a film is made of finished ones, and this is not: render it first", {film.file.string()});
  if (std::filesystem::exists(file))
    throw Error("it is there already, and may hold other work: take another name, or remove it",
                {file.string()});
  FilmKey key = film.film.key();
  key.seed = merged_seed(film.seeds);
  Film merged(film.film.settings(), key, film.film.exponent(), film.film.length_exponent());
  merged.merge(film.film);
  write_film(file, merged,
             {.samples_per_pixel = film.samples_per_pixel,
              .render_time_s = film.render_time_s,
              .about = with_seeds(film.about, film.seeds),
              .adaptive = film.adaptive});
}

void tell_origin(Picture& picture, const Exposed& sum) {
  picture.render_time_s = sum.render_time_s;
  picture.origin.seeds = fmt::format("{}", fmt::join(sum.seeds, ","));
  put_about(picture.origin, sum.about);
  name_mattes(picture, sum.about);
  picture.neighbours = neighbours_of(sum.about);
}

}  // namespace vitrail
