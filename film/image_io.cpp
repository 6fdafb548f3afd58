// SPDX-License-Identifier: Apache-2.0
#include "film/image_io.h"

#include <fmt/format.h>

#include <fast_float/fast_float.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <optional>
#include <span>

#include "film/fixed_date.h"
#include "film/png_file.h"
#include "film/srgb_integers.h"
#include "images/image_codec.h"
#include "scene/system/atomic_file.h"
#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"

namespace vitrail {

namespace {

std::string date_as_text() {
  const std::tm utc = fixed_date();
  char text[32];
  std::strftime(text, sizeof text, "%Y:%m:%d %H:%M:%S", &utc);
  return text;
}

PictureFile file_of(const Picture& picture) {
  return {.width = picture.rgb.width,
          .height = picture.rgb.height,
          .x = picture.window.x0,
          .y = picture.window.y0,
          .full_width = std::max(picture.full_width, picture.rgb.width),
          .full_height = std::max(picture.full_height, picture.rgb.height),
          .attributes = {{"DateTime", date_as_text()}}};
}

void write_file(const std::filesystem::path& file, const PictureFile& picture, const void* pixels) {
  std::vector<std::byte> bytes;
  if (const std::string problem = image_codec().encode_picture(file.string(), picture, pixels, bytes);
      !problem.empty())
    throw MachineError(fmt::format("cannot write {}: {}", file.string(), problem));
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
void put_matrix(PictureFile& file, const char* name, const std::vector<float>& columns) {
  if (columns.size() != 16) return;
  std::array<float, 16> rows{};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) rows[4 * j + i] = columns[4 * i + j];
  file.attributes.emplace_back(name, rows);
}

// The names of OpenEXR and pbrt where they have one.
void put_origin(PictureFile& file, const PictureOrigin& origin) {
  const auto put = [&](const char* name, const std::string& value) {
    if (!value.empty()) file.attributes.emplace_back(name, value);
  };
  put("Software", origin.software);
  put("scene", origin.scene);
  put("sceneHash", origin.scene_hash);
  put("glazing", origin.glazing);
  put("sampling", origin.sampling);
  put("seed", origin.seeds);
  put("filmHash", origin.film_hash);
  put("denoiser", origin.denoiser);
  if (origin.least_samples > 0) file.attributes.emplace_back("samplesPerPixelLeast", origin.least_samples);
  put_matrix(file, "worldToCamera", origin.world_to_camera);
  put_matrix(file, "worldToNDC", origin.world_to_ndc);
}

constexpr const char *samples_name = "samplesPerPixel", *time_name = "renderTimeSeconds",
                     *of_mean_name = "neighboursOfMean", *of_variances_name = "neighboursOfVariances";

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

void write_exr(const std::filesystem::path& path, const Picture& picture) {
  const std::vector<Plane> planes = planes_of(picture);
  PictureFile file = file_of(picture);
  file.attributes.emplace_back("compression", "zip");
  put_numbers(file, picture);
  put_origin(file, picture.origin);
  if (picture.spectrum.pixels() > 0) {
    file.attributes.emplace_back("spectralLayoutVersion", "1.0");
    file.attributes.emplace_back("emissiveUnits", "W.m^-2.sr^-1");
  }
  for (const Plane& plane : planes) file.channels.push_back({plane.name, plane.is_id()});
  std::vector<std::uint32_t> pixels;  // both formats have 32 bits
  pixels.reserve(planes.size() * picture.rgb.pixels());
  for (std::size_t p = 0; p < picture.rgb.pixels(); ++p)
    for (const Plane& plane : planes) pixels.push_back(plane.bits(p));
  write_file(path, file, pixels.data());
}

bool is_tiff(const std::filesystem::path& file) {
  return file.extension() == ".tif" || file.extension() == ".tiff";
}

template <class Integer>
void write_integers(const std::filesystem::path& path, const Picture& picture) {
  std::vector<Integer> pixels(picture.rgb.values.size());
  to_srgb_integers<Integer>(picture.rgb.values, pixels.data());
  PictureFile file = file_of(picture);
  file.are_integers = true;
  file.bits = static_cast<int>(8 * sizeof(Integer));
  file.channels = {{"R"}, {"G"}, {"B"}};
  // OpenImageIO 2.4 would say it in a second directory, and in memory that one becomes the file's only one.
  if (!is_tiff(path)) file.attributes.emplace_back("oiio:ColorSpace", "sRGB");
  file.attributes.emplace_back("CompressionQuality", 95);
  if (const std::string comment = comment_on(picture.origin); !comment.empty())
    file.attributes.emplace_back("ImageDescription", comment);
  write_file(path, file, pixels.data());
}

// −1: none has it.
int channel_named(const PictureFile& file, const char* name) {
  const auto found = std::ranges::find(file.channels, std::string_view(name),
                                       [](const auto& c) -> std::string_view { return c.name; });
  return found == file.channels.end() ? -1 : static_cast<int>(found - file.channels.begin());
}

// The channels that hold R, G and B, by name, else by position; all the same one for grey.
std::array<int, 3> color_channels(const PictureFile& file) {
  const std::array<int, 3> named{channel_named(file, "R"), channel_named(file, "G"),
                                 channel_named(file, "B")};
  if (*std::min_element(named.begin(), named.end()) >= 0) return named;
  if (file.channels.size() >= 3) return {0, 1, 2};
  return {0, 0, 0};
}

Image select_channels(const PictureFile& file, const std::vector<float>& values,
                      std::span<const int> channels) {
  Image image = black_image(file.width, file.height, static_cast<int>(channels.size()));
  float* out = image.values.data();
  for (std::size_t p = 0; p < image.pixels(); ++p)
    for (const int c : channels) *out++ = values[p * file.channels.size() + static_cast<std::size_t>(c)];
  return image;
}

// Channels of a spectral layout, by ascending wavelength, taken for equal bins around them.
void read_spectrum(Picture& picture, const PictureFile& file, const std::vector<float>& values) {
  std::vector<std::pair<double, int>> found;
  for (std::size_t c = 0; c < file.channels.size(); ++c)
    if (const auto nm = wavelength_of(file.channels[c].name)) found.emplace_back(*nm, static_cast<int>(c));
  if (found.size() < 2) return;
  std::sort(found.begin(), found.end());
  std::vector<int> channels;
  for (const auto& [nm, channel] : found) channels.push_back(channel);
  const double width = (found.back().first - found.front().first) / static_cast<double>(found.size() - 1);
  picture.bins = {static_cast<int>(found.size()), found.front().first - width / 2,
                  found.back().first + width / 2};
  picture.spectrum = select_channels(file, values, channels);
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
  if (format == ".png") return write_png(file, picture, chosen);
  if (chosen == 16) return write_integers<std::uint16_t>(file, picture);
  write_integers<std::uint8_t>(file, picture);
}

Picture read_picture(const std::filesystem::path& path) {
  check_input(path);
  PictureFile file;
  file.attributes = {{samples_name, 0}, {time_name, 0.0f}, {of_mean_name, 1.0f}, {of_variances_name, 1.0f}};
  std::vector<float> values;
  if (const std::string problem = image_codec().decode_picture(path.string(), file, values); !problem.empty())
    throw Error(fmt::format("cannot read the image: {}", problem), {path.string()});
  const auto number = [&](std::size_t at) {
    return static_cast<double>(std::get<float>(file.attributes[at].second));
  };
  const auto at_least_1 = [](double v) { return std::isfinite(v) ? std::max(v, 1.0) : 1; };
  Picture picture;
  picture.rgb = select_channels(file, values, color_channels(file));
  if (file.are_integers)
    for (float& v : picture.rgb.values) v = static_cast<float>(srgb_decode(static_cast<double>(v)));
  if (const int variance = channel_named(file, "Variance.Y"); variance >= 0)
    picture.variance = select_channels(file, values, std::span(&variance, 1));
  read_spectrum(picture, file, values);
  picture.window = {file.x, file.x + file.width, file.y, file.y + file.height};
  picture.full_width = file.full_width;
  picture.full_height = file.full_height;
  picture.samples_per_pixel = std::get<int>(file.attributes[0].second);
  picture.render_time_s = number(1);
  picture.neighbours = {at_least_1(number(2)), at_least_1(number(3))};
  return picture;
}

}  // namespace vitrail
