// SPDX-License-Identifier: Apache-2.0
#include "film/image_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <ctime>
#include <span>

#include "film/cryptomatte.h"
#include "film/exr_file.h"
#include "film/fixed_date.h"
#include "film/jpeg_file.h"
#include "film/picture_attributes.h"
#include "film/picture_format.h"
#include "film/png_file.h"
#include "film/radiance_file.h"
#include "film/srgb_integers.h"
#include "film/tiff_file.h"
#include "images/image_codec.h"
#include "scene/system/atomic_file.h"
#include "scene/system/diagnostics.h"
#include "scene/system/memory_guard.h"

namespace vitrail {

namespace {

PictureFile file_of(const Picture& picture) {
  return {.width = picture.rgb.width,
          .height = picture.rgb.height,
          .x = picture.window.x0,
          .y = picture.window.y0,
          .full_width = std::max(picture.full_width, picture.rgb.width),
          .full_height = std::max(picture.full_height, picture.rgb.height),
          .attributes = {{"DateTime", fixed_date_text()}}};
}

std::vector<std::byte> encoded(const std::filesystem::path& file, const PictureFile& picture,
                               const void* pixels) {
  constexpr std::uint64_t opening = 1 << 20, copies = 3;
  const ImageCodec& codec = image_codec();
  const GrantedMemory encoding(
      opening + copies * static_cast<std::uint64_t>(picture.bits / 8) * picture.channels.size() *
                    static_cast<std::uint64_t>(picture.width) * static_cast<std::uint64_t>(picture.height));
  std::vector<std::byte> bytes;
  if (const std::string problem = codec.encode_picture(file.string(), picture, pixels, bytes);
      !problem.empty())
    throw MachineError(fmt::format("cannot write {}: {}", file.string(), problem));
  return bytes;
}

void write_bytes(const std::filesystem::path& file, std::span<const std::byte> bytes) {
  AtomicFile target(file);
  target.write(bytes);
  target.commit();
}

// The layout of Fichet, Pacanowski & Wilkie 2021: the wavelength of a bin's centre, with a decimal comma.
std::string spectral_channel(double nm) {
  std::string name = fmt::format("S0.{:.6f}nm", nm);
  name[name.find('.', 3)] = ',';
  return name;
}

// A channel of a file: of an image, or of its own.
struct Plane {
  std::string name;
  const Image* image = nullptr;
  std::size_t channel = 0;
  const PictureChannel* own = nullptr;

