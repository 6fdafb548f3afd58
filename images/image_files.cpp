// SPDX-License-Identifier: Apache-2.0
#include "images/image_files.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <atomic>
#include <cmath>

#include "images/image_codec.h"
#include "images/texture_values.h"
#include "scene/atomic_file.h"
#include "scene/diagnostics.h"
#include "scene/input_files.h"

namespace vitrail {

namespace {

std::atomic<bool> loaded = false;

const ImageCodec& load_codec() {
  const auto folder = std::filesystem::read_symlink("/proc/self/exe").parent_path();
  void* module = ::dlopen((folder / image_codec_module).c_str(), RTLD_LAZY | RTLD_LOCAL);
  const void* codec = module ? ::dlsym(module, image_codec_symbol) : nullptr;
  if (!codec) throw MachineError(fmt::format("cannot read or write images: {}", ::dlerror()));
  loaded = true;
  return *static_cast<const ImageCodec*>(codec);
}

const ImageCodec& codec() {
  static const ImageCodec& only = load_codec();
  return only;
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

ImageLayout read(const std::filesystem::path& file, Image* image) {
  note_input(file);
  ImageLayout layout;
  check(file, codec().read(file.string(), layout, image));
  if (layout.chromaticities && !are_primaries(*layout.chromaticities)) layout.chromaticities.reset();
  return layout;
}

}  // namespace

bool image_library_is_loaded() { return loaded; }

ImageLayout read_image_layout(const std::filesystem::path& file) { return read(file, nullptr); }

StoredImage read_stored_image(const std::filesystem::path& file) {
  StoredImage stored;
  const ImageLayout layout = read(file, &stored.image);
  stored.integer = layout.integer;
  stored.chromaticities = layout.chromaticities;
  return stored;
}

void read_stored_rows(const std::filesystem::path& file, const std::function<void(StoredImage)>& visit) {
  ImageLayout layout = read_image_layout(file);
  const StoredImage as_the_whole{{}, layout.integer, layout.chromaticities};
  check(file, codec().read_rows(file.string(), layout, [&](Image rows) {
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
  if (const std::string problem = codec().encode_exr(image, bytes); !problem.empty())
    throw MachineError(fmt::format("cannot write {}: {}", file.string(), problem));
  AtomicFile target(file);
  target.write(bytes);
  target.commit_part();
}

}  // namespace vitrail
