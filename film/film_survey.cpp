// SPDX-License-Identifier: Apache-2.0
#include "film/film_survey.h"

#include <algorithm>

#include "film/cryptomatte.h"
#include "film/film_planes.h"

namespace vitrail {

void add_rows(FilmSurvey& survey, const Film& rows) {
  for (std::uint32_t p = 0; p < rows.pixels(); ++p) {
    const std::uint64_t samples = rows.samples(p);
    survey.samples += samples;
    survey.most_samples = std::max(survey.most_samples, samples);
    survey.least_samples = std::min(survey.least_samples, samples);
  }
  for (std::size_t i = 0; i < layer_count; ++i) {
    const auto layer = static_cast<Layer>(i);
    if (!rows.layers().has(layer) || !kind_of(layer).is_matte) continue;
    FilmSurvey::Mattes& mattes = survey.mattes[i];
    for (std::uint32_t p = 0; p < rows.pixels(); ++p) {
      const MattePixel& pixel = rows.matte(p, layer);
      mattes.most = std::max(mattes.most, things_of(pixel));
      mattes.covered += static_cast<double>(pixel.covered);
      for (const std::int64_t sum : pixel.sums) mattes.kept += static_cast<double>(sum);
    }
  }
  if (!(rows.key().clamp > 0)) return;
  const std::size_t pixels = rows.pixels();
  for (const WideSum& y : rows.sums().subspan(y_planes * pixels, sample_groups * pixels)) survey.light += y;
}

FilmSurvey survey_of(const Film& film) {
  FilmSurvey survey;
  add_rows(survey, film);
  survey.hash = film.hash();
  return survey;
}

double clamped_share(const FilmSurvey& survey, const Film& rows) {
  if (!(rows.key().clamp > 0)) return 0;
  WideSum all = rows.sums().back();
  const double taken = static_cast<double>(value_of(all));
  all += survey.light;
  return taken == 0 ? 0 : taken / static_cast<double>(value_of(all));
}

double share_without_matte(const FilmSurvey& survey, Layer layer) {
  const FilmSurvey::Mattes& mattes = survey.mattes[static_cast<std::size_t>(layer)];
  return mattes.covered > 0 ? (mattes.covered - mattes.kept) / mattes.covered : 0;
}

}  // namespace vitrail
