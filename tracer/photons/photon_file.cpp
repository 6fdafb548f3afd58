// SPDX-License-Identifier: Apache-2.0
#include "tracer/photons/photon_file.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "scene/system/diagnostics.h"
#include "scene/system/scratch_file.h"
#include "scene/system/underway.h"

namespace vitrail {

namespace {

[[noreturn]] void fail(const char* what) {
  throw MachineError(fmt::format("photons cannot be {} in {}: {}; TMPDIR names another place", what,
                                 scratch_directory().string(), std::generic_category().message(errno)));
}

off_t offset_of(std::size_t photon) { return static_cast<off_t>(photon * sizeof(PlacedPhoton)); }

void write_at(int& descriptor, std::size_t photon, std::span<const PlacedPhoton> photons) {
  const Underway underway("writing photons to the folder for temporary files");
  if (descriptor < 0) descriptor = open_scratch_file();
  if (descriptor < 0) fail("kept");
  const auto bytes = std::as_bytes(photons);
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t n = ::pwrite(descriptor, bytes.data() + at, bytes.size() - at,
                               offset_of(photon) + static_cast<off_t>(at));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail("written");
    at += static_cast<std::size_t>(n);
  }
}

void read_at(int descriptor, std::size_t photon, std::span<PlacedPhoton> photons) {
  const auto bytes = std::as_writable_bytes(photons);
  for (std::size_t at = 0; at < bytes.size();) {
    const ssize_t n =
        ::pread(descriptor, bytes.data() + at, bytes.size() - at, offset_of(photon) + static_cast<off_t>(at));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail("read");
    at += static_cast<std::size_t>(n);
  }
}

}  // namespace

bool comes_before(const PlacedPhoton& a, const PlacedPhoton& b) {
  if (a.cell != b.cell) return a.cell < b.cell;
  if (a.photon.number != b.photon.number) return a.photon.number < b.photon.number;
  if (a.photon.depth != b.photon.depth) return a.photon.depth < b.photon.depth;
  return std::memcmp(&a.photon, &b.photon, sizeof a.photon) < 0;  // through what it passes straight
}

PhotonFile::~PhotonFile() {
  for (const int descriptor : {runs_descriptor_, merged_descriptor_})
    if (descriptor >= 0) ::close(descriptor);
}

void PhotonFile::clear() {
  for (const int descriptor : {runs_descriptor_, merged_descriptor_})
    if (descriptor >= 0 && ::ftruncate(descriptor, 0) != 0) continue;  // its room is used again
  runs_.clear();
  first_cells_.clear();
  photons_ = 0;
}

void PhotonFile::add_run(std::span<const PlacedPhoton> sorted) {
  write_at(runs_descriptor_, photons_, sorted);
  runs_.push_back({photons_, photons_ + sorted.size()});
  photons_ += sorted.size();
  written_bytes_ += sorted.size_bytes();
}

// Of one run what is in memory, and what is not.
class PhotonFile::Merging {
 public:
  Merging(int descriptor, Run run, std::span<PlacedPhoton> buffer)
      : descriptor_(descriptor), left_(run), buffer_(buffer) {
    fill();
  }
  bool ended() const { return here_.empty(); }
  const PlacedPhoton& first() const { return here_.front(); }
  void next() {
    here_ = here_.subspan(1);
    if (here_.empty()) fill();
  }

 private:
  void fill() {
    const std::size_t count = std::min(buffer_.size(), left_.end - left_.begin);
    read_at(descriptor_, left_.begin, buffer_.first(count));
    left_.begin += count;
    here_ = buffer_.first(count);
  }

  int descriptor_;
  Run left_;
  std::span<PlacedPhoton> buffer_, here_;
};

void PhotonFile::merge(std::span<PlacedPhoton> buffer, std::size_t most_entries) {
  // Each run has a part of the buffer, and what is in order the last one.
  const std::size_t part = buffer.size() / (runs_.size() + 1);
  if (part == 0)
    throw MachineError(fmt::format(
        "{} photons landed in one iteration, too many for the memory that is set aside for them: give fewer "
        "--photons, or more --memory",
        photons_));
  stride_ = (photons_ / std::max<std::size_t>(most_entries, 1) / block_photons + 1) * block_photons;
  first_cells_.reserve(photons_ / stride_ + 1);
  std::vector<Merging> runs;
  for (std::size_t r = 0; r < runs_.size(); ++r)
    runs.emplace_back(runs_descriptor_, runs_[r], buffer.subspan(r * part, part));
  const auto later = [&](const Merging& a, const Merging& b) { return comes_before(b.first(), a.first()); };
  std::ranges::make_heap(runs, later);
  const std::span<PlacedPhoton> in_order = buffer.subspan(runs_.size() * part);
  std::size_t written = 0, filled = 0;
  const auto write = [&] {
    write_at(merged_descriptor_, written, in_order.first(filled));
    written_bytes_ += in_order.first(filled).size_bytes();
    written += filled;
    filled = 0;
  };
  while (!runs.empty()) {
    std::ranges::pop_heap(runs, later);
    if ((written + filled) % stride_ == 0) first_cells_.push_back(runs.back().first().cell);
    in_order[filled++] = runs.back().first();
    if (filled == in_order.size()) write();
    runs.back().next();
    if (runs.back().ended())
      runs.pop_back();
    else
      std::ranges::push_heap(runs, later);
  }
  write();
}

std::size_t PhotonFile::begin_of(std::uint64_t cell) const {
  const auto from =
      static_cast<std::size_t>(std::ranges::lower_bound(first_cells_, cell) - first_cells_.begin());
  if (from == 0) return 0;
  std::size_t low = (from - 1) * stride_, high = std::min(from * stride_, photons_);
  while (high - low > block_photons) {
    const std::size_t middle = low + (high - low) / 2;
    PlacedPhoton at;
    read_at(merged_descriptor_, middle, {&at, 1});
    (at.cell < cell ? low : high) = middle;
  }
  return low;
}

std::span<const PlacedPhoton> PhotonFile::block(std::size_t first,
                                                std::array<PlacedPhoton, block_photons>& into) const {
  const std::span<PlacedPhoton> read = std::span(into).first(std::min(into.size(), photons_ - first));
  read_at(merged_descriptor_, first, read);
  return read;
}

}  // namespace vitrail
