// SPDX-License-Identifier: Apache-2.0
#include "film/jpeg_file.h"

#include <fmt/format.h>

#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <span>
#include <string>
#include <vector>
// After <cstdio>, which it does not include.
#include <jpeglib.h>

#include "film/fixed_date.h"
#include "film/png_file.h"
#include "film/srgb_integers.h"
#include "film/tiff_directory.h"
#include "scene/system/atomic_file.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

TiffBytes exif_of(const PictureOrigin& origin) {
  constexpr std::uint16_t description = 0x010e, software = 0x0131, date_time = 0x0132, more = 0x8769,
                          color_space = 0xa001;
  constexpr std::size_t header = 8;
  TiffDirectory first, second;
  const auto fill = [&](std::size_t at_second) {
    first = TiffDirectory();
    first.text(description, comment_on(origin));
    first.text(software, origin.software);
    first.text(date_time, fixed_date_text());
    first.number(more, TiffDirectory::Type::of_32_bits, at_second);
  };
  fill(0);
  fill(header + first.size());
  second.number(color_space, TiffDirectory::Type::of_16_bits, 1);  // sRGB
  TiffBytes bytes{'E', 'x', 'i', 'f', 0, 0, 'I', 'I', 42, 0, header, 0, 0, 0};
  first.append_to(bytes, header);
  second.append_to(bytes, header + first.size());
  return bytes;
}

// libjpeg ends a call that fails by a jump, over which nothing may be destroyed: so each function that calls
// it has plain variables alone, and no exception passes through it. False: it failed, and `why` says how.
class JpegEncoder {
 public:
  JpegEncoder() {
    info_.err = ::jpeg_std_error(&errors_);
    errors_.error_exit = fail;
    info_.client_data = this;
  }
  ~JpegEncoder() { ::jpeg_destroy_compress(&info_); }
  JpegEncoder(const JpegEncoder&) = delete;
  JpegEncoder& operator=(const JpegEncoder&) = delete;

  bool begin(int width, int height, std::span<const std::uint8_t> exif) {
    if (setjmp(jump_)) return false;
    ::jpeg_create_compress(&info_);
    target_.init_destination = [](j_compress_ptr info) { of(info).offer(); };
    target_.empty_output_buffer = [](j_compress_ptr info) -> boolean {
      of(info).filled_ = of(info).block_.size();
      return of(info).take() ? TRUE : FALSE;
    };
    target_.term_destination = [](j_compress_ptr info) {
      of(info).filled_ = of(info).block_.size() - of(info).target_.free_in_buffer;
      of(info).take();
    };
    info_.dest = &target_;
    info_.image_width = static_cast<JDIMENSION>(width), info_.image_height = static_cast<JDIMENSION>(height);
    info_.input_components = 3, info_.in_color_space = JCS_RGB;
    ::jpeg_set_defaults(&info_);
    ::jpeg_set_quality(&info_, 95, TRUE);
    for (int c = 0; c < info_.num_components; ++c)
      info_.comp_info[c].h_samp_factor = info_.comp_info[c].v_samp_factor = 1;
    ::jpeg_start_compress(&info_, TRUE);
    ::jpeg_write_marker(&info_, JPEG_APP0 + 1, exif.data(), static_cast<unsigned>(exif.size()));
    return true;
  }
  bool row(std::uint8_t* integers) {
    if (setjmp(jump_)) return false;
    return ::jpeg_write_scanlines(&info_, &integers, 1) == 1;
  }
  bool end() {
    if (setjmp(jump_)) return false;
    ::jpeg_finish_compress(&info_);
    return true;
  }

  const char* why() const { return why_.data(); }
  // What was encoded and not yet taken away.
  std::vector<std::byte>& bytes() { return bytes_; }

 private:
  static JpegEncoder& of(j_compress_ptr info) { return *static_cast<JpegEncoder*>(info->client_data); }
  static void fail(j_common_ptr info) {
    auto& self = *static_cast<JpegEncoder*>(info->client_data);
    info->err->format_message(info, self.why_.data());
    longjmp(self.jump_, 1);
  }
  void offer() {
    target_.next_output_byte = block_.data();
    target_.free_in_buffer = block_.size();
  }
  // False where memory ends.
  bool take() {
    offer();
    try {
      const auto more = std::as_bytes(std::span(block_).first(filled_));
      bytes_.insert(bytes_.end(), more.begin(), more.end());
      return true;
    } catch (const std::exception&) {
      std::snprintf(why_.data(), why_.size(), "out of memory");
      return false;
    }
  }

  std::array<JOCTET, 1 << 14> block_;
  std::size_t filled_ = 0;
  std::array<char, JMSG_LENGTH_MAX> why_{"libjpeg cannot begin"};
  std::jmp_buf jump_;
  jpeg_error_mgr errors_{};
  jpeg_destination_mgr target_{};
  jpeg_compress_struct info_{};
  std::vector<std::byte> bytes_;
};

}  // namespace

void write_jpeg(const std::filesystem::path& file, const Picture& picture) {
  constexpr int widest = 65500;  // libjpeg's
  if (picture.rgb.width > widest || picture.rgb.height > widest)
    throw MachineError(
        fmt::format("cannot write {}: a .jpg has {} pixels a side at most", file.string(), widest));
  AtomicFile target(file);
  JpegEncoder encoder;
  const auto require = [&](bool done) {
    if (!done) throw MachineError(fmt::format("cannot write {}: {}", file.string(), encoder.why()));
    target.write(encoder.bytes());
    encoder.bytes().clear();
  };
  require(encoder.begin(picture.rgb.width, picture.rgb.height, exif_of(picture.origin)));
  std::vector<std::uint8_t> row(3 * static_cast<std::size_t>(picture.rgb.width));
  for (std::size_t at = 0; at < picture.rgb.values.size(); at += row.size()) {
    to_srgb_integers<std::uint8_t>(std::span(picture.rgb.values).subspan(at, row.size()), row.data());
    require(encoder.row(row.data()));
  }
  require(encoder.end());
  target.commit();
}

}  // namespace vitrail
