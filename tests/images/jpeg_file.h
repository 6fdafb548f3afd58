// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
// After <cstdio>, which it does not include.
#include <jpeglib.h>

#include <string>
#include <vector>

namespace vitrail::test {

struct JpegKind {
  int channels = 3;  // 1: grey, 3: RGB, 4: CMYK
  bool progressive = false, subsampled = true;
  unsigned restart_rows = 0;
  bool turned = false;  // EXIF says that the picture is to be turned by a quarter
};

// The bytes of a JPEG of such pixels; `pixels` has width · height · channels.
inline std::string jpeg_of(int width, const std::vector<std::uint8_t>& pixels, const JpegKind& kind) {
  jpeg_compress_struct info;
  jpeg_error_mgr errors;
  info.err = ::jpeg_std_error(&errors);
  ::jpeg_create_compress(&info);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  ::jpeg_mem_dest(&info, &bytes, &size);
  const auto row = static_cast<std::size_t>(width * kind.channels);
  info.image_width = static_cast<unsigned>(width);
  info.image_height = static_cast<unsigned>(pixels.size() / row);
  info.input_components = kind.channels;
  info.in_color_space = kind.channels == 1 ? JCS_GRAYSCALE : kind.channels == 3 ? JCS_RGB : JCS_CMYK;
  ::jpeg_set_defaults(&info);
  if (kind.progressive) ::jpeg_simple_progression(&info);
  if (!kind.subsampled) info.comp_info[0].h_samp_factor = info.comp_info[0].v_samp_factor = 1;
  info.restart_in_rows = static_cast<int>(kind.restart_rows);
  ::jpeg_start_compress(&info, TRUE);
  constexpr JOCTET exif[] = {'E', 'x', 'i', 'f', 0, 0, 'M', 'M', 0, 42, 0, 0, 0, 8, 0, 1,
                             1,   18,  0,   3,   0, 0, 0,   1,   0, 6,  0, 0, 0, 0, 0, 0};
  if (kind.turned) ::jpeg_write_marker(&info, JPEG_APP0 + 1, exif, sizeof exif);
  while (info.next_scanline < info.image_height) {
    auto* scanline = const_cast<JSAMPLE*>(&pixels[info.next_scanline * row]);
    ::jpeg_write_scanlines(&info, &scanline, 1);
  }
  ::jpeg_finish_compress(&info);
  ::jpeg_destroy_compress(&info);
  std::string result(reinterpret_cast<char*>(bytes), size);
  std::free(bytes);
  return result;
}

}  // namespace vitrail::test
