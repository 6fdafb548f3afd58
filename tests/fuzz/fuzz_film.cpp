// SPDX-License-Identifier: Apache-2.0
// The checksum of the header is put right, so that what it states is looked at.
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <cstring>
#include <vector>

#include "film/film_progress.h"
#include "tests/fuzz/fuzz_reader.h"

namespace {

// It ends with the checksum of what comes before it (film/film_file.cpp).
constexpr std::size_t header_bytes = 184;

void repair(std::vector<std::uint8_t>& film) {
  if (film.size() < header_bytes) return;
  const std::uint64_t checksum = XXH3_64bits(film.data(), header_bytes - 8);
  std::memcpy(&film[header_bytes - 8], &checksum, sizeof checksum);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace vitrail;
  return fuzz::run([&] {
    std::vector<std::uint8_t> bytes(data, data + size);
    repair(bytes);
    FilmProgress progress;
    const Film film = read_film(fuzz::write("a.film", bytes.data(), bytes.size()), &progress);
    fuzz::require(film.pixels() > 0);
  });
}
