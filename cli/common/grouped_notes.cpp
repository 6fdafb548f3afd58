// SPDX-License-Identifier: Apache-2.0
#include "cli/common/grouped_notes.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace vitrail {

namespace {

int rank_of(RecordKind kind) {
  switch (kind) {
    case RecordKind::camera:
    case RecordKind::integrator:
    case RecordKind::film:
      return 0;
    case RecordKind::light:
    case RecordKind::area_light:
    case RecordKind::medium:
      return 1;
    case RecordKind::any:
    case RecordKind::material:
      return 2;
    case RecordKind::texture:
      return 3;
    case RecordKind::object:
    case RecordKind::instance:
    case RecordKind::shape:
      return 4;
    case RecordKind::sampler:
      return 5;
  }
  return 5;
}

// Without the name of what it is about: `material "wood": …` as `material: …`.
std::string without_name(const std::string& message) {
  const std::size_t open = message.find(" \"");
  if (open == std::string::npos || message.find(' ') != open) return message;
  const std::size_t close = message.find("\": ", open + 2);
  return close == std::string::npos ? message : message.substr(0, open) + message.substr(close + 1);
}

}  // namespace

std::vector<NoteGroup> grouped_notes(const Diagnostics& diagnostics) {
  std::vector<NoteGroup> groups;
  std::map<std::tuple<Fidelity, RecordKind, std::string>, std::size_t> known;
  for (const Diagnostic& d : diagnostics) {
    const auto [at, is_new] = known.try_emplace({d.fidelity, d.kind, without_name(d.message)}, groups.size());
    if (is_new) groups.push_back({d.fidelity, d.kind, d.message, {}});
    groups[at->second].places.push_back(d.location);
  }
  std::ranges::stable_sort(groups, {}, [](const NoteGroup& g) {
    return std::pair(g.fidelity == Fidelity::dropped ? 0 : 1, rank_of(g.kind));
  });
  return groups;
}

}  // namespace vitrail
