// SPDX-License-Identifier: Apache-2.0
#include "cli/render/picture_output.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>

#include "cli/common/own_output.h"
#include "cli/common/run_program.h"
#include "farm/run/checkpoint.h"
#include "film/alpha.h"
#include "film/develop.h"
#include "film/jpeg_file.h"
#include "film/own_picture.h"
#include "film/picture_format.h"
#include "film/png_file.h"
#include "film/tiff_file.h"
#include "film/tone_curves.h"
#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"
#include "scene/system/output_place.h"
#include "scene/system/resource_usage.h"
#include "scene/system/say.h"

namespace vitrail {

namespace fs = std::filesystem;

namespace {

bool writes_itself(const fs::path& picture) { return written_by_render(picture_format(picture)); }

// What another program may take of the memory of this rank.
std::string left_of(std::uint64_t bytes) {
  ::malloc_trim(0);
  return fmt::format("{}K", (bytes - std::min(bytes, resident_bytes())) >> 10);
}

void develop_film(const RenderArguments& a, const fs::path& file, const fs::path& picture,
                  int spectral_bins) {
  if (writes_itself(picture) && !a.denoised) {
    const FilmRows film(file, nullptr);
    require_samples(film.samples(), file);
    Picture developed = develop_colors(film);
    if (const double ev = fitting_exposure_ev(developed.rgb); ev != 0) {
      expose(developed, ev);
      if (!a.quiet)
        say("vitrail: {}: exposed by {:+.1f} stops, since most of it would be white; vitrail develop makes "
            "others of a "
            ".film\n",
            picture.string(), ev);
    }
    make_straight(developed);
    if (picture_format(picture) == PictureFormat::jpeg) return write_jpeg(picture, developed);
    if (picture_format(picture) == PictureFormat::tiff) return write_tiff(picture, developed);
    return write_png(picture, developed);
  }
  std::vector<std::string> arguments{file.string(), "-o", picture.string(), "--quiet"};
  if (!holds_light(picture_format(picture))) arguments.insert(arguments.end(), {"--exposure", "fit"});
  if (spectral_bins > 0 && picture.extension() == ".exr") arguments.push_back("--spectral");
  if (a.denoised)
    arguments.insert(arguments.end(), {"--denoise", "--memory", left_of(a.options.resources.memory_bytes)});
  run_program("vitrail-develop", arguments);
}

// It was made of the film, and perhaps worked on since.
bool is_newer(const fs::path& picture, const fs::path& film) {
  std::error_code none;
  const auto developed = fs::last_write_time(picture, none);
  return !none && developed >= fs::last_write_time(film);
}

}  // namespace

void check_outputs(const RenderArguments& a) {
  const JobOutputs& o = a.options.outputs;
  note_input(a.input);
  for (const fs::path& file :
       {o.picture, o.film, checkpoint_path(o.film), o.stats, o.profile, o.trace, a.preview})
    if (!file.empty()) require_place(file);
  // A film that is kept speaks for the picture beside it.
  if (!o.keeps_film || !fs::exists(o.film)) require_own(o.picture, is_own_picture, o.force);
  require_own(a.preview, is_own_picture, o.force);
  require_own_texts({o.stats, o.profile, o.trace}, o.force);
  require_denoiser(a);
}

void require_denoiser(const RenderArguments& a) {
  if (a.denoised) run_program("vitrail-develop", {"--find-denoiser"}, nullptr, "/dev/null");
}

AfterFilm developing(const RenderArguments& a) {
  const fs::path& picture = a.options.outputs.picture;
  if (picture.empty()) return {};
  if (a.denoised) return {0.7, 1.2e-7};              // docs/why/denoising.md
  return {writes_itself(picture) ? 0 : 0.19, 4e-9};  // a program starts; the film read, converted, packed
}

void write_picture_of_film(const RenderArguments& a, const RenderStats& stats,
                           const std::function<void()>& once_written) {
  const JobOutputs& o = a.options.outputs;
  if (o.picture.empty() || o.dry_run) return;
  if (!(o.keeps_film && stats.finished_before && !o.force && is_newer(o.picture, o.film)))
    develop_film(a, o.film, o.picture, stats.spectral_bins);
  else if (a.denoised && !a.quiet)
    say("vitrail: {} is newer than its film and stays; vitrail develop {} -o {} --denoise replaces it\n",
        o.picture.string(), o.film.string(), o.picture.string());
  if (once_written) once_written();
  if (!o.keeps_film && stats.ending == Ending::finished) fs::remove(o.film);
}

fs::path write_picture_so_far(const RenderArguments& a, const RenderStats& stats) {
  const JobOutputs& o = a.options.outputs;
  const fs::path& picture = a.preview.empty() ? o.picture : a.preview;
  if (picture.empty() || o.dry_run || stats.samples == 0) return {};
  if (a.preview.empty() && fs::exists(picture)) return {};
  develop_film(a, checkpoint_path(o.film), picture, stats.spectral_bins);
  return picture;
}

}  // namespace vitrail
