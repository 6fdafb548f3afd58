// SPDX-License-Identifier: Apache-2.0
// A LoadedDomain is a domain with the objects that its instances need, ready to be traced.
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "bundle/manifest.h"
#include "bundle/packs.h"

namespace vitrail {

// It is a mapped file; whoever shares it decides what else happens when it is released.
using SharedDomain = std::shared_ptr<const MappedDomain>;

class LoadedDomain {
 public:
  // `object(n)` gives object n. The constructor calls it once for each object that the domain needs and that
  // is in a file.
  LoadedDomain(const Manifest& manifest, std::uint32_t domain, SharedDomain mapped,
               const std::function<SharedDomain(std::uint32_t)>& object);
  LoadedDomain(const LoadedDomain&) = delete;  // its view refers to itself
  LoadedDomain& operator=(const LoadedDomain&) = delete;

  const DomainView& view() const { return view_; }

 private:
  SharedDomain mapped_;
  std::vector<SharedDomain> objects_;
  std::vector<DomainView> own_views_;            // of what the manifest, which outlives them, says of objects
  std::vector<const DomainView*> object_views_;  // by number, null where it is not needed
  DomainView view_;
};

// Returns the bytes of memory that a loaded domain takes: its file and the tables of its objects. A table has
// a place for every number up to the greatest.
std::uint64_t bytes_loaded(const Manifest& manifest, std::uint32_t domain);

// Maps and checks a file of a bundle. A file that was `loaded` before has only its checksums compared, which
// show that it is the same. A domain in a pack is mapped from a pack that stays open in `packs`, if given.
SharedDomain map_domain(const Manifest& manifest, const std::filesystem::path& bundle, std::uint32_t domain,
                        OpenPacks* packs = nullptr, bool loaded = false);
SharedDomain map_object(const Manifest& manifest, const std::filesystem::path& bundle, std::uint32_t object,
                        bool loaded = false);

// Maps a domain, with objects that it does not share with other domains.
std::unique_ptr<const LoadedDomain> load_domain(const Manifest& manifest, const std::filesystem::path& bundle,
                                                std::uint32_t domain);

}  // namespace vitrail
