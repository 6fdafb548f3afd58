// SPDX-License-Identifier: Apache-2.0
// A film or checkpoint whose checksums are put right, so that what they cover is looked at; then developed,
// and merged with itself.
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <cstring>
#include <vector>

#include "film/develop.h"
#include "film/film_layout.h"
#include "film/film_progress.h"
#include "tests/fuzz/fuzz_reader.h"

namespace {

using namespace vitrail::film_layout;

constexpr std::uint64_t checksum_bytes = 8, most_bytes = 1 << 20;

// Of all arrays, where the header says how many there are.
void repair(std::vector<std::uint8_t>& film) {
  Header h;
  if (film.size() < sizeof h) return;
  std::memcpy(&h, film.data(), sizeof h);
  h.checksum = checksum(h);
  std::memcpy(film.data(), &h, sizeof h);
  const auto is_extent = [](std::int32_t a, std::int32_t b) { return 0 <= a && a < b && b <= 1 << 10; };
  if (!is_extent(h.x0, h.x1) || !is_extent(h.y0, h.y1) || h.bins < 0 || h.bins > 1 << 10 ||
      h.items > most_bytes)
    return;
  GroupsHeader groups{};
  if (h.version == groups_version && film.size() >= sizeof h + sizeof groups)
    std::memcpy(&groups, &film[sizeof h], sizeof groups);
  const std::vector<std::uint64_t> arrays = bytes_of_arrays(h, groups);
  std::uint64_t bytes = sizeof h;
  for (const std::uint64_t array : arrays) bytes += array + checksum_bytes;
  if (bytes > most_bytes) return;
  film.resize(bytes);
  std::size_t at = sizeof h;
  for (const std::uint64_t array : arrays) {
    const std::uint64_t sum = XXH3_64bits(&film[at], array);
    std::memcpy(&film[at + array], &sum, sizeof sum);
    at += array + checksum_bytes;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vitrail;
  return fuzz::run([&] {
    std::vector<std::uint8_t> bytes(data, data + size);
    repair(bytes);
    FilmProgress progress;
    Film film = read_film(fuzz::write("a.film", bytes.data(), bytes.size()), &progress);
    fuzz::require(film.pixels() > 0);
    fuzz::require(progress.done.size() == (progress.items + 63) / 64);
    static_cast<void>(progress.complete());
    static_cast<void>(develop(film));
    film.merge(film);
    static_cast<void>(film.clamped_share() + film.shared_error());
  });
}
