// SPDX-License-Identifier: Apache-2.0
#include "film/png_file.h"

#include <fmt/format.h>

#include <png.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <span>
#include <vector>

#include "film/alpha.h"
#include "film/fixed_date.h"
#include "film/srgb_integers.h"
#include "scene/system/atomic_file.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

// libpng ends a call that fails by a jump, over which nothing may be destroyed: so each function that calls
// it has plain variables alone, and no exception passes through it. False: it failed, and `why` says how.
class PngEncoder {
 public:
  PngEncoder() {
    png_ = ::png_create_write_struct(PNG_LIBPNG_VER_STRING, this, fail, ignore);
    info_ = png_ ? ::png_create_info_struct(png_) : nullptr;
  }
  ~PngEncoder() { ::png_destroy_write_struct(&png_, &info_); }
  PngEncoder(const PngEncoder&) = delete;
  PngEncoder& operator=(const PngEncoder&) = delete;

  bool begin(const Picture& picture, int bits, bool has_alpha, const png_time& date, std::string& comment) {
    char comment_key[] = "Comment", software_key[] = "Software";
    png_text text{}, software{};
    text.compression = software.compression = PNG_TEXT_COMPRESSION_NONE;
    text.key = comment_key, text.text = comment.data();
    software.key = software_key, software.text = const_cast<char*>(picture.origin.software.c_str());
    if (!info_ || setjmp(png_jmpbuf(png_))) return false;
    ::png_set_write_fn(png_, this, append, nullptr);
    ::png_set_IHDR(png_, info_, static_cast<png_uint_32>(picture.rgb.width),
                   static_cast<png_uint_32>(picture.rgb.height), bits,
                   has_alpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                   PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    ::png_set_sRGB_gAMA_and_cHRM(png_, info_, PNG_sRGB_INTENT_ABSOLUTE);
    ::png_set_oFFs(png_, info_, picture.window.x0, picture.window.y0, PNG_OFFSET_PIXEL);
    ::png_set_tIME(png_, info_, &date);
    if (!comment.empty()) ::png_set_text(png_, info_, &text, 1);
    if (!picture.origin.software.empty()) ::png_set_text(png_, info_, &software, 1);
    ::png_write_info(png_, info_);
    if (bits == 16 && std::endian::native == std::endian::little) ::png_set_swap(png_);
    return true;
  }
  bool row(const void* integers) {
    if (setjmp(png_jmpbuf(png_))) return false;
    ::png_write_row(png_, static_cast<png_const_bytep>(integers));
    return true;
  }
  bool end() {
    if (setjmp(png_jmpbuf(png_))) return false;
    ::png_write_end(png_, nullptr);
    return true;
  }

  const char* why() const { return why_; }
  // What was encoded and not yet taken away.
  std::vector<std::byte>& bytes() { return bytes_; }

 private:
  static void fail(png_structp png, png_const_charp message) {
    std::snprintf(static_cast<PngEncoder*>(::png_get_error_ptr(png))->why_, sizeof why_, "%s", message);
    ::png_longjmp(png, 1);
  }
  static void ignore(png_structp, png_const_charp) {}
  static void append(png_structp png, png_bytep data, png_size_t size) {
    if (!static_cast<PngEncoder*>(::png_get_io_ptr(png))->has_appended({data, size}))
      ::png_error(png, "out of memory");
  }
  bool has_appended(std::span<const png_byte> data) {
    try {
      const auto more = std::as_bytes(data);
      bytes_.insert(bytes_.end(), more.begin(), more.end());
      return true;
    } catch (const std::exception&) {
      return false;
    }
  }

  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  char why_[128] = "libpng cannot begin";
  std::vector<std::byte> bytes_;
};

png_time png_date() {
  const std::tm date = fixed_date();
  const auto byte = [](int number) { return static_cast<png_byte>(number); };
  return {static_cast<png_uint_16>(1900 + date.tm_year),
          byte(1 + date.tm_mon),
          byte(date.tm_mday),
          byte(date.tm_hour),
          byte(date.tm_min),
          byte(date.tm_sec)};
}

// Behind each colour its coverage, which no transfer function encodes.
template <class Integer>
std::vector<Integer> with_alpha(std::span<const Integer> colors, std::span<const float> alpha) {
  constexpr float most = std::numeric_limits<Integer>::max();
  std::vector<Integer> row;
  for (std::size_t x = 0; x < alpha.size(); ++x) {
    row.insert(row.end(), colors.begin() + static_cast<std::ptrdiff_t>(3 * x),
               colors.begin() + static_cast<std::ptrdiff_t>(3 * x + 3));
    row.push_back(static_cast<Integer>(std::lround(most * std::clamp(alpha[x], 0.0f, 1.0f))));
  }
  return row;
}

// Row by row: beside the picture there is never more than a megabyte of the file.
template <class Integer>
void write_rows(const std::filesystem::path& file, const Picture& picture) {
  constexpr std::size_t much = std::size_t{1} << 20;
  AtomicFile target(file);
  PngEncoder encoder;
  const auto require = [&](bool done) {
    if (!done) throw MachineError(fmt::format("cannot write {}: {}", file.string(), encoder.why()));
    if (encoder.bytes().size() < much) return;
    target.write(encoder.bytes());
    encoder.bytes().clear();
  };
  std::string comment = comment_on(picture.origin);
  const PictureChannel* const alpha = alpha_of(picture);
  require(
      encoder.begin(picture, static_cast<int>(8 * sizeof(Integer)), alpha != nullptr, png_date(), comment));
  const std::size_t width = static_cast<std::size_t>(picture.rgb.width), values = 3 * width;
  std::vector<Integer> row(values);
  for (std::size_t at = 0; at < picture.rgb.values.size(); at += values) {
    to_srgb_integers<Integer>(std::span(picture.rgb.values).subspan(at, values), row.data());
    require(encoder.row(alpha
                            ? with_alpha<Integer>(row, std::span(alpha->values).subspan(at / 3, width)).data()
                            : row.data()));
  }
  require(encoder.end());
  target.write(encoder.bytes());
  target.commit();
}

}  // namespace

std::string comment_on(const PictureOrigin& origin) {
  return origin.denoiser.empty() ? "" : "denoised by " + origin.denoiser;
}

void write_png(const std::filesystem::path& file, const Picture& picture, int bits) {
  if (bits == 16) return write_rows<std::uint16_t>(file, picture);
  write_rows<std::uint8_t>(file, picture);
}

}  // namespace vitrail
