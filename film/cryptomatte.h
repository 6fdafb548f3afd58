// SPDX-License-Identifier: Apache-2.0
// Mattes as compositors read them (Friedman & Jones, "Fully Automatic ID Mattes with Support for Motion Blur
// and Transparency", 2015; Cryptomatte Specification 1.2): ids are hashes of names, as floats; of each pixel,
// pairs of id and coverage, the greatest coverage first.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "film/film.h"

namespace vitrail {

struct PictureChannel;

// MurmurHash3_x86_32 with seed 0.
std::uint32_t murmur_hash(std::string_view text);
// The hash of a name with an exponent that makes it an ordinary float; never 0.
std::uint32_t matte_id(std::string_view name);

// JSON, names to eight hexadecimal digits of their ids.
std::string matte_manifest(std::span<const std::string> names);

// What covers something of a pixel: what covers nothing or less, by filters that go below 0, is left out.
std::size_t things_of(const MattePixel& pixel);

// "CryptoObject00.R" (an id), ".G" (its coverage), ".B", ".A", "CryptoObject01.R" …: as many as a pixel with
// `most` things needs, which no pixel has more of.
std::vector<PictureChannel> matte_channels(const Film& film, Layer layer, std::size_t most);

}  // namespace vitrail
