// SPDX-License-Identifier: Apache-2.0
#include "images/jpeg_rows.h"

#include <fmt/format.h>

#include <csetjmp>
#include <cstddef>
#include <cstdio>
// After <cstdio>, which it does not include.
#include <jerror.h>
#include <jpeglib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "images/image_files.h"
#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"
#include "scene/system/memory_guard.h"

namespace vitrail {

namespace {

// libjpeg ends a call that fails by a jump, over which nothing may be destroyed: so each function that calls
// it has plain variables alone, and no exception passes through it. False: it failed, and `why` says how. It
// goes on where data are damaged, as the image library does. Where they end too early it would too; that
// fails here.
class JpegDecoder {
 public:
  explicit JpegDecoder(const std::filesystem::path& file) : in_(open_input(file)) {
    info_.err = ::jpeg_std_error(&errors_);
    errors_.error_exit = fail;
    errors_.emit_message = warn;
    info_.client_data = this;
  }
  ~JpegDecoder() { ::jpeg_destroy_decompress(&info_); }
  JpegDecoder(const JpegDecoder&) = delete;
  JpegDecoder& operator=(const JpegDecoder&) = delete;

  bool read_header() {
    if (setjmp(jump_)) return false;
    ::jpeg_create_decompress(&info_);
    source_.init_source = source_.term_source = [](j_decompress_ptr) {};
    source_.fill_input_buffer = fill;
    source_.skip_input_data = skip;
    source_.resync_to_restart = ::jpeg_resync_to_restart;
    info_.src = &source_;
    if (::jpeg_read_header(&info_, TRUE) != JPEG_HEADER_OK) return false;
    has_many_scans_ = ::jpeg_has_multiple_scans(&info_);
    return true;
  }
  bool start() {
    if (setjmp(jump_)) return false;
    ::jpeg_start_decompress(&info_);
    if (has_many_scans_ && ended_) ERREXIT(&info_, JERR_INPUT_EOF);  // all of them are read now
    return true;
  }
  bool read_row(std::uint8_t* row) {
    if (setjmp(jump_)) return false;
    return ::jpeg_read_scanlines(&info_, &row, 1) == 1;
  }

  bool has_many_scans() const { return has_many_scans_; }
  const jpeg_decompress_struct& info() const { return info_; }
  const char* why() const { return why_.data(); }

 private:
  static JpegDecoder& of(void* client) { return *static_cast<JpegDecoder*>(client); }
  static void fail(j_common_ptr info) {
    JpegDecoder& self = of(info->client_data);
    info->err->format_message(info, self.why_.data());
    longjmp(self.jump_, 1);
  }
  // Nothing is missed where the end alone is not there: a warning comes with the first lack.
  static void warn(j_common_ptr info, int level) {
    if (level < 0 && of(info->client_data).ended_) ERREXIT(info, JERR_INPUT_EOF);
  }
  static boolean fill(j_decompress_ptr info) {
    JpegDecoder& self = of(info->client_data);
    self.in_.read(reinterpret_cast<char*>(self.input_.data()), self.input_.size());
    auto bytes = static_cast<std::size_t>(self.in_.gcount());
    if (bytes == 0) {
      self.ended_ = true;
      self.input_[0] = 0xff, self.input_[1] = JPEG_EOI;
      bytes = 2;
    }
    self.source_.next_input_byte = self.input_.data();
    self.source_.bytes_in_buffer = bytes;
    return TRUE;
  }
  static void skip(j_decompress_ptr info, long bytes) {
    jpeg_source_mgr& source = of(info->client_data).source_;
    for (auto left = static_cast<std::size_t>(std::max(bytes, 0L)); left > 0;) {
      if (source.bytes_in_buffer == 0) fill(info);
      if (of(info->client_data).ended_) return;
      const std::size_t now = std::min(left, source.bytes_in_buffer);
      source.next_input_byte += now, source.bytes_in_buffer -= now, left -= now;
    }
  }

  std::ifstream in_;
  bool ended_ = false, has_many_scans_ = false;
  std::array<JOCTET, 1 << 14> input_;
  std::array<char, JMSG_LENGTH_MAX> why_{};
  std::jmp_buf jump_;
  jpeg_error_mgr errors_{};
  jpeg_source_mgr source_{};
  jpeg_decompress_struct info_{};
};

bool is_plain(const jpeg_decompress_struct& info) {
  const bool grey = info.num_components == 1 && info.jpeg_color_space == JCS_GRAYSCALE;
  const bool rgb =
      info.num_components == 3 && (info.jpeg_color_space == JCS_YCbCr || info.jpeg_color_space == JCS_RGB);
  return (grey || rgb) && info.data_precision == 8 && info.image_width <= max_image_extent &&
         info.image_height <= max_image_extent &&
         std::uint64_t{info.image_width} * info.image_height <= most_image_pixels;
}

// What libjpeg takes: some rows of blocks; all coefficients of 2 bytes where the picture comes in several
// scans.
std::uint64_t decoding_bytes(const JpegDecoder& decoder) {
  const jpeg_decompress_struct& info = decoder.info();
  constexpr std::uint64_t least = 1 << 17, a_column = 96;
  const auto width = std::uint64_t{info.image_width};
  std::uint64_t bytes = least + a_column * width;
  if (!decoder.has_many_scans()) return bytes;
  for (int c = 0; c < info.num_components; ++c) {
    const jpeg_component_info& component = info.comp_info[c];
    bytes += std::uint64_t{component.width_in_blocks + 4} * (component.height_in_blocks + 4) * sizeof(JBLOCK);
  }
  return bytes;
}

void read_jpeg(const std::filesystem::path& file,
               const std::function<void(std::span<const std::uint8_t>)>& visit) {
  const auto decoder = std::make_unique<JpegDecoder>(file);
  const auto fail = [&](const std::string& problem) {
    throw Error(fmt::format("cannot read the image: {}", problem), {file.string()});
  };
  if (!decoder->read_header() || !is_plain(decoder->info())) fail("it has changed");
  const GrantedMemory decoding(decoding_bytes(*decoder));
  if (!decoder->start()) fail(decoder->why());
  const jpeg_decompress_struct& info = decoder->info();
  std::vector<std::uint8_t> row(std::size_t{info.output_width} *
                                static_cast<std::size_t>(info.output_components));
  for (std::uint32_t y = 0; y < info.output_height; ++y) {
    if (!decoder->read_row(row.data()))
      fail(fmt::format("{} (in row {} of {})", decoder->why(), y + 1, info.output_height));
    const GuardedMemory ours;
    visit(row);
  }
}

}  // namespace

std::optional<ByteRows> jpeg_rows(const std::filesystem::path& file) {
  const auto decoder = std::make_unique<JpegDecoder>(file);
  if (!decoder->read_header() || !is_plain(decoder->info())) return {};
  const jpeg_decompress_struct& info = decoder->info();
  return ByteRows{static_cast<int>(info.image_width), static_cast<int>(info.image_height),
                  info.num_components, [file](const auto& visit) { read_jpeg(file, visit); },
                  decoding_bytes(*decoder)};
}

}  // namespace vitrail
