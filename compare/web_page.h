// SPDX-License-Identifier: Apache-2.0
// Parts of pages for browsers that hold all they show: no network, no other file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace vitrail {

// RFC 4648, section 4.
std::string base64(std::span<const std::uint8_t> bytes);

// As IEEE half floats, rounded to nearest even, little-endian; what is greater than 65504 is infinite.
std::string half_floats_base64(std::span<const float> values);
std::uint16_t to_half(float value);

// The text with what HTML reads as markup written as entities.
std::string escaped(std::string_view text);

// The page with `json` in place of the word @DATA@, which stands within a <script type="application/json">:
// nothing in it can end the script.
std::string page_with_data(std::string_view page, std::string_view json);

// A file that appears whole or not at all (AtomicFile).
void write_whole(const std::filesystem::path& file, std::string_view text);

}  // namespace vitrail
