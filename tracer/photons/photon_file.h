// SPDX-License-Identifier: Apache-2.0
// A PhotonFile holds photons for which memory has no room, in files of the scratch directory. They come as
// sorted runs, are merged into one order, and are found by their cells. A rank has few of them in memory at a
// time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tracer/photons/photon_records.h"

namespace vitrail {

// It is a photon that landed, with the number of the cell where it did.
struct PlacedPhoton {
  std::uint64_t cell = 0;
  Photon photon;
};

// It is the order in which photons are added up: cell, number, depth. It does not depend on where they were
// kept.
bool comes_before(const PlacedPhoton& a, const PlacedPhoton& b);

// Any number of threads may read after `merge`. All but clear() throw MachineError where the disk is full or
// does not answer.
class PhotonFile {
 public:
  PhotonFile() = default;
  ~PhotonFile();
  PhotonFile(const PhotonFile&) = delete;
  PhotonFile& operator=(const PhotonFile&) = delete;

  void clear();
  // Appends photons that are in order among themselves.
  void add_run(std::span<const PlacedPhoton> sorted);
  // Puts all runs into one order, through `buffer`: a larger one is faster. It keeps at most `most_entries`
  // cells in memory, by which photons are found.
  void merge(std::span<PlacedPhoton> buffer, std::size_t most_entries);
  // Calls `visit` with the photons of the cells from `first` to `last`, in order.
  template <class Visit>
  void visit(std::uint64_t first, std::uint64_t last, const Visit& visit) const;

  bool empty() const { return runs_.empty(); }
  std::size_t size() const { return photons_; }                   // that were added since clear()
  std::uint64_t written_bytes() const { return written_bytes_; }  // in all

 private:
  static constexpr std::size_t block_photons = 64;
  struct Run {
    std::size_t begin = 0, end = 0;  // photons of the file
  };
  class Merging;
  std::span<const PlacedPhoton> block(std::size_t first, std::array<PlacedPhoton, block_photons>& into) const;
  // Returns the place where the search for a cell begins: no photon of the cell lies before it.
  std::size_t begin_of(std::uint64_t cell) const;

  int runs_descriptor_ = -1, merged_descriptor_ = -1;
  std::vector<Run> runs_;
  std::size_t photons_ = 0;
  std::vector<std::uint64_t> first_cells_;  // of the merged file, one every `stride_` photons
  std::size_t stride_ = block_photons;
  std::uint64_t written_bytes_ = 0;
};

template <class Visit>
void PhotonFile::visit(std::uint64_t first, std::uint64_t last, const Visit& visit) const {
  std::array<PlacedPhoton, block_photons> room;
  for (std::size_t at = begin_of(first); at < photons_; at += room.size())
    for (const PlacedPhoton& placed : block(at, room)) {
      if (placed.cell > last) return;
      if (placed.cell >= first) visit(placed.photon);
    }
}

}  // namespace vitrail
