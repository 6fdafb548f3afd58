// SPDX-License-Identifier: Apache-2.0
#include "farm/same_job.h"

#include <fmt/format.h>

#include "bundle/checksum.h"
#include "farm/agreement.h"

namespace vitrail {

namespace {

struct Part {
  const char* name;
  std::string value;
};

// Everything that ranks decide alike by, or that enters the film.
std::vector<Part> parts_of(const Manifest& m, const FilmKey& key, const Goal& goal, const RenderOptions& o) {
  std::string bundle = fmt::format("{:x}", m.scene_hash);
  for (const DomainInfo& d : m.domains) bundle += fmt::format(" {:x}", d.hash);
  for (const ObjectInfo& object : m.objects) bundle += fmt::format(" {:x}", object.hash);
  for (const TextureFileEntry& t : m.texture_files) bundle += fmt::format(" {:x}", t.hash);
  const PixelRect& crop = m.film.crop;
  return {{"build", to_string(key.renderer)},
          {"bundle", std::move(bundle)},
          {"seed", fmt::format("{}", key.seed)},
          {"size, crop, layers or bins of the picture",
           fmt::format("{} {} {} {} {} {} {} {} {} {} {}", m.film.width, m.film.height, crop.x0, crop.x1,
                       crop.y0, crop.y1, m.film.layers.bits, m.film.layers.in_camera_space,
                       m.film.spectrum.count, m.film.spectrum.min_nm, m.film.spectrum.max_nm)},
          {"depth, integrator or clamp",
           fmt::format("{} {} {} {}", key.max_depth, key.direct_only, key.straight_counts, key.clamp)},
          {"number of samples, error or time",
           fmt::format("{} {} {} {} {} {}", goal.samples, goal.in_rounds, goal.adaptive,
                       goal.target ? goal.target->value : 0, goal.target && goal.target->just_noticeable,
                       o.time_limit_s)},
          {"output, profile or dry run",
           fmt::format("{}\n{}\n{}", o.film.string(), o.profile.string(), o.dry_run)}};
}

}  // namespace

void expect_same_job(Transport& transport, const Manifest& manifest, const FilmKey& key, const Goal& goal,
                     const RenderOptions& options) {
  const std::vector<Part> parts = parts_of(manifest, key, goal, options);
  std::vector<std::uint64_t> mine, first;
  for (const Part& p : parts) mine.push_back(checksum(std::as_bytes(std::span(p.value))));
  first = mine;
  transport.broadcast_from_root(first);
  agree(transport, [&] {
    for (std::size_t i = 0; i < parts.size(); ++i)
      if (mine[i] != first[i])
        throw UsageError(fmt::format("rank {} of the job was given another {} than rank 0", transport.rank(),
                                     parts[i].name));
  });
}

}  // namespace vitrail
