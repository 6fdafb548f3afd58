// SPDX-License-Identifier: Apache-2.0
#include "farm/scheduler/spill.h"

namespace vitrail {

Spill::Spill(std::size_t domains, std::uint64_t most_bytes)
    : most_(most_bytes), bytes_(domains), fullest_(domains) {}

void Spill::set(std::uint32_t domain, std::uint64_t bytes) {
  if (bytes_[domain] == 0 && bytes > 0) fullest_.insert(domain, bytes);
  if (bytes_[domain] > 0 && bytes == 0) fullest_.erase(domain);
  if (bytes_[domain] > 0 && bytes > 0) fullest_.set(domain, bytes);
  bytes_[domain] = bytes;
}

void Spill::added(std::uint32_t domain, std::uint64_t bytes) {
  held_ += bytes;
  set(domain, bytes_[domain] + bytes);
}

void Spill::removed(std::uint32_t domain, std::uint64_t bytes) {
  held_ -= bytes;
  set(domain, bytes_[domain] - bytes);
}

std::optional<std::uint32_t> Spill::next() const { return held_ > most_ ? fullest_.most() : std::nullopt; }

}  // namespace vitrail
