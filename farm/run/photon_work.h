// SPDX-License-Identifier: Apache-2.0
// Photon mapping on one rank has iterations of two phases with no ray alive between them. First photons fly,
// and land at the ranks that answer for where they land: those of all domains that the radius reaches. Then
// each pixel has one sample, whose path asks the rank that answers for where it ends. Nothing is left of an
// iteration but the film.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "farm/plan/options.h"
#include "farm/rays/waiting_batches.h"
#include "farm/scheduler/homes.h"
#include "tracer/photons/photon_pass.h"
#include "tracer/photons/places.h"
#include "tracer/photons/progressive.h"
#include "tracer/prepared/render_scene.h"

namespace vitrail {

class PhotonWork {
 public:
  // Each domain's first home answers for it. `scene` outlives it. `most_landed` (0: no limit) and
  // `most_question_bytes` are the most in memory; the others are on the disk.
  PhotonWork(const RenderScene& scene, const PhotonKey& key, std::size_t most_landed,
             std::uint64_t most_question_bytes, Homes homes, int rank, int ranks);
  PhotonWork(const PhotonWork&) = delete;  // its parts refer to each other

  // Photons are dealt out in chunks, in turn.
  static constexpr std::uint64_t chunk_photons = 4096;
  std::uint64_t chunks() const { return (pass_.photons + chunk_photons - 1) / chunk_photons; }
  std::vector<std::uint64_t> chunks_of_this_rank() const;
  std::uint64_t photons_in(std::uint64_t chunk) const;

  void begin_flying(std::uint32_t iteration);
  void begin_gathering();
  const PhotonPass& pass() const { return pass_; }
  bool flying() const { return pass_.flying; }

  void land(const Photon& photon) { map_.add(photon); }
  // Keeps a photon that landed, if this rank is to know of it, and calls send(domain) with one domain of each
  // other rank that is to know.
  template <class Send>
  void deal_out(const Photon& photon, const Send& send);

  WaitingBatches questions;   // of other ranks
  std::uint64_t landed = 0;   // of all iterations, here
  std::size_t most_kept = 0;  // of any, in memory
  // Returns the bytes of photons and questions that went to the disk, in all.
  std::uint64_t written_bytes() const { return map_.written_bytes() + questions.written_bytes(); }

 private:
  const RenderScene& scene_;
  PhotonKey key_;
  SensorDiscs discs_;  // none, of a picture
  Emission emission_;
  PhotonMap map_;
  PhotonPass pass_;
  Homes homes_;
  std::vector<std::uint8_t> answers_;
  int rank_, ranks_;
  double reach_ = 0;
  std::vector<int> reached_;
};

template <class Send>
void PhotonWork::deal_out(const Photon& photon, const Send& send) {
  ++landed;
  if (ranks_ == 1) {
    map_.add(photon);
    return;
  }
  reached_.clear();
  for_each_domain_near(scene_.manifest, photon.p, reach_, [&](std::uint32_t domain) {
    const int rank = homes_.first(domain);
    if (std::ranges::find(reached_, rank) != reached_.end()) return;
    reached_.push_back(rank);
    if (rank == rank_)
      map_.add(photon);
    else
      send(domain);
  });
}

}  // namespace vitrail
