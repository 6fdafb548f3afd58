// SPDX-License-Identifier: Apache-2.0
#include "farm/plan/set_sheets.h"

#include <algorithm>
#include <bit>

#include "bundle/checksum.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

constexpr std::vector<float> MeasuredSheet::*parts[] = {&MeasuredSheet::wavelengths_nm,
                                                        &MeasuredSheet::cosines, &MeasuredSheet::reflectance,
                                                        &MeasuredSheet::transmittance};

// Of each: the material, then each part's size and bits.
std::vector<std::uint32_t> packed(std::span<const SetSheet> sheets) {
  std::vector<std::uint32_t> words;
  for (const SetSheet& s : sheets) {
    words.push_back(s.material);
    for (const auto part : parts) {
      const std::vector<float>& values = s.sheet.*part;
      words.push_back(static_cast<std::uint32_t>(values.size()));
      for (const float value : values) words.push_back(std::bit_cast<std::uint32_t>(value));
    }
  }
  return words;
}

std::vector<SetSheet> unpacked(std::span<const std::uint32_t> words) {
  std::vector<SetSheet> sheets;
  std::size_t at = 0;
  while (at < words.size()) {
    SetSheet& s = sheets.emplace_back();
    s.material = words[at++];
    for (const auto part : parts) {
      const std::size_t end = at + 1 + words[at];
      for (++at; at < end; ++at) (s.sheet.*part).push_back(std::bit_cast<float>(words[at]));
    }
  }
  return sheets;
}

}  // namespace

void share_from_root(Transport& transport, std::vector<SetSheet>& sheets) {
  std::vector<std::uint32_t> words;
  if (transport.rank() == 0) words = packed(sheets);
  std::uint64_t count[] = {words.size()};
  transport.broadcast_from_root(std::span(count));
  words.resize(count[0]);
  transport.broadcast_from_root(std::span(words));
  sheets = unpacked(words);
}

void set_sheets(std::span<const SetSheet> sheets, const std::filesystem::path& bundle, Manifest& manifest) {
  bool changed = false;
  for (const SetSheet& s : sheets) {
    auto* measured = s.material < manifest.materials.size()
                         ? std::get_if<MeasuredMaterial>(&manifest.materials[s.material].model)
                         : nullptr;
    if (!measured || !measured->sheet)
      throw Error("the glazing names a material that is no sheet", {bundle.string()});
    changed = changed || *measured->sheet != s.sheet;
    measured->sheet = s.sheet;
  }
  if (!changed) return;
  const std::vector<std::uint32_t> words = packed(sheets);
  Hasher hasher;
  hasher.add(std::as_bytes(std::span(&manifest.scene_hash, 1)));
  hasher.add(std::as_bytes(std::span(words)));
  manifest.scene_hash = hasher.digest();
}

}  // namespace vitrail
