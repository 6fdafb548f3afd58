// SPDX-License-Identifier: Apache-2.0
// The film file, little-endian: a header with the checksum of what comes before it, then six arrays, each
// followed by its xxh3: FilmProgress's earlier_ends, about and done, the sums, the counts, the ids; of a film
// that keeps mattes a seventh, these; and of a film within an adaptive round a last one, `more`. Before them
// come, of a film that has it, what photons it gathered, its light groups, and its working gamma.
// docs/why/color-and-film.md has the header byte by byte.
#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <utility>

#include "film/array_checksum.h"
#include "film/film_layout.h"
#include "film/film_progress.h"
#include "film/film_reader.h"
#include "scene/system/atomic_file.h"
#include "scene/system/memory_guard.h"
#include "scene/system/underway.h"

namespace vitrail {

using namespace film_layout;

static_assert(std::endian::native == std::endian::little, "files are written as they lie in memory");

namespace {

template <class T>
void write_array(AtomicFile& out, const T& array, FilmScratch* scratch = nullptr) {
  const std::uint64_t sum = checksum_of(std::span<const typename T::value_type>(array), scratch,
                                        [&](auto part) { out.write(std::as_bytes(part)); });
  out.write(std::as_bytes(std::span(&sum, 1)));
}

}  // namespace

bool FilmProgress::complete() const {
  std::uint64_t finished = 0;
  for (const std::uint64_t word : done) finished += static_cast<std::uint64_t>(std::popcount(word));
  return finished == items;
}

void write_film(const std::filesystem::path& file, const Film& film, const FilmProgress& progress) {
  Header h{};
  std::memcpy(h.magic, film_magic, sizeof film_magic);
  const bool photons = film.key_.photons.photons > 0;
  const LightGroups& groups = film.key_.groups;
  h.version = groups.any()        ? groups_version
              : progress.adaptive ? adaptive_version
              : photons           ? photon_version
                                  : film_version;
  h.full_width = film.settings_.width, h.full_height = film.settings_.height;
  h.x0 = film.settings_.crop.x0, h.x1 = film.settings_.crop.x1, h.y0 = film.settings_.crop.y0,
  h.y1 = film.settings_.crop.y1;
  h.imaging_ratio = film.settings_.imaging_ratio;
  h.bins = film.settings_.spectrum.count, h.bins_min_nm = film.settings_.spectrum.min_nm,
  h.bins_max_nm = film.settings_.spectrum.max_nm;
  const FilmKey& key = film.key_;
  h.scene_hash = key.scene_hash, h.seed = key.seed;
  key.renderer.number.copy(h.renderer, sizeof h.renderer - 1);
  h.picture_revision = key.renderer.revision;
  h.max_depth = key.max_depth;
  h.options =
      (key.direct_only ? option_direct_only : 0) | (key.straight_counts ? option_straight_counts : 0) |
      (film.settings_.layers.in_camera_space ? option_camera_space : 0) | (key.splats ? option_splats : 0) |
      (key.one_sequence ? option_one_sequence : 0) | (key.hides_emitters ? option_hides_emitters : 0) |
      (film.settings_.working_gamma != 1 ? option_working_gamma : 0) |
      (std::bit_cast<std::uint32_t>(key.threshold) & threshold_bits) |
      (progress.adaptive ? option_adaptive : 0) | (progress.more.empty() ? 0 : option_open_round);
  h.exponent = film.exponent_, h.length_exponent = film.length_exponent_;
  h.clamp = key.clamp;
  h.layers = film.settings_.layers.bits;
  h.nonfinite = film.refused_.nonfinite, h.too_large = film.refused_.too_large;
  h.items = progress.items, h.samples_per_pixel = progress.samples_per_pixel;
  h.render_time_s = progress.render_time_s;
  h.earlier_ends = static_cast<std::uint32_t>(progress.earlier_ends.size());
  h.about_bytes = static_cast<std::uint32_t>(progress.about.size());
  h.checksum = checksum(h);
  AtomicFile out(file);
  out.write(std::as_bytes(std::span(&h, 1)));
  if (photons) write_array(out, std::array{key.photons});
  if (groups.any()) {
    write_array(out, std::array{header_of(groups)});
    write_array(out, text_of(groups));
  }
  if (film.settings_.working_gamma != 1) write_array(out, std::array{film.settings_.working_gamma});
  write_array(out, progress.earlier_ends);
  write_array(out, progress.about);
  write_array(out, progress.done);
  FilmScratch* const scratch = film.scratch_.get();
  write_array(out, film.sums_, scratch);
  write_array(out, film.counts_, scratch);
  write_array(out, film.ids_, scratch);
  if (!film.mattes_.empty()) write_array(out, film.mattes_, scratch);
  if (!progress.more.empty()) write_array(out, progress.more);
  out.commit();
}

Film read_film(const std::filesystem::path& file, FilmProgress* progress,
               std::shared_ptr<FilmScratch> scratch) {
  FilmReader in(file);
  const Underway underway("reading", file);
  FilmHead head = read_head(in);
  const Arrays& arrays = head.arrays;
  Film film(std::move(scratch));
  film.settings_ = head.settings, film.key_ = std::move(head.key);
  if (!film.scratch_) ask_memory(film_bytes(film.settings_, film.key_));
  film.exponent_ = head.exponent, film.length_exponent_ = head.length_exponent;
  film.refused_ = head.refused;
  in.read_array(film.sums_, arrays.sums, "sums", film.scratch_.get());
  in.read_array(film.counts_, arrays.counts, "counts", film.scratch_.get());
  in.read_array(film.ids_, arrays.ids, "ids", film.scratch_.get());
  if (arrays.mattes > 0) in.read_array(film.mattes_, arrays.mattes, "mattes", film.scratch_.get());
  in_parts(std::span(std::as_const(film.mattes_)), film.scratch_.get(), [&](auto part) {
    if (!std::ranges::all_of(part, makes_sense))
      in.fail("the film file is corrupt: its mattes make no sense");
  });
  if (arrays.more > 0) in.read_array(head.progress.more, arrays.more, "open round");
  if (progress) *progress = std::move(head.progress);
  return film;
}

}  // namespace vitrail
