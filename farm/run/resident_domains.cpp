// SPDX-License-Identifier: Apache-2.0
#include "farm/run/resident_domains.h"

#include <algorithm>

#include "tracer/intersect/embree_domain.h"

namespace vitrail {

ResidentDomains::ResidentDomains(const Manifest& manifest, std::filesystem::path bundle, Traversal traversal)
    : manifest_(manifest),
      bundle_(std::move(bundle)),
      traversal_(traversal),
      touched_(manifest.domains.size()),
      objects_(manifest.objects.size()),
      objects_touched_(manifest.objects.size()),
      released_(std::make_shared<std::atomic<std::uint64_t>>(0)) {
  ResidentTable empty;
  empty.domains.resize(manifest.domains.size());
  empty.views.resize(manifest.domains.size());
  table_ = std::make_shared<const ResidentTable>(std::move(empty));
}

std::optional<Reservation> ResidentDomains::begin(LoadStep step) {
  std::optional<Reservation> reservation;
  if (step.load) {
    const bool again = touched_[step.load->domain];
    reservation.emplace(Reservation{std::move(*step.load), {}, again});
    const std::vector<std::uint32_t>& missing = reservation->load.missing;
    for (const std::uint32_t object : manifest_.domains[reservation->load.domain].objects)
      if (!manifest_.objects[object].quadric && !std::ranges::binary_search(missing, object))
        reservation->held.emplace(object, objects_[object].lock());
  }
  if (!step.evicted.empty()) {
    auto next = std::make_shared<ResidentTable>(*table_);
    for (const std::uint32_t domain : step.evicted) {
      next->views[domain] = nullptr;
      next->domains[domain] = nullptr;
    }
    table_ = std::move(next);
  }
  return reservation;
}

// The same file, whose `bytes`, and those of the tables that go with it, are told when it is let go.
SharedDomain ResidentDomains::counted(SharedDomain mapped, std::uint64_t bytes) const {
  const MappedDomain* const file = mapped.get();
  return {file, [mapped = std::move(mapped), released = released_, bytes](const MappedDomain*) mutable {
            mapped.reset();
            *released += bytes;
          }};
}

std::shared_ptr<const DomainView> ResidentDomains::load(const Reservation& reservation) {
  const auto object = [&](std::uint32_t number) {
    if (const auto held = reservation.held.find(number); held != reservation.held.end()) return held->second;
    std::uint8_t& touched = objects_touched_[number];
    SharedDomain mapped =
        counted(map_object(manifest_, bundle_, number, touched != 0), manifest_.objects[number].bytes);
    touched = 1;
    objects_[number] = mapped;
    return mapped;
  };
  const std::uint32_t domain = reservation.load.domain;
  SharedDomain mapped = counted(map_domain(manifest_, bundle_, domain, &packs_, reservation.again),
                                bytes_loaded(manifest_, domain));
  auto loaded = std::make_shared<const LoadedDomain>(manifest_, domain, std::move(mapped), object);
  const DomainView* const view = &loaded->view();
  if (traversal_ == Traversal::own) return {std::move(loaded), view};
  const auto* const tree = new EmbreeDomain(*view, EmbreeDomain::Instances::by_kernel);
  return {tree, [loaded = std::move(loaded)](const EmbreeDomain* it) { delete it; }};
}

void ResidentDomains::insert(std::uint32_t domain, std::shared_ptr<const DomainView> loaded) {
  touched_[domain] = true;
  auto next = std::make_shared<ResidentTable>(*table_);
  next->views[domain] = loaded.get();
  next->domains[domain] = std::move(loaded);
  table_ = std::move(next);
}

}  // namespace vitrail
