// SPDX-License-Identifier: Apache-2.0
#include "farm/plan/same_job.h"

#include <fmt/format.h>

#include "bundle/checksum.h"
#include "film/picture_fields.h"

namespace vitrail {

namespace {

struct Part {
  const char* name;
  std::string value;
};

std::string to_string(const Homes& homes) {
  std::string text;
  for (std::uint32_t d = 0; d < homes.domains(); ++d)
    text += fmt::format("{}-{} ", homes.first(d), homes.last(d));
  return text;
}

// Everything that ranks decide alike by, or that enters the film.
std::vector<Part> parts_of(const Manifest& m, const FilmKey& key, const Goal& goal, const Homes& homes,
                           const RenderOptions& o) {
  std::string bundle = fmt::format("{:x}", m.scene_hash);
  for (const DomainInfo& d : m.domains) bundle += fmt::format(" {:x}", d.hash);
  for (const ObjectInfo& object : m.objects) bundle += fmt::format(" {:x}", object.hash);
  for (const TextureFileEntry& t : m.texture_files) bundle += fmt::format(" {:x}", t.hash);
  std::vector<Part> parts{{"way to sample the picture", words_of(o.picture.samples)},
                          {"bundle", std::move(bundle)},
                          {"values of --set", o.picture.glazing},
                          {"seed", fmt::format("{}", key.seed)}};
  for (const PictureField& field : picture_fields(key, m.film)) parts.push_back({field.name, field.value});
  parts.insert(parts.end(),
               {{"number of samples, error or time",
                 fmt::format("{} {} {} {} {} {} {}", goal.samples, goal.in_rounds, goal.adaptive,
                             goal.open_ended, goal.target ? goal.target->value : 0,
                             goal.target && goal.target->just_noticeable, o.resources.time_limit_s)},
                {"distribution or homes", fmt::format("{} {} {}", static_cast<int>(o.resources.distribution),
                                                      o.resources.homes_stay, to_string(homes))},
                {"output, profile, trace, dry run or --force",
                 fmt::format("{}\n{}\n{}\n{} {}", o.outputs.film.string(), o.outputs.profile.string(),
                             o.outputs.trace.string(), o.outputs.dry_run, o.outputs.force)}});
  return parts;
}

}  // namespace

void expect_same_job(Transport& transport, const Manifest& manifest, const FilmKey& key, const Goal& goal,
                     const Homes& homes, const RenderOptions& options) {
  const std::vector<Part> parts = parts_of(manifest, key, goal, homes, options);
  std::vector<std::uint64_t> mine;
  for (const Part& p : parts) mine.push_back(checksum(std::as_bytes(std::span(p.value))));
  std::vector<std::uint64_t> first = mine;
  transport.broadcast_from_root(first);
  std::vector<std::int64_t> differs(parts.size());
  for (std::size_t i = 0; i < parts.size(); ++i) differs[i] = mine[i] != first[i];
  transport.max_to_root(differs);
  std::vector<std::uint64_t> anywhere(differs.begin(), differs.end());
  transport.broadcast_from_root(anywhere);
  for (std::size_t i = 0; i < parts.size(); ++i)
    if (anywhere[i] != 0)
      throw UsageError(fmt::format("a rank of the job was given another {} than rank 0", parts[i].name));
}

}  // namespace vitrail
