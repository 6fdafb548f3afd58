// SPDX-License-Identifier: Apache-2.0
// These functions read and write pictures. Reading all but .exr, and writing .webp, loads OpenImageIO
// (images/image_codec.h), which takes 0.3 s and 130 MB; unusual .exr loads it, too (plain_exr.h).
#pragma once

#include <filesystem>
#include <memory>

#include "film/develop.h"

namespace vitrail {

// Writes a picture in the format of the file's extension:
// .exr is 32-bit float, linear, with its origin as attributes. Beside R, G, B it has `Variance.Y` if the
// picture has variances, `S0.580,000000nm` and the like if it has spectra, and the layers. Ids are 32-bit
// integers, masks are Cryptomatte. .hdr is Radiance's RGBE, linear, only the colours. .png, .jpg, .tif,
// .webp have sRGB's transfer function, clamped, rounded to nearest, of 8 or 16 `bits` (0: usual_bits).
// The description of a denoised one names the denoiser. The file appears whole or not at all. Its date is
// SOURCE_DATE_EPOCH or 1970, so equal pictures give equal files. Other extensions, and bits that a format
// does not have, throw UsageError.
void write_picture(const std::filesystem::path& file, const Picture& picture, int bits = 0);

// ExrRows is an .exr that is written as its rows come, so that the whole picture is never in memory. The file
// is the one that write_picture makes of all of them.
class ExrRows {
 public:
  // `top` has the first rows; all rows have its channels. What it says of samples, error and origin is of the
  // whole picture, which has `height` rows.
  ExrRows(const std::filesystem::path& file, const Picture& top, int height);
  ~ExrRows();
  // Adds the next rows from the top, `top` first.
  void add(const Picture& rows);
  void commit();

 private:
  std::unique_ptr<class ExrFile> file_;
};

// Returns the bits of a channel, by the file's name: 32 (floats), 16 or 8; 0 where it cannot be written.
int usual_bits(const std::filesystem::path& file);

// Returns `bits`, or the usual ones for 0. Throws UsageError where write_picture does.
int chosen_bits(const std::filesystem::path& file, int bits);

// Reads any format OpenImageIO knows: channels R, G, B, else the first three, or one for grey. Integer pixels
// are decoded from sRGB. Throws Error with the file's name.
Picture read_picture(const std::filesystem::path& file);

}  // namespace vitrail
