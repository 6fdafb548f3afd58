// SPDX-License-Identifier: Apache-2.0
#include "film/film_rows.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "film/film_reader.h"
#include "film/picture_fields.h"
#include "scene/system/underway.h"

namespace vitrail {

// An array of the file.
struct StoredRows {
  std::uint64_t place = 0, count = 0, checksum = 0;
};

namespace {

template <class T, class Visit>
StoredRows pass(FilmReader& in, std::uint64_t count, const char* what, Visit&& visit) {
  const std::uint64_t place = in.place();
  return {place, count, in.pass_array<T>(count, what, visit)};
}
template <class T>
StoredRows pass(FilmReader& in, std::uint64_t count, const char* what) {
  return pass<T>(in, count, what, [](std::span<T>) {});
}

}  // namespace

struct FilmRows::Contents {
  explicit Contents(const std::filesystem::path& file) : in(file), head(read_head(in)) {}
  FilmReader in;
  FilmHead head;
  StoredRows sums, counts, ids, mattes;
  std::uint64_t samples = 0;
};

FilmRows::FilmRows(const std::filesystem::path& file, FilmProgress* progress) {
  const Underway underway("reading", file);
  contents_ = std::make_unique<Contents>(file);
  Contents& c = *contents_;
  const film_layout::Arrays& arrays = c.head.arrays;
  c.sums = pass<WideSum>(c.in, arrays.sums, "sums");
  c.counts = pass<std::uint32_t>(c.in, arrays.counts, "counts", [&](std::span<std::uint32_t> part) {
    c.samples = std::accumulate(part.begin(), part.end(), c.samples);
  });
  c.ids = pass<std::int64_t>(c.in, arrays.ids, "ids");
  if (arrays.mattes > 0)
    c.mattes = pass<MattePixel>(c.in, arrays.mattes, "mattes", [&](std::span<MattePixel> part) {
      if (!std::ranges::all_of(part, makes_sense))
        c.in.fail("the film file is corrupt: its mattes make no sense");
    });
  if (arrays.more > 0) pass<std::uint32_t>(c.in, arrays.more, "open round");
  if (progress) *progress = std::move(c.head.progress);
}

FilmRows::~FilmRows() = default;
FilmRows::FilmRows(FilmRows&&) noexcept = default;
FilmRows& FilmRows::operator=(FilmRows&&) noexcept = default;

const std::filesystem::path& FilmRows::file() const { return contents_->in.path(); }
const FilmSettings& FilmRows::settings() const { return contents_->head.settings; }
const FilmKey& FilmRows::key() const { return contents_->head.key; }
std::size_t FilmRows::pixels() const { return contents_->counts.count / sample_groups; }
std::uint64_t FilmRows::samples() const { return contents_->samples; }
const Refused& FilmRows::refused() const { return contents_->head.refused; }

Film FilmRows::rows(int y0, int y1, bool with_sums) const {
  FilmReader& in = contents_->in;
  const Underway underway("reading", in.path());
  const FilmHead& head = contents_->head;
  FilmSettings part = head.settings;
  part.crop.y0 = head.settings.crop.y0 + y0, part.crop.y1 = head.settings.crop.y0 + y1;
  Film film(part, head.key, head.exponent, head.length_exponent);
  film.refused() = head.refused;
  const std::uint64_t width = static_cast<std::uint64_t>(film.width()), here = film.pixels(),
                      all = width * static_cast<std::uint64_t>(height());
  // Of all planes of an array, and of the `single` values behind them.
  const auto fill = [&](auto to, const StoredRows& from, std::uint64_t single = 0) {
    using T = typename decltype(to)::value_type;
    const std::uint64_t planes = (from.count - single) / all;
    const auto read = [&](std::uint64_t at, std::span<T> values) {
      in.go_to(from.place + at * sizeof(T));
      in.read(values.data(), values.size_bytes());
    };
    for (std::uint64_t p = 0; p < planes; ++p)
      read(p * all + static_cast<std::uint64_t>(y0) * width, to.subspan(p * here, here));
    if (single > 0) read(planes * all, to.subspan(planes * here));
  };
  if (with_sums) fill(film.sums(), contents_->sums, single_sums(head.key));
  fill(film.counts(), contents_->counts);
  fill(film.ids(), contents_->ids);
  fill(film.mattes(), contents_->mattes);
  return film;
}

std::string difference(const FilmRows& a, const FilmRows& b) {
  const auto what = [](const FilmHead& h) {
    return SumsOf{h.key, h.settings, h.exponent, h.length_exponent};
  };
  return difference(what(a.contents_->head), what(b.contents_->head));
}

namespace {

// Checksum of an array of several films: `merge(sum, other)`.
template <class T, class Of, class Merge>
std::uint64_t merged_checksum(std::span<FilmReader* const> films, Of&& stored, Merge&& merge) {
  constexpr std::uint64_t most = scratch_part_bytes / sizeof(T);
  std::vector<T> sum(most), other(most);
  XXH3_state_t state;
  XXH3_64bits_reset(&state);
  const std::uint64_t count = stored(0).count;
  for (std::uint64_t at = 0; at < count; at += most) {
    const std::uint64_t here = std::min(most, count - at);
    for (std::size_t i = 0; i < films.size(); ++i) {
      std::vector<T>& to = i == 0 ? sum : other;
      films[i]->go_to(stored(i).place + at * sizeof(T));
      films[i]->read(to.data(), here * sizeof(T));
      for (std::uint64_t k = 0; i > 0 && k < here; ++k) merge(sum[k], other[k]);
    }
    XXH3_64bits_update(&state, sum.data(), here * sizeof(T));
  }
  return XXH3_64bits_digest(&state);
}

}  // namespace

std::uint64_t hash_of(std::span<const FilmRows> films) {
  const auto add = [](auto& sum, const auto& other) { sum += other; };
  std::vector<FilmReader*> in;
  for (const FilmRows& film : films) in.push_back(&film.contents_->in);
  const auto of = [&]<class T>(StoredRows FilmRows::Contents::*array, T, auto merge) {
    const auto stored = [&](std::size_t i) -> const StoredRows& { return films[i].contents_.get()->*array; };
    return films.size() == 1 ? stored(0).checksum : merged_checksum<T>(in, stored, merge);
  };
  const std::array<std::uint64_t, 4> parts{
      of(&FilmRows::Contents::sums, WideSum{}, add), of(&FilmRows::Contents::counts, std::uint32_t{}, add),
      of(&FilmRows::Contents::ids, std::int64_t{},
         [](std::int64_t& sum, std::int64_t other) { sum = std::max(sum, other); }),
      of(&FilmRows::Contents::mattes, MattePixel{}, add)};
  return hash_of_arrays(parts, films[0].contents_->ids.count > 0, films[0].contents_->mattes.count > 0);
}

}  // namespace vitrail
