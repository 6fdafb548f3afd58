// SPDX-License-Identifier: Apache-2.0
// vitrail develop: films become an image. Several films of the same scene with different seeds are merged
// exactly.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "cli/main_guard.h"
#include "film/image_io.h"
#include "scene/diagnostics.h"

using namespace vitrail;

namespace {

struct Exposed {
  std::filesystem::path file;
  Film film;
  double render_time_s = 0;
};

Exposed load(const std::string& file) {
  FilmProgress progress;
  Exposed e{file, read_film(file, &progress), 0};
  e.render_time_s = progress.render_time_s;
  if (!progress.complete())
    fmt::print(stderr, "vitrail: {}: the film is not finished; pixels may have unequal numbers of samples\n",
               file);
  return e;
}

// In the order of their seeds, so that the order on the command line does not matter.
Exposed merge_all(const std::vector<std::string>& files) {
  std::vector<Exposed> films;
  for (const std::string& file : files) films.push_back(load(file));
  std::sort(films.begin(), films.end(),
            [](const Exposed& a, const Exposed& b) { return a.film.key().seed < b.film.key().seed; });
  Exposed sum = std::move(films.front());
  for (std::size_t i = 1; i < films.size(); ++i) {
    if (films[i].film.key().seed == films[i - 1].film.key().seed)
      throw Error(fmt::format("it has seed {}, as {} has: only films of different seeds are independent",
                              films[i].film.key().seed, films[i - 1].file.string()),
                  {films[i].file.string()});
    try {
      sum.film.merge(films[i].film);
    } catch (const Error& e) {
      throw Error(fmt::format("cannot merge with {}: {}", sum.file.string(), e.what()),
                  {films[i].file.string()});
    }
    sum.render_time_s += films[i].render_time_s;
  }
  return sum;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Turns films into an image; films of different seeds are merged exactly.", "vitrail develop");
  std::vector<std::string> films;
  std::string output;
  double exposure_ev = 0;
  bool with_variance = false, spectral = false;
  app.add_option("FILM", films, "films of one scene, each of its own seed")->required();
  app.add_option("-o,--output", output, "image to write: .exr (linear) or .png (sRGB)")->required();
  app.add_option("--exposure", exposure_ev, "brighten by this many stops");
  app.add_flag("--variance", with_variance,
               "add the channel Variance.Y: variance of each pixel's mean luminance");
  app.add_flag("--spectral", spectral,
               "add the spectrum of each pixel, for films of render --spectral; .exr only");
  return run_guarded(app, argc, argv, [&] {
    if (spectral && std::filesystem::path(output).extension() != ".exr")
      throw UsageError("spectra are written as .exr only");
    const Exposed sum = merge_all(films);
    Picture picture = develop(sum.film);
    picture.render_time_s = sum.render_time_s;
    if (spectral && picture.bins.count == 0)
      throw Error("the film keeps no spectra: render with --spectral N", {sum.file.string()});
    if (!spectral) picture.spectrum = {};
    expose(picture, exposure_ev);
    if (!with_variance) picture.variance = {};
    write_picture(output, picture);
    return exit_done;
  });
}
