// SPDX-License-Identifier: Apache-2.0
// Features name what a file has beyond what every file of its version has. A new feature keeps the version:
// an older program can tell from the bits whether it may go on without it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace vitrail {

// A reader refuses a file with a required feature that it does not know, and ignores an optional one. Bits
// have one meaning in all files of a bundle.
struct Features {
  std::uint32_t required = 0, optional = 0;
  bool operator==(const Features&) const = default;
};

namespace required_feature {
inline constexpr std::uint32_t normals = 1, uvs = 2, attributes = 4, instances = 8, textures = 16,
                               quadrics = 32, procedural = 64, motion = 128, tables = 256, slabs = 512,
                               hair = 1024, curves = 2048, faces = 4096, masking = 8192, decimals = 16384,
                               media_grids = 32768, fadings = 65536, glows = 1 << 17, patterns = 1 << 18,
                               hidden_emitters = 1 << 19, finishes = 1 << 20, veils = 1 << 21,
                               working_gamma = 1 << 22, shadowless = 1 << 23, formulas = 1 << 24,
                               globes = 1 << 25, glazes = 1 << 26, packs = 1 << 27, clips = 1 << 28,
                               codes = 1 << 29, temperatures = 1 << 30, skies = 1u << 31;
}
namespace optional_feature {
inline constexpr std::uint32_t pieces = 1;
}

// They return the names of the bits; a bit without a name gives "feature N".
std::vector<std::string> required_names(std::uint32_t bits);
std::vector<std::string> optional_names(std::uint32_t bits);
// Returns the bits of names. Throws Error for a name that is not known.
std::uint32_t required_bits(std::span<const std::string> names, const std::filesystem::path& file);

// Throws Error unless all that is required is known.
void refuse_unknown(std::uint32_t required, std::uint32_t known, const std::filesystem::path& file);

}  // namespace vitrail
