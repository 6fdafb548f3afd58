// SPDX-License-Identifier: Apache-2.0
#include "bundle/features.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

// By bit.
constexpr std::array required{
    "normals",  "uvs",           "attributes",   "instances", "textures", "quadrics",        "procedural",
    "motion",   "tables",        "slabs",        "hair",      "curves",   "faces",           "masking",
    "decimals", "media_grids",   "fadings",      "glows",     "patterns", "hidden_emitters", "finishes",
    "veils",    "working_gamma", "shadowless",   "formulas",  "globes",   "glazes",          "packs",
    "clips",    "codes",         "temperatures", "skies"};
constexpr std::array optional{"pieces"};

std::vector<std::string> names(std::uint32_t bits, std::span<const char* const> known) {
  std::vector<std::string> found;
  for (std::size_t i = 0; i < 32; ++i)
    if (bits >> i & 1) found.push_back(i < known.size() ? known[i] : fmt::format("feature {}", i));
  return found;
}

// 0 where it is not known.
std::uint32_t bit(const std::string& name, std::span<const char* const> known) {
  const auto at = std::ranges::find(known, name);
  return at == known.end() ? 0 : 1u << (at - known.begin());
}

[[noreturn]] void refuse(const std::string& name, const std::filesystem::path& file) {
  throw Error(fmt::format("it needs '{}', which this program does not know: read it with a newer one, or "
                          "partition the scene again",
                          name),
              {file.string()});
}

}  // namespace

std::vector<std::string> required_names(std::uint32_t bits) { return names(bits, required); }
std::vector<std::string> optional_names(std::uint32_t bits) { return names(bits, optional); }

std::uint32_t required_bits(std::span<const std::string> of, const std::filesystem::path& file) {
  std::uint32_t bits = 0;
  for (const std::string& name : of) {
    if (!bit(name, required)) refuse(name, file);
    bits |= bit(name, required);
  }
  return bits;
}

void refuse_unknown(std::uint32_t bits, std::uint32_t known, const std::filesystem::path& file) {
  if (bits & ~known) refuse(required_names(bits & ~known).front(), file);
}

}  // namespace vitrail
