// SPDX-License-Identifier: Apache-2.0
// A PictureFormat is one that pictures are written in; these functions say what each takes.
#pragma once

#include <cstdint>
#include <filesystem>

namespace vitrail {

enum class PictureFormat : std::uint8_t { none, exr, hdr, png, jpeg, tiff, webp };

// Returns the format by the extension of the file's name; none where no program writes such pictures.
PictureFormat picture_format(const std::filesystem::path& file);

// These hold the light of the scene. The others hold what a screen shows.
constexpr bool holds_light(PictureFormat f) { return f == PictureFormat::exr || f == PictureFormat::hdr; }

// `render` writes these itself. For the others, and to denoise, it starts `vitrail-develop`.
constexpr bool written_by_render(PictureFormat f) {
  return f == PictureFormat::png || f == PictureFormat::jpeg || f == PictureFormat::tiff;
}

// Writing these loads OpenImageIO.
constexpr bool needs_image_library(PictureFormat f) { return f == PictureFormat::webp; }

}  // namespace vitrail
