// SPDX-License-Identifier: Apache-2.0
#include "farm/rays/ray_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>

#include "scene/system/diagnostics.h"
#include "scene/system/scratch_file.h"
#include "scene/system/underway.h"

namespace vitrail {

namespace {

[[noreturn]] void fail(const char* what) {
  throw MachineError(fmt::format("rays that wait cannot be {} in {}: {}; TMPDIR names another place", what,
                                 scratch_directory().string(), std::generic_category().message(errno)));
}

off_t offset_of(RayFile::Place place) { return static_cast<off_t>(place.unit) * FileRoom::unit_bytes; }

std::uint32_t units_of(std::size_t bytes) {
  return std::max(1u, static_cast<std::uint32_t>((bytes + FileRoom::unit_bytes - 1) / FileRoom::unit_bytes));
}

}  // namespace

RayFile::~RayFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void RayFile::open() {
  descriptor_ = open_scratch_file();
  if (descriptor_ < 0) fail("kept");
}

RayFile::Place RayFile::write(const RayBatch& batch) {
  const Underway underway("writing rays to the folder for temporary files");
  if (descriptor_ < 0) open();
  const std::size_t bytes = batch.bytes().size();
  const Place place{room_.take(units_of(bytes)), static_cast<std::uint32_t>(bytes)};
  for (std::size_t at = 0; at < place.bytes;) {
    const ssize_t written = ::pwrite(descriptor_, batch.bytes().data() + at, place.bytes - at,
                                     offset_of(place) + static_cast<off_t>(at));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail("written");
    at += static_cast<std::size_t>(written);
  }
  written_ += place.bytes;
  return place;
}

RayBatch RayFile::read(Place place) {
  const Underway underway("reading rays from the folder for temporary files");
  std::vector<std::byte> bytes(place.bytes);
  for (std::size_t at = 0; at < place.bytes;) {
    const ssize_t got =
        ::pread(descriptor_, bytes.data() + at, place.bytes - at, offset_of(place) + static_cast<off_t>(at));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) fail("read");
    at += static_cast<std::size_t>(got);
  }
  room_.give_back(place.unit, units_of(place.bytes));
  return RayBatch(std::move(bytes));
}

}  // namespace vitrail
