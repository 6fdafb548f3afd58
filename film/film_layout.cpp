// SPDX-License-Identifier: Apache-2.0
#include "film/film_layout.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

namespace vitrail::film_layout {

std::uint64_t checksum(const Header& h) { return XXH3_64bits(&h, offsetof(Header, checksum)); }

std::vector<char> text_of(const LightGroups& groups) {
  std::vector<char> text;
  for (const std::string& name : groups.names)
    text.insert(text.end(), name.c_str(), name.c_str() + name.size() + 1);
  return text;
}

GroupsHeader header_of(const LightGroups& groups) {
  return {groups.lights, static_cast<std::uint32_t>(groups.names.size()),
          static_cast<std::uint32_t>(text_of(groups).size())};
}

Arrays arrays_of(const Header& h, std::uint64_t groups) {
  const FilmLayers layers{h.layers, (h.options & option_camera_space) != 0};
  const std::uint64_t pixels =
      static_cast<std::uint64_t>(h.x1 - h.x0) * static_cast<std::uint64_t>(h.y1 - h.y0);
  const std::uint64_t planes = 2 + sample_groups + static_cast<std::uint64_t>(h.bins) + sum_planes(layers) +
                               planes_a_group * groups +
                               ((h.options & option_splats) != 0 ? sample_groups : 0);
  const std::uint64_t single = (h.version == photon_version ? 2 * photon_batches : 0) + (h.clamp > 0 ? 1 : 0);
  return {layers,
          h.items / 64 + (h.items % 64 != 0 ? 1 : 0),
          planes * pixels + single,
          sample_groups * pixels,
          id_planes(layers) * pixels,
          matte_planes(layers) * pixels,
          (h.options & option_open_round) != 0 ? pixels : 0};
}

std::vector<std::uint64_t> bytes_of_arrays(const Header& h, const GroupsHeader& groups) {
  const Arrays a = arrays_of(h, groups.groups);
  std::vector<std::uint64_t> bytes;
  if (groups.groups > 0) bytes = {sizeof groups, groups.text_bytes};
  if (h.version == photon_version) bytes.push_back(sizeof(PhotonKey));
  if ((h.options & option_working_gamma) != 0) bytes.push_back(sizeof(double));
  for (const std::uint64_t array :
       {h.earlier_ends * std::uint64_t{sizeof(std::uint32_t)}, std::uint64_t{h.about_bytes},
        a.done * sizeof(std::uint64_t), a.sums * sizeof(WideSum), a.counts * sizeof(std::uint32_t),
        a.ids * sizeof(std::int64_t)})
    bytes.push_back(array);
  if (a.mattes > 0) bytes.push_back(a.mattes * sizeof(MattePixel));
  if (a.more > 0) bytes.push_back(a.more * sizeof(std::uint32_t));
  return bytes;
}

}  // namespace vitrail::film_layout
