// SPDX-License-Identifier: Apache-2.0
#include "bundle/loaded_domain.h"

#include "scene/system/underway.h"

namespace vitrail {

namespace {

std::optional<std::uint64_t> checked_hash(std::uint64_t hash, bool loaded) {
  return loaded ? std::optional(hash) : std::nullopt;
}

}  // namespace

LoadedDomain::LoadedDomain(const Manifest& manifest, std::uint32_t domain, SharedDomain mapped,
                           const std::function<SharedDomain(std::uint32_t)>& object)
    : mapped_(std::move(mapped)), view_(mapped_->view()) {
  const std::vector<std::uint32_t>& needed = manifest.domains.at(domain).objects;
  if (needed.empty()) return;
  object_views_.resize(needed.back() + std::size_t{1});
  own_views_.reserve(needed.size());  // views of it are given away
  for (const std::uint32_t number : needed) {
    const ObjectInfo& info = manifest.objects[number];
    if (info.quadric) {
      object_views_[number] = &own_views_.emplace_back();
      own_views_.back().quadric = &*info.quadric;
      continue;
    }
    objects_.push_back(object(number));
    object_views_[number] = &objects_.back()->view();
    if (!info.motion.moves()) continue;
    object_views_[number] = &own_views_.emplace_back(objects_.back()->view());
    own_views_.back().motion = &info.motion;
  }
  view_.objects = object_views_;
}

std::uint64_t bytes_loaded(const Manifest& manifest, std::uint32_t domain) {
  const DomainInfo& d = manifest.domains[domain];
  if (d.objects.empty()) return d.bytes;
  // NOLINTNEXTLINE(bugprone-sizeof-expression): a table of pointers
  std::uint64_t tables = sizeof(DomainView*) * (d.objects.back() + std::uint64_t{1});
  for (const std::uint32_t object : d.objects)
    tables += manifest.objects[object].quadric ? sizeof(DomainView) : sizeof(SharedDomain);
  return d.bytes + tables;
}

SharedDomain map_domain(const Manifest& manifest, const std::filesystem::path& bundle, std::uint32_t domain,
                        OpenPacks* packs, bool loaded) {
  const Stored stored = stored_domain(manifest, bundle, domain);
  const std::filesystem::path file = stored.name();
  const Underway underway("reading", file);
  const std::optional<std::uint64_t> checked = checked_hash(manifest.domains[domain].hash, loaded);
  auto mapped = stored.bytes && packs
                    ? std::make_shared<const MappedDomain>(*packs->open(stored.file), stored, checked)
                    : std::make_shared<const MappedDomain>(stored, checked);
  if (mapped->hash() != checked) check_domain(manifest, domain, *mapped, file);
  return mapped;
}

SharedDomain map_object(const Manifest& manifest, const std::filesystem::path& bundle, std::uint32_t object,
                        bool loaded) {
  const std::filesystem::path file = object_path(bundle, object);
  const Underway underway("reading", file);
  const std::optional<std::uint64_t> checked = checked_hash(manifest.objects[object].hash, loaded);
  auto mapped = std::make_shared<const MappedDomain>(Stored{file}, checked);
  if (mapped->hash() != checked) check_object(manifest, object, *mapped, file);
  return mapped;
}

std::unique_ptr<const LoadedDomain> load_domain(const Manifest& manifest, const std::filesystem::path& bundle,
                                                std::uint32_t domain) {
  return std::make_unique<const LoadedDomain>(
      manifest, domain, map_domain(manifest, bundle, domain),
      [&](std::uint32_t object) { return map_object(manifest, bundle, object); });
}

}  // namespace vitrail
