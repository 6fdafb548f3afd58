// SPDX-License-Identifier: Apache-2.0
#include "images/image_files.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <atomic>

#include "images/image_codec.h"
#include "scene/atomic_file.h"
#include "scene/color.h"
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

ImageLayout read(const std::filesystem::path& file, Image* image) {
  note_input(file);
  ImageLayout layout;
  if (const std::string problem = codec().read(file.string(), layout, image); !problem.empty())
    throw Error(fmt::format("cannot read the image: {}", problem), {file.string()});
  return layout;
}

}  // namespace

bool image_library_is_loaded() { return loaded; }

ImageLayout read_image_layout(const std::filesystem::path& file) { return read(file, nullptr); }

StoredImage read_stored_image(const std::filesystem::path& file) {
  StoredImage stored;
  stored.integer = read(file, &stored.image).integer;
  return stored;
}

Image read_linear_image(const std::filesystem::path& file) {
  StoredImage stored = read_stored_image(file);
  if (stored.integer)
    for (float& value : stored.image.values)
      value = static_cast<float>(srgb_decode(static_cast<double>(value)));
  return std::move(stored.image);
}

void write_exr_image(const std::filesystem::path& file, const Image& image) {
  std::vector<std::byte> bytes;
  if (const std::string problem = codec().encode_exr(image, bytes); !problem.empty())
    throw MachineError(fmt::format("cannot write {}: {}", file.string(), problem));
  AtomicFile target(file);
  target.write(bytes);
  target.commit();
}

}  // namespace vitrail
