// SPDX-License-Identifier: Apache-2.0
// The files of baked textures: from images, or from the cache.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "images/file_part.h"
#include "images/texture_values.h"
#include "partitioner/appearance/bake_textures.h"
#include "partitioner/caching/content_hash.h"
#include "scene/system/input_files.h"

namespace vitrail {

namespace {

ImageUse image_use(TextureUse use) {
  if (use == TextureUse::number) return ImageUse::number;
  if (use == TextureUse::vector) return ImageUse::vector;
  return use == TextureUse::illuminant ? ImageUse::light : ImageUse::color;
}

// The values of the texture, from its file. What has few of them is read but once.
ImageRows rows_of(const ImageTexture& texture, const ImageLayout& layout, TextureUse use) {
  constexpr std::size_t most_kept = 1 << 22;  // values
  struct Kept {
    std::vector<Image> rows;
    std::size_t values = 0;
    bool whole = false;
  };
  const auto kept = std::make_shared<Kept>();
  return {layout.width, layout.height, [=](const std::function<void(Image)>& visit) {
            if (kept->whole) {
              for (const Image& rows : kept->rows) visit(rows);
              return;
            }
            kept->rows.clear(), kept->values = 0;
            read_stored_rows(texture.filename, [&](StoredImage stored) {
              Image values = texture_values(texture, std::move(stored), image_use(use));
              kept->values += values.values.size();
              if (kept->values <= most_kept)
                kept->rows.push_back(values);
              else
                kept->rows.clear();
              visit(std::move(values));
            });
            kept->whole = kept->values <= most_kept;
          }};
}

// The rows in three channels, each times its factor; of vectors, the components that the numbers stand for.
ImageRows tinted(ImageRows rows, const Tint& tint, TextureUse use) {
  if (tint == no_tint) return rows;
  const float zero = use == TextureUse::vector ? 0.5f : 0;
  const auto times_tint = [tint, zero](const Image& values) {
    Image product = black_image(values.width, values.height, 3);
    const auto channels = static_cast<std::size_t>(values.channels);
    for (std::size_t i = 0; i < values.pixels(); ++i)
      for (std::size_t c = 0; c < 3; ++c)
        product.values[3 * i + c] =
            zero + tint[c] * (values.values[channels * i + (channels < 3 ? 0 : c)] - zero);
    return product;
  };
  rows.read = [read = std::move(rows.read), times_tint](const std::function<void(Image)>& visit) {
    read([&](const Image& values) { visit(times_tint(values)); });
  };
  return rows;
}

// To be raised where equal images are baked to other texels than before.
constexpr int baking_revision = 3;

// Of a baked image: what is in the file, and all that is asked of it. Empty for small files, which are baked
// as soon as they are looked for.
std::string key_of(const ImageTexture& image, TextureUse use, const Tint& tint, bool all_levels,
                   RgbMethod method) {
  constexpr std::uint64_t least_bytes = 1 << 15;
  if (file_part(image.filename)) return "";  // the content would be looked up in the file as a whole
  const std::filesystem::path file = image.filename;
  check_input(file);
  std::error_code none;
  if (const auto bytes = std::filesystem::file_size(file, none); none || bytes < least_bytes) return "";
  ContentHash hash;
  hash.add(fmt::format(
      "{} {} {} {} {} {} {} {} {} {} {}", baking_revision, texture_version, static_cast<int>(image.encoding),
      image.gamma, image.scale, image.invert, use == TextureUse::number ? static_cast<int>(image.number) : -1,
      static_cast<int>(image.primaries), static_cast<int>(use), all_levels, static_cast<int>(method)));
  if (tint != no_tint) hash.add(fmt::format("tint {} {} {}", tint[0], tint[1], tint[2]));
  hash.add(file.extension().string());  // tells the kind of some files
  hash.add_content(file);
  return hash.hex() + ".tex";
}

bool keeps_integers_finite(const ImageTexture& image) {
  return std::isfinite(image.scale) && (image.encoding != Encoding::gamma || image.gamma >= 0);
}

}  // namespace

std::string TextureBaker::bake_image(const ImageTexture& image, TextureUse use, const SourceLocation& where) {
  return bake_file(image, use, no_tint, true, where);
}

std::string TextureBaker::bake_file(const ImageTexture& image, TextureUse use, const Tint& tint,
                                    bool all_levels, const SourceLocation& where) {
  const ImageNumber number = use == TextureUse::number ? image.number : ImageNumber{};
  const ImageKey key{image.filename, image.encoding,  image.gamma, image.scale, image.invert,
                     number,         image.primaries, use,         tint,        all_levels};
  if (const auto known = images_.find(key); known != images_.end()) return known->second;
  try {
    return images_[key] = write_file(image, use, tint, all_levels, where);
  } catch (const Error& error) {
    throw Error(fmt::format("texture {}: {}", image.filename, error.what()), where);
  }
}

std::string TextureBaker::write_file(const ImageTexture& image, TextureUse use, const Tint& tint,
                                     bool all_levels, const SourceLocation& where) {
  const std::string key = cache_.is_on() ? key_of(image, use, tint, all_levels, scene_.settings.rgb) : "";
  if (!key.empty()) {
    std::string name = next_file();
    const auto kept = bundle_.empty() ? cache_.note(key) : cache_.take(key, bundle_ / name);
    if (kept) {
      report(image, {((*kept)[2] & 1) != 0, (*kept)[3]}, where);
      files_.push_back({name, (*kept)[0], (*kept)[1], (*kept)[2] >> 1});
      return name;
    }
  }
  if (const auto rows = tint == no_tint ? byte_rows(image.filename) : std::nullopt) {
    const ImageTexture chosen =
        use == TextureUse::number && rows->channels % 2 == 0 ? without_choice(image) : image;
    if (const auto coded = coded_image(chosen, *rows, use, scene_.settings.rgb))
      return write_codes(image, *rows, *coded, all_levels, where, key);
  }
  const ImageLayout layout = read_image_layout(image.filename);
  const auto size = static_cast<std::uint32_t>(std::max(layout.width, layout.height));
  if (std::min(layout.width, layout.height) <= 0 || size > max_texture_size)
    throw Error(fmt::format("{} × {} pixels are not an image for a texture", layout.width, layout.height));
  ImageFacts facts;
  facts.other_primaries =
      use != TextureUse::number && use != TextureUse::vector && ignores_primaries(image, layout);
  ImageRows rows =
      tinted(rows_of(use == TextureUse::number ? without_choice(image) : image, layout, use), tint, use);
  rows.read = [&, read = rows.read](const std::function<void(Image)>& visit) {
    facts.broken = 0;  // the last reading is of all rows
    read([&](Image values) {
      facts.broken += static_cast<std::size_t>(std::count_if(values.values.begin(), values.values.end(),
                                                             [](float v) { return !std::isfinite(v); }));
      visit(std::move(values));
    });
  };
  if (bundle_.empty() && !(trust_integers_ && layout.integer && keeps_integers_finite(image)))
    rows.read([](const Image&) {});
  std::string name = write_image(rows, use, all_levels);
  report(image, facts, where);
  if (!key.empty() && !bundle_.empty())
    cache_.keep(key, bundle_ / name,
                {files_.back().bytes, files_.back().hash,
                 files_.back().read_bytes << 1 | (facts.other_primaries ? 1 : 0), facts.broken});
  return name;
}

// The cache notes in one number whether primaries do not count, and the bytes of codes as they are read.
std::string TextureBaker::write_codes(const ImageTexture& image, const ByteRows& rows,
                                      const CodedImage& coded, bool all_levels, const SourceLocation& where,
                                      const std::string& key) {
  std::string name = next_file();
  files_.push_back({name, 0, 0});
  if (bundle_.empty()) {
    if (!trust_integers_) rows.read([](auto) {});
    return name;
  }
  Writing& task = writing_.emplace_back(Writing{files_.size() - 1, {name, 0, 0}});
  writers_.run([this, &task, filename = image.filename, rows, coded, all_levels, where, key] {
    try {
      const std::filesystem::path file = bundle_ / task.written.name;
      const WrittenTextureFile written = write_coded_image(file, rows, coded, all_levels);
      task.written.bytes = written.bytes, task.written.hash = written.hash;
      task.written.read_bytes = written.read_bytes;
      if (!key.empty()) cache_.keep(key, file, {written.bytes, written.hash, written.read_bytes << 1, 0});
    } catch (const Error& error) {
      task.failure =
          std::make_exception_ptr(Error(fmt::format("texture {}: {}", filename, error.what()), where));
    } catch (...) {
      task.failure = std::current_exception();
    }
  });
  return name;
}

TextureBaker::~TextureBaker() { writers_.wait(); }

const std::vector<TextureFileEntry>& TextureBaker::files() {
  writers_.wait();
  for (const Writing& task : std::exchange(writing_, {})) {
    if (task.failure) std::rethrow_exception(task.failure);
    files_[task.file] = task.written;
  }
  return files_;
}

void TextureBaker::report(const ImageTexture& image, const ImageFacts& facts, const SourceLocation& where) {
  if (facts.other_primaries)
    diagnostics_.push_back({Fidelity::approximated,
                            fmt::format("texture {}: its file states other primaries than sRGB's, which its "
                                        "renderer does not look at: its colours count as sRGB's",
                                        image.filename),
                            where,
                            {}});
  if (facts.broken > 0)
    diagnostics_.push_back(
        {Fidelity::approximated,
         fmt::format("texture {}: {} values are not finite and count as 0", image.filename, facts.broken),
         where,
         {}});
}

std::string TextureBaker::write_image(const ImageRows& rows, TextureUse use, bool all_levels) {
  std::string name = next_file();
  if (bundle_.empty()) {
    files_.push_back({name, 0, 0});
    return name;
  }
  const WrittenTextureFile written =
      write_baked_image(bundle_ / name, rows, use, all_levels, fitter_, scene_.settings.rgb);
  files_.push_back({name, written.bytes, written.hash, written.read_bytes});
  return name;
}

// The name of a file in the bundle, whose folder is there.
std::string TextureBaker::next_file() {
  if (files_.empty() && !bundle_.empty()) {
    std::error_code failure;
    std::filesystem::create_directories(bundle_ / "textures", failure);
    if (failure)
      throw MachineError(
          fmt::format("cannot create {}: {}", (bundle_ / "textures").string(), failure.message()));
  }
  return fmt::format("textures/{:06}.tex", files_.size());
}

}  // namespace vitrail
