// SPDX-License-Identifier: Apache-2.0
// LaneLists says which of a wave's paths go by which stage in lanes.
#pragma once

#include <array>
#include <vector>

#include "tracer/transport/shading.h"
#include "tracer/transport/waves/lane_stages.h"

namespace vitrail {

class LaneLists {
 public:
  // Paths of a wave are at places below `most`.
  explicit LaneLists(std::size_t most);

  // Returns whether any of the scene's paths may be put into a list.
  static bool apply_to(const Tracing& tracing);
  // Puts a path, which has flown, into the list of its kind, if its stage can do all that the event takes.
  // Light that the path meets there is deposited. Returns false for a path that is left to `shade`.
  bool take(Tracing& tracing, CameraPath& path, std::uint32_t place, const Arrived& arrived);
  // Runs the stages over all that is in lists, and empties them. Paths that go on are put behind `live`.
  void run(Tracing& tracing, CameraPath* paths, ShadowRays& shadows, std::vector<std::uint32_t>& live);

 private:
  bool take_in_medium(Tracing& tracing, CameraPath& path, std::uint32_t place, const Arrived& arrived);
  bool take_leaving(Tracing& tracing, CameraPath& path, std::uint32_t place);
  // Puts a path into the list of the material that it has met. `at` is null where nothing of it is needed.
  [[gnu::always_inline]] inline void enlist(const Tracing& tracing, const CameraPath& path,
                                            std::uint32_t place, const LaneMaterial& of,
                                            const Interaction* at, bool is_placed);
  void sort_by_texture(const LaneScene& scene);
  std::uint32_t candidates_of(const Tracing& tracing, const CameraPath& path, std::uint32_t place,
                              bool is_placed, const LaneMaterial& of) const;

  // They are places by kind, by whether the hit is placed, by whether there are several candidates for a
  // light.
  std::array<std::array<std::array<std::vector<std::uint32_t>, 2>, 2>, lane_kinds> lists_;
  std::vector<std::uint32_t> surface_, material_, next_;  // by place, by place; places
  std::vector<LaneBsdf> bsdfs_;                           // by place
  std::vector<LaneCoating> coatings_;                     // by place
  std::vector<PlacedHit> placed_;                         // by place
  std::vector<lanes::DomainTables> domains_;            // by number; of those where paths in lists have hits
  std::vector<std::uint32_t> leaving_;                  // places
  std::array<std::vector<std::uint32_t>, 2> in_media_;  // places, by whether there are several candidates
  std::vector<std::uint32_t> passing_;  // places, of those that have come to nothing of their surface
  Interaction interaction_;             // of the path at hand, where something is asked of it
  std::size_t taken_ = 0;
};

}  // namespace vitrail
