// SPDX-License-Identifier: Apache-2.0
#include "images/image_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <fstream>

#include "images/file_part.h"
#include "images/image_codec.h"
#include "images/texture_values.h"
#include "scene/system/atomic_file.h"
#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"
#include "scene/system/memory_guard.h"
#include "scene/system/module.h"

namespace vitrail {

namespace {

std::atomic<bool> loaded = false;

constexpr std::uint64_t opening_bytes = 1 << 20;       // of a file's header, and of its reader
constexpr std::uint64_t most_pixels_of_gif = 1 << 26;  // of which its reader holds several copies

const ImageCodec& load_codec() {
  const GrantedMemory loading(image_library_bytes);
  const void* codec = module_symbol(image_codec_module, image_codec_symbol,
                                    "reads images, and writes others than .exr and .png");
  loaded = true;
  static_cast<const ImageCodec*>(codec)->begin();
  return *static_cast<const ImageCodec*>(codec);
}

// Whether they span the plane: else they say nothing.
bool are_primaries(const Chromaticities& c) {
  for (const RGB& p : primaries_in_srgb(c))
    if (!std::isfinite(p.r) || !std::isfinite(p.g) || !std::isfinite(p.b)) return false;
  return true;
}

void check(const std::filesystem::path& file, const std::string& problem) {
  if (!problem.empty()) throw Error(fmt::format("cannot read the image: {}", problem), {file.string()});
}

// A GIF states its size in the first bytes; its reader makes room for it before it can be asked.
bool is_large_gif(const std::filesystem::path& file) {
  std::array<unsigned char, 10> head{};
  std::ifstream in = open_regular(file);
  if (!in.read(reinterpret_cast<char*>(head.data()), head.size()) || head[0] != 'G' || head[1] != 'I' ||
      head[2] != 'F')
    return false;
  const auto number = [&](std::size_t at) {
    return std::uint64_t{head[at]} + std::uint64_t{256} * head[at + 1];
  };
  return number(6) * number(8) > most_pixels_of_gif;
}

void require_size(const std::filesystem::path& file, const ImageLayout& layout) {
  if (layout.width < 1 || layout.height < 1 || layout.width > max_image_extent ||
      layout.height > max_image_extent ||
      static_cast<std::uint64_t>(layout.width) * static_cast<std::uint64_t>(layout.height) >
          most_image_pixels)
    throw Error(fmt::format("cannot read the image: it states {} × {} pixels, and the most are {} a side and "
                            "{} in all",
                            layout.width, layout.height, max_image_extent, most_image_pixels),
                {file.string()});
}

// What the library is to read, with the bytes of what lies within another file.
class Source {
 public:
  explicit Source(const std::filesystem::path& file) : source_{file.string(), {}} {
    const std::optional<FilePart> part = file_part(source_.file);
    if (!part) {
      check_input(file);
      return;
    }
    bytes_ = read_part(*part);
    const std::string suffix = picture_suffix(bytes_);
    constexpr std::array known{".png", ".jpg", ".webp"};  // and as many decoders that strangers' bytes meet
    if (std::ranges::find(known, suffix) == known.end())
      throw Error("cannot read the image: within other files they are PNG, JPEG or WebP", {source_.file});
    source_ = {"picture" + suffix, bytes_};
  }
  const PictureSource& get() const { return source_; }

 private:
  std::vector<std::byte> bytes_;
  PictureSource source_;
};

// By what the file states, before there is room for it.
ImageLayout checked_layout(const std::filesystem::path& file, const PictureSource& source) {
  if (source.bytes.empty() && is_large_gif(file))
    throw Error(fmt::format("cannot read the image: a GIF has at most {} pixels here", most_pixels_of_gif),
                {file.string()});
  ImageLayout layout;
  const ImageCodec& codec = image_codec();
  const GrantedMemory opening(opening_bytes);
  check(file, codec.read(source, layout, nullptr));
  require_size(file, layout);
  return layout;
}

ImageLayout read(const std::filesystem::path& file, const PictureSource& source, Image* image) {
  ImageLayout layout = checked_layout(file, source);
  if (image) {
    const GrantedMemory reading(layout.whole_bytes);
    check(file, image_codec().read(source, layout, image));
  }
  if (layout.chromaticities && !are_primaries(*layout.chromaticities)) layout.chromaticities.reset();
  return layout;
}

}  // namespace

const ImageCodec& image_codec() {
  static const ImageCodec& only = load_codec();
  return only;
}

bool image_library_is_loaded() { return loaded; }

ImageLayout read_image_layout(const std::filesystem::path& file) {
  return read(file, Source(file).get(), nullptr);
}

StoredImage read_stored_image(const std::filesystem::path& file) {
  StoredImage stored;
  const ImageLayout layout = read(file, Source(file).get(), &stored.image);
  stored.integer = layout.integer;
  stored.chromaticities = layout.chromaticities;
  return stored;
}

void read_stored_rows(const std::filesystem::path& file, const std::function<void(StoredImage)>& visit) {
  const Source source(file);
  ImageLayout layout = read(file, source.get(), nullptr);
  const StoredImage as_the_whole{{}, layout.integer, layout.chromaticities};
  const GrantedMemory reading(layout.rows_bytes);
  check(file, image_codec().read_rows(source.get(), layout, [&](Image rows) {
    const GuardedMemory ours;
    StoredImage stored = as_the_whole;
    stored.image = std::move(rows);
    visit(std::move(stored));
  }));
}

Image read_linear_image(const std::filesystem::path& file) {
  return texture_values(ImageTexture{}, read_stored_image(file), ImageUse::light);
}

void write_exr_image(const std::filesystem::path& file, const Image& image) {
  std::vector<std::byte> bytes;
  const ImageCodec& codec = image_codec();
  {
    const GrantedMemory encoding(opening_bytes + 3 * image.values.size() * sizeof(float));
    if (const std::string problem = codec.encode_exr(image, bytes); !problem.empty())
      throw MachineError(fmt::format("cannot write {}: {}", file.string(), problem));
  }
  AtomicFile target(file);
  target.write(bytes);
  target.commit_part();
}

}  // namespace vitrail
