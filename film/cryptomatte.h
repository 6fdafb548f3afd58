// SPDX-License-Identifier: Apache-2.0
// Cryptomatte is the form of mattes that compositors read (Friedman & Jones, "Fully Automatic ID Mattes with
// Support for Motion Blur and Transparency", 2015; Cryptomatte Specification 1.2). Ids are hashes of names,
// as floats. Each pixel has pairs of id and coverage, the greatest coverage first.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "film/film.h"

namespace vitrail {

struct PictureChannel;

// Returns MurmurHash3_x86_32 with seed 0.
std::uint32_t murmur_hash(std::string_view text);
// Returns the hash of a name with an exponent that makes it an ordinary float; never 0.
std::uint32_t matte_id(std::string_view name);

// Returns JSON that maps names to eight hexadecimal digits of their ids.
std::string matte_manifest(std::span<const std::string> names);

// Counts the things that cover something of a pixel; filters below 0 can make coverages of 0 or less.
std::size_t things_of(const MattePixel& pixel);

// Returns "CryptoObject00.R" (an id), ".G" (its coverage), ".B", ".A", "CryptoObject01.R" …: as many as a
// pixel with `most` things needs. No pixel may have more things.
std::vector<PictureChannel> matte_channels(const Film& film, Layer layer, std::size_t most);

}  // namespace vitrail