  bool is_id() const { return own && own->is_id; }
  std::uint32_t bits(std::size_t pixel) const {
    if (is_id()) return own->ids[pixel];
    return std::bit_cast<std::uint32_t>(
        own ? own->values[pixel]
            : image->values[pixel * static_cast<std::size_t>(image->channels) + channel]);
  }
};

std::vector<Plane> planes_of(const Picture& picture) {
  std::vector<Plane> planes{{"R", &picture.rgb, 0}, {"G", &picture.rgb, 1}, {"B", &picture.rgb, 2}};
  if (picture.variance.pixels() > 0) planes.push_back({"Variance.Y", &picture.variance, 0});
  if (picture.spectrum.pixels() > 0)
    for (int bin = 0; bin < picture.bins.count; ++bin)
      planes.push_back(
          {spectral_channel(picture.bins.centre_nm(bin)), &picture.spectrum, static_cast<std::size_t>(bin)});
  for (const PictureChannel& channel : picture.layers) planes.push_back({channel.name, nullptr, 0, &channel});
  return planes;
}

void put_origin(PictureFile& file, const PictureOrigin& origin) {
  for (const OriginText& t : origin_texts)
    if (!(origin.*t.text).empty()) file.attributes.emplace_back(t.name, origin.*t.text);
  if (origin.least_samples > 0) file.attributes.emplace_back(least_name, origin.least_samples);
  for (const OriginMatrix& m : origin_matrices)
    if ((origin.*m.matrix).size() == 16)
      file.attributes.emplace_back(m.name, transposed(std::span<const float, 16>(origin.*m.matrix)));
}

// By the specification of Cryptomatte: a layer is known by seven digits of the hash of its name.
void put_mattes(PictureFile& file, const PictureMattes& mattes) {
  const std::string key = fmt::format("{:08x}", murmur_hash(mattes.layer)).substr(0, 7);
  const auto put = [&](const char* name, const std::string& value) {
    file.attributes.emplace_back(fmt::format("cryptomatte/{}/{}", key, name), value);
  };
  put("name", mattes.layer);
  put("hash", "MurmurHash3_32");
  put("conversion", "uint32_to_float32");
  if (!mattes.manifest.empty()) put("manifest", mattes.manifest);
}

void put_numbers(PictureFile& file, const Picture& picture) {
  const auto put = [&](const char* name, double value) {
    file.attributes.emplace_back(name, static_cast<float>(value));
  };
  if (picture.samples_per_pixel > 0) file.attributes.emplace_back(samples_name, picture.samples_per_pixel);
  if (picture.render_time_s > 0) put(time_name, picture.render_time_s);
  if (picture.neighbours == Neighbours{}) return;
  put(of_mean_name, picture.neighbours.of_mean);
  put(of_variances_name, picture.neighbours.of_variances);
}

void write_webp(const std::filesystem::path& path, const Picture& picture) {
  std::vector<std::uint8_t> pixels(picture.rgb.values.size());
  to_srgb_integers<std::uint8_t>(picture.rgb.values, pixels.data());
  PictureFile file = file_of(picture);
  file.are_integers = true;
  file.bits = 8;
  file.channels = {{"R"}, {"G"}, {"B"}};
  file.attributes.emplace_back("oiio:ColorSpace", "sRGB");
  file.attributes.emplace_back("CompressionQuality", 95);
  if (const std::string comment = comment_on(picture.origin); !comment.empty())
    file.attributes.emplace_back("ImageDescription", comment);
  if (!picture.origin.software.empty()) file.attributes.emplace_back("Software", picture.origin.software);
  write_bytes(path, encoded(path, file, pixels.data()));
}

// With what it says of itself; `top`: its first rows.
PictureFile exr_of(const Picture& top, std::span<const Plane> planes, int height) {
  PictureFile file = file_of(top);
  file.height = height;
  file.full_height = std::max(file.full_height, height);
  put_numbers(file, top);
  put_origin(file, top.origin);
  for (const PictureMattes& mattes : top.mattes) put_mattes(file, mattes);
  if (top.spectrum.pixels() > 0) {
    file.attributes.emplace_back("spectralLayoutVersion", "1.0");
    file.attributes.emplace_back("emissiveUnits", "W.m^-2.sr^-1");
  }
  for (const Plane& plane : planes) file.channels.push_back({plane.name, plane.is_id()});
  return file;
}

}  // namespace

ExrRows::ExrRows(const std::filesystem::path& file, const Picture& top, int height)
    : file_(std::make_unique<ExrFile>(file, exr_of(top, planes_of(top), height))) {}
ExrRows::~ExrRows() = default;

void ExrRows::add(const Picture& rows) {
  const std::vector<Plane> planes = planes_of(rows);
  const auto width = static_cast<std::size_t>(rows.rgb.width);
  std::vector<std::uint32_t> row(planes.size() * width);  // both formats have 32 bits
  for (std::size_t first = 0; first < rows.rgb.pixels(); first += width) {
    for (std::size_t x = 0; x < width; ++x)
      for (std::size_t c = 0; c < planes.size(); ++c) row[x * planes.size() + c] = planes[c].bits(first + x);
    file_->add_row(row);
  }
}

void ExrRows::commit() { file_->commit(); }

int usual_bits(const std::filesystem::path& file) {
  const PictureFormat format = picture_format(file);
  if (holds_light(format)) return 32;
  if (format == PictureFormat::tiff) return 16;
  return format == PictureFormat::none ? 0 : 8;
}

int chosen_bits(const std::filesystem::path& file, int bits) {
  const PictureFormat format = picture_format(file);
  const int usual = usual_bits(file), chosen = bits == 0 ? usual : bits;
  const bool has_choice = format == PictureFormat::png || format == PictureFormat::tiff;
  if (usual == 0)
    throw UsageError(fmt::format(
        "cannot write {}: images are written as .exr, .hdr, .png, .jpg, .tif or .webp", file.string()));
  if (chosen != usual && (!has_choice || (chosen != 8 && chosen != 16)))
    throw UsageError(fmt::format("{} has {} bits, not {}", file.extension().string(), usual, chosen));
  return chosen;
}

void write_picture(const std::filesystem::path& file, const Picture& picture, int bits) {
  const PictureFormat format = picture_format(file);
  const int chosen = chosen_bits(file, bits);
  if (format == PictureFormat::exr) {
    ExrRows exr(file, picture, picture.rgb.height);
    exr.add(picture);
    return exr.commit();
  }
  if (format == PictureFormat::hdr) return write_radiance(file, picture);
  if (format == PictureFormat::png) return write_png(file, picture, chosen);
  if (format == PictureFormat::jpeg) return write_jpeg(file, picture);
  if (format == PictureFormat::tiff) return write_tiff(file, picture, chosen);
  write_webp(file, picture);
}

}  // namespace vitrail
