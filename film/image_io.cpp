// SPDX-License-Identifier: Apache-2.0
#include "film/image_io.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fmt/format.h>

#include <fast_float/fast_float.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <optional>

#include "scene/system/atomic_file.h"
#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"

namespace vitrail {

namespace {

std::string fixed_date() {
  const char* epoch = std::getenv("SOURCE_DATE_EPOCH");
  const std::time_t seconds = epoch ? std::strtoll(epoch, nullptr, 10) : 0;
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y:%m:%d %H:%M:%S", &utc);
  return text;
}

OIIO::ImageSpec spec_of(const Picture& picture, int channels, OIIO::TypeDesc type) {
  OIIO::ImageSpec spec(picture.rgb.width, picture.rgb.height, channels, type);
  spec.x = picture.window.x0;
  spec.y = picture.window.y0;
  spec.full_x = spec.full_y = 0;
  spec.full_width = std::max(picture.full_width, picture.rgb.width);
  spec.full_height = std::max(picture.full_height, picture.rgb.height);
  spec.attribute("DateTime", fixed_date());
  return spec;
}

// `format` of `pixels`; UNKNOWN: each channel's own.
void write_file(const std::filesystem::path& file, const OIIO::ImageSpec& spec, OIIO::TypeDesc format,
                const void* pixels) {
  OIIO::Filesystem::IOVecOutput memory;
  const auto out = OIIO::ImageOutput::create(file.string(), &memory);
  if (!out || !out->open(file.string(), spec) || !out->write_image(format, pixels) || !out->close())
    throw MachineError(
        fmt::format("cannot write {}: {}", file.string(), out ? out->geterror() : OIIO::geterror()));
  AtomicFile target(file);
  target.write(std::as_bytes(std::span(memory.buffer())));
  target.commit();
}

// The layout of Fichet, Pacanowski & Wilkie 2021: the wavelength of a bin's centre, with a decimal comma.
std::string spectral_channel(double nm) {
  std::string name = fmt::format("S0.{:.6f}nm", nm);
  name[name.find('.', 3)] = ',';
  return name;
}

// The wavelength of an unpolarised channel of that layout in nm; none for other channels.
std::optional<double> wavelength_of(std::string name) {
  if (!name.starts_with("S0.") || !name.ends_with("nm")) return std::nullopt;
  name = name.substr(3, name.size() - 5);
  std::replace(name.begin(), name.end(), ',', '.');
  double nm = 0;
  const auto [end, error] = fast_float::from_chars(name.data(), name.data() + name.size(), nm);
  if (error != std::errc() || end != name.data() + name.size()) return std::nullopt;
  return nm;
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

// OpenEXR's matrices take rows.
void put_matrix(OIIO::ImageSpec& spec, const char* name, const std::vector<float>& columns) {
  if (columns.size() != 16) return;
  std::array<float, 16> rows{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) rows[4 * j + i] = columns[4 * i + j];
  spec.attribute(name, OIIO::TypeDesc::TypeMatrix, rows.data());
}

// The names of OpenEXR and pbrt where they have one.
void put_origin(OIIO::ImageSpec& spec, const PictureOrigin& origin) {
  const auto put = [&](const char* name, const std::string& value) {
    if (!value.empty()) spec.attribute(name, value);
  };
  put("Software", origin.software);
  put("scene", origin.scene);
  put("sceneHash", origin.scene_hash);
  put("glazing", origin.glazing);
  put("sampling", origin.sampling);
  put("seed", origin.seeds);
  put("filmHash", origin.film_hash);
  if (origin.least_samples > 0) spec.attribute("samplesPerPixelLeast", origin.least_samples);
  put_matrix(spec, "worldToCamera", origin.world_to_camera);
  put_matrix(spec, "worldToNDC", origin.world_to_ndc);
}

constexpr const char *of_mean_name = "neighboursOfMean", *of_variances_name = "neighboursOfVariances";

void put_neighbours(OIIO::ImageSpec& spec, const Neighbours& neighbours) {
  if (neighbours == Neighbours{}) return;
  spec.attribute(of_mean_name, static_cast<float>(neighbours.of_mean));
  spec.attribute(of_variances_name, static_cast<float>(neighbours.of_variances));
}

Neighbours neighbours_of(const OIIO::ImageSpec& spec) {
  const auto number = [&](const char* name) {
    const double v = static_cast<double>(spec.get_float_attribute(name, 1));
    return std::isfinite(v) ? std::max(v, 1.0) : 1;
  };
  return {number(of_mean_name), number(of_variances_name)};
}

void write_exr(const std::filesystem::path& file, const Picture& picture) {
  const std::vector<Plane> planes = planes_of(picture);
  OIIO::ImageSpec spec = spec_of(picture, static_cast<int>(planes.size()), OIIO::TypeDesc::FLOAT);
  spec.attribute("compression", "zip");
  if (picture.samples_per_pixel > 0) spec.attribute("samplesPerPixel", picture.samples_per_pixel);
  if (picture.render_time_s > 0)
    spec.attribute("renderTimeSeconds", static_cast<float>(picture.render_time_s));
  put_origin(spec, picture.origin);
  put_neighbours(spec, picture.neighbours);
  if (picture.spectrum.pixels() > 0) {
    spec.attribute("spectralLayoutVersion", "1.0");
    spec.attribute("emissiveUnits", "W.m^-2.sr^-1");
  }
  spec.channelnames.clear();
  for (const Plane& plane : planes) {
    spec.channelnames.push_back(plane.name);
    spec.channelformats.push_back(plane.is_id() ? OIIO::TypeDesc::UINT32 : OIIO::TypeDesc::FLOAT);
  }
  spec.alpha_channel = spec.z_channel = -1;
  std::vector<std::uint32_t> pixels;  // both formats have 32 bits
  pixels.reserve(planes.size() * picture.rgb.pixels());
  for (std::size_t p = 0; p < picture.rgb.pixels(); ++p)
    for (const Plane& plane : planes) pixels.push_back(plane.bits(p));
  write_file(file, spec, OIIO::TypeDesc::UNKNOWN, pixels.data());
}

bool is_tiff(const std::filesystem::path& file) {
  return file.extension() == ".tif" || file.extension() == ".tiff";
}

template <class Integer>
void write_integers(const std::filesystem::path& file, const Picture& picture, OIIO::TypeDesc type) {
  constexpr double most = std::numeric_limits<Integer>::max();
  std::vector<Integer> pixels(picture.rgb.values.size());
  std::transform(picture.rgb.values.begin(), picture.rgb.values.end(), pixels.begin(), [](float linear) {
    return static_cast<Integer>(
        std::lround(most * srgb_encode(std::clamp(static_cast<double>(linear), 0.0, 1.0))));
  });
  OIIO::ImageSpec spec = spec_of(picture, 3, type);
  // OpenImageIO 2.4 would say it in a second directory, and in memory that one becomes the file's only one.
  if (!is_tiff(file)) spec.attribute("oiio:ColorSpace", "sRGB");
  spec.attribute("CompressionQuality", 95);
  write_file(file, spec, spec.format, pixels.data());
}

// The channels that hold R, G and B, by name, else by position; all the same one for grey.
std::array<int, 3> color_channels(const OIIO::ImageSpec& spec) {
  const std::array<int, 3> named{spec.channelindex("R"), spec.channelindex("G"), spec.channelindex("B")};
  if (*std::min_element(named.begin(), named.end()) >= 0) return named;
  if (spec.nchannels >= 3) return {0, 1, 2};
  return {0, 0, 0};
}

Image select_channels(const OIIO::ImageSpec& spec, const std::vector<float>& values,
                      std::span<const int> channels) {
  Image image = black_image(spec.width, spec.height, static_cast<int>(channels.size()));
  float* out = image.values.data();
  for (std::size_t p = 0; p < image.pixels(); ++p)
    for (const int c : channels)
      *out++ = values[p * static_cast<std::size_t>(spec.nchannels) + static_cast<std::size_t>(c)];
  return image;
}

// Channels of a spectral layout, by ascending wavelength, taken for equal bins around them.
void read_spectrum(Picture& picture, const OIIO::ImageSpec& spec, const std::vector<float>& values) {
  std::vector<std::pair<double, int>> found;
  for (int c = 0; c < spec.nchannels; ++c)
    if (const auto nm = wavelength_of(spec.channelnames[static_cast<std::size_t>(c)]))
      found.emplace_back(*nm, c);
  if (found.size() < 2) return;
  std::sort(found.begin(), found.end());
  std::vector<int> channels;
  for (const auto& [nm, channel] : found) channels.push_back(channel);
  const double width = (found.back().first - found.front().first) / static_cast<double>(found.size() - 1);
  picture.bins = {static_cast<int>(found.size()), found.front().first - width / 2,
                  found.back().first + width / 2};
  picture.spectrum = select_channels(spec, values, channels);
}

}  // namespace

void write_picture(const std::filesystem::path& file, const Picture& picture, int bits) {
  const std::filesystem::path format = file.extension();
  const bool jpeg = format == ".jpg" || format == ".jpeg", tiff = is_tiff(file);
  if (format != ".exr" && format != ".png" && !jpeg && !tiff)
    throw UsageError(
        fmt::format("cannot write {}: images are written as .exr, .png, .jpg or .tif", file.string()));
  const int usual = format == ".exr" ? 32 : tiff ? 16 : 8, chosen = bits == 0 ? usual : bits;
  if (chosen != usual && (format == ".exr" || jpeg || (chosen != 8 && chosen != 16)))
    throw UsageError(fmt::format("{} has {} bits, not {}", format.string(), usual, chosen));
  if (chosen == 32) return write_exr(file, picture);
  if (chosen == 16) return write_integers<std::uint16_t>(file, picture, OIIO::TypeDesc::UINT16);
  write_integers<std::uint8_t>(file, picture, OIIO::TypeDesc::UINT8);
}

Picture read_picture(const std::filesystem::path& file) {
  check_input(file);
  const auto in = OIIO::ImageInput::open(file.string());
  if (!in) throw Error(fmt::format("cannot read the image: {}", OIIO::geterror()), {file.string()});
  const OIIO::ImageSpec& spec = in->spec();
  if (spec.depth > 1) throw Error("volumes are not images", {file.string()});
  std::vector<float> values(spec.image_pixels() * static_cast<std::size_t>(spec.nchannels));
  if (!in->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, values.data()))
    throw Error(fmt::format("cannot read the image: {}", in->geterror()), {file.string()});
  Picture picture;
  picture.rgb = select_channels(spec, values, color_channels(spec));
  if (!spec.format.is_floating_point())
    for (float& v : picture.rgb.values) v = static_cast<float>(srgb_decode(static_cast<double>(v)));
  if (const int variance = spec.channelindex("Variance.Y"); variance >= 0)
    picture.variance = select_channels(spec, values, std::span(&variance, 1));
  read_spectrum(picture, spec, values);
  picture.window = {spec.x, spec.x + spec.width, spec.y, spec.y + spec.height};
  picture.full_width = spec.full_width;
  picture.full_height = spec.full_height;
  picture.samples_per_pixel = spec.get_int_attribute("samplesPerPixel");
  picture.render_time_s = static_cast<double>(spec.get_float_attribute("renderTimeSeconds"));
  picture.neighbours = neighbours_of(spec);
  return picture;
}

}  // namespace vitrail
