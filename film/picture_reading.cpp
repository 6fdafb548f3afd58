// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <fast_float/fast_float.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "film/image_io.h"
#include "film/picture_attributes.h"
#include "film/plain_exr.h"
#include "images/image_codec.h"
#include "scene/records/film_layers.h"
#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"
#include "scene/system/memory_guard.h"

namespace vitrail {

namespace {

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

// Layers of sums, which are floats; alpha may be integers. Ids are read as floats, too, and of those not all
// have 32 bits.
void read_layers(Picture& picture, const PictureFile& file, const std::vector<float>& values) {
  for (const LayerKind& kind : layer_kinds)
    for (std::size_t i = 0; i < kind.sums && (!file.are_integers || std::string_view(kind.name) == "alpha");
         ++i)
      if (const int channel = channel_named(file, kind.channels[i]); channel >= 0)
        picture.layers.push_back(
            {kind.channels[i], false, select_channels(file, values, std::span(&channel, 1)).values, {}});
}

// By the image library, through which no exception may pass.
void decode(const std::filesystem::path& path, PictureFile& file, std::vector<float>& values) {
  const ImageCodec& codec = image_codec();
  ImageLayout layout;
  {
    constexpr std::uint64_t opening_bytes = 1 << 20;
    const GrantedMemory opening(opening_bytes);
    codec.read({path.string()}, layout, nullptr);  // of what it cannot read, the next call says why
  }
  const GrantedMemory decoding(layout.whole_bytes);
  if (const std::string problem = codec.decode_picture(path.string(), file, values); !problem.empty())
    throw Error(fmt::format("cannot read the image: {}", problem), {path.string()});
}

}  // namespace

Picture read_picture(const std::filesystem::path& path) {
  check_input(path);
  PictureFile file;
  file.attributes = {
      {samples_name, 0}, {time_name, 0.0f}, {of_mean_name, 1.0f}, {of_variances_name, 1.0f}, {least_name, 0}};
  const std::size_t texts = file.attributes.size();
  for (const OriginText& t : origin_texts) file.attributes.emplace_back(t.name, std::string());
  const std::size_t matrices = file.attributes.size();
  for (const OriginMatrix& m : origin_matrices) file.attributes.emplace_back(m.name, std::array<float, 16>{});
  std::vector<float> values;
  if (!read_plain_exr(path, file, values)) decode(path, file, values);
  const auto number = [&](std::size_t at) {
    return static_cast<double>(std::get<float>(file.attributes[at].second));
  };
  const auto at_least_1 = [](double v) { return std::isfinite(v) ? std::max(v, 1.0) : 1; };
  Picture picture;
  const std::array<int, 3> colors = color_channels(file);
  if (const PictureFile::Channel& first = file.channels.at(static_cast<std::size_t>(colors[0]));
      first.is_id && first.name != "R")
    throw Error(fmt::format("its channel \"{}\" holds whole numbers of 32 bits, which are ids and no light",
                            first.name),
                {path.string()});
  picture.rgb = select_channels(file, values, colors);
  if (file.are_integers)
    for (float& v : picture.rgb.values) v = static_cast<float>(srgb_decode(static_cast<double>(v)));
  if (const int variance = channel_named(file, "Variance.Y"); variance >= 0)
    picture.variance = select_channels(file, values, std::span(&variance, 1));
  read_spectrum(picture, file, values);
  read_layers(picture, file, values);
  picture.window = {file.x, file.x + file.width, file.y, file.y + file.height};
  picture.full_width = file.full_width;
  picture.full_height = file.full_height;
  picture.samples_per_pixel = std::get<int>(file.attributes[0].second);
  picture.render_time_s = number(1);
  picture.origin.least_samples = std::get<int>(file.attributes[4].second);
  for (std::size_t i = 0; i < std::size(origin_texts); ++i)
    picture.origin.*origin_texts[i].text = std::get<std::string>(file.attributes[texts + i].second);
  for (std::size_t i = 0; i < std::size(origin_matrices); ++i) {
    const auto rows = std::get<std::array<float, 16>>(file.attributes[matrices + i].second);
    if (rows == std::array<float, 16>{}) continue;
    const std::array<float, 16> columns = transposed(rows);
    (picture.origin.*origin_matrices[i].matrix).assign(columns.begin(), columns.end());
  }
  picture.neighbours = {at_least_1(number(2)), at_least_1(number(3))};
  return picture;
}

}  // namespace vitrail
