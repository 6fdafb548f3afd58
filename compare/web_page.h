// SPDX-License-Identifier: Apache-2.0
// These functions make parts of web pages that hold all they show: no network, no other file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace vitrail {

// Encodes bytes as RFC 4648, section 4, says.
std::string base64(std::span<const std::uint8_t> bytes);

// Encodes values as IEEE half floats, rounded to nearest even, little-endian; beyond 65504 they are infinite.
std::string half_floats_base64(std::span<const float> values);
std::uint16_t to_half(float value);

// It is the style of reports: a column of text, drawings, and tables of numbers with words in the first
// column, or in all columns of the class `words`.
inline constexpr std::string_view report_style =
    "body{font:16px/1.5 sans-serif;max-width:60em;margin:2em auto;padding:0 1em;color:#222}"
    "table{border-collapse:collapse;margin:.5em 0 1.5em}td,th{padding:.2em .8em;text-align:right;"
    "border-bottom:1px solid #ddd}th:first-child,td:first-child,.words td,.words th{text-align:left;"
    "vertical-align:top}"
    "svg{max-width:100%;height:auto}";

// Returns the text with what HTML reads as markup written as entities.
std::string escaped(std::string_view text);

// Returns the page with `json` in place of the word @DATA@, which stands within a <script
// type="application/json">. Nothing in `json` can end the script.
std::string page_with_data(std::string_view page, std::string_view json);

// Writes a file that appears whole or not at all (AtomicFile).
void write_whole(const std::filesystem::path& file, std::string_view text);

}  // namespace vitrail
