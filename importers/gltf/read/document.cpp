// SPDX-License-Identifier: Apache-2.0
#include "importers/gltf/read/document.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <limits>

#include "images/file_part.h"
#include "importers/gltf/uri.h"
#include "importers/reading/named_file.h"

namespace vitrail::gltf {

namespace {

constexpr std::string_view glb_magic = "glTF";
constexpr std::size_t glb_header = 12, chunk_header = 8;

std::uint32_t number_at(const char* bytes) {
  std::array<unsigned char, 4> b{};
  std::memcpy(b.data(), bytes, 4);
  return b[0] | b[1] << 8 | b[2] << 16 | static_cast<std::uint32_t>(b[3]) << 24;
}

// The JSON of a file: all of it, or the first chunk of a .glb.
std::string_view json_of(const InputBytes& bytes, const std::filesystem::path& file) {
  const std::string_view all(bytes.begin(), bytes.size());
  if (all.size() > std::numeric_limits<std::uint32_t>::max())
    throw Error("a glTF file has at most 4 GiB: put its buffers into files of their own", {file.string()});
  if (!all.starts_with(glb_magic)) return all;
  if (all.size() < glb_header + chunk_header) throw Error("the file ends within its header", {file.string()});
  if (number_at(all.data() + 4) != 2)
    throw Error(fmt::format("glTF {} is not read: export it as glTF 2.0", number_at(all.data() + 4)),
                {file.string()});
  const std::size_t length = number_at(all.data() + glb_header);
  if (length > all.size() - glb_header - chunk_header || all.substr(16, 4) != "JSON")
    throw Error("its first chunk is no JSON, or longer than the file", {file.string()});
  return all.substr(glb_header + chunk_header, length);
}

struct Known {
  std::string_view name;
  const char* remedy = nullptr;  // of what is refused: what takes it away
};
constexpr std::array known_extensions{
    Known{"EXT_mesh_gpu_instancing"},
    Known{"EXT_texture_webp"},
    Known{"KHR_lights_punctual"},
    Known{"KHR_materials_anisotropy"},
    Known{"KHR_materials_clearcoat"},
    Known{"KHR_materials_dispersion"},
    Known{"KHR_materials_emissive_strength"},
    Known{"KHR_materials_ior"},
    Known{"KHR_materials_sheen"},
    Known{"KHR_materials_specular"},
    Known{"KHR_materials_transmission"},
    Known{"KHR_materials_unlit"},
    Known{"KHR_materials_variants"},
    Known{"KHR_materials_volume"},
    Known{"KHR_mesh_quantization"},
    Known{"KHR_texture_transform"},
    Known{"KHR_draco_mesh_compression",
          "its meshes are packed by Draco: export without compression, or unpack it with "
          "\"gltf-transform copy\" or \"gltfpack -noq\""},
    Known{"EXT_meshopt_compression",
          "its buffers are packed by meshoptimizer: export without compression, or unpack "
          "it with \"gltf-transform copy\""},
    Known{"KHR_texture_basisu", "its images are KTX 2: export them as PNG or JPEG"},
    Known{"KHR_materials_pbrSpecularGlossiness",
          "its materials are of glTF 1's specular-glossiness: turn them with "
          "\"gltf-transform metalrough\""},
};

const Known* known(const std::string& name) {
  const auto* found = std::ranges::find(known_extensions, name, &Known::name);
  return found == known_extensions.end() ? nullptr : found;
}

// `name` is in the folder whose name `folder` points to.
bool read_file(std::vector<unsigned char>* out, std::string*, const std::string& name, void* folder) {
  const std::string& parent = *static_cast<const std::string*>(folder);
  const bool is_within = name.size() > parent.size() && name.starts_with(parent);
  const InputBytes bytes(is_within ? named_file(name.substr(parent.size() + 1), parent) : name);
  out->assign(bytes.begin(), bytes.end());
  return true;
}

// What tinygltf says, as one line.
std::string one_line(std::string said) {
  while (!said.empty() && (said.back() == '\n' || said.back() == ' ')) said.pop_back();
  std::ranges::replace(said, '\n', ' ');
  return said.empty() ? "it is not glTF" : said;
}

}  // namespace

bool is_gltf(std::string_view first_bytes) {
  const std::size_t begin = first_bytes.find_first_not_of(" \t\r\n");
  return first_bytes.starts_with(glb_magic) ||
         (begin != std::string_view::npos && first_bytes[begin] == '{' &&
          first_bytes.find("\"asset\"") != std::string_view::npos);
}

Document::Document(const std::filesystem::path& file)
    : file_(std::filesystem::absolute(file).lexically_normal()),
      bytes_(file),
      is_binary_(std::string_view(bytes_.begin(), bytes_.size()).starts_with(glb_magic)),
      places_(json_of(bytes_, file), file.string()) {
  const std::string_view json = json_of(bytes_, file);
  json_at_ = static_cast<std::size_t>(json.data() - bytes_.begin());
  bin_at_ = is_binary_ ? json_at_ + json.size() + chunk_header : 0;
  load();
  require_known();
}

void Document::load() {
  tinygltf::TinyGLTF loader;
  std::string folder = file_.parent_path().string();
  loader.SetFsCallbacks({[](const std::string&, void*) { return true; },
                         [](const std::string& name, void*) { return name; }, read_file, nullptr, &folder});
  loader.SetImageLoader([](tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char*,
                           int, void*) { return true; },
                        nullptr);
  std::string error, warning;
  bool loaded = false;
  const auto size = static_cast<unsigned>(bytes_.size());
  try {
    loaded = is_binary_ ? loader.LoadBinaryFromMemory(&model_, &error, &warning,
                                                      reinterpret_cast<const unsigned char*>(bytes_.begin()),
                                                      size, folder)
                        : loader.LoadASCIIFromString(&model_, &error, &warning, bytes_.begin(), size, folder);
  } catch (const Error&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& what) {
    error += what.what();
  }
  if (!loaded) {
    require_known();  // tinygltf stumbles over what a required extension packs: the extension is the cause
    throw Error("cannot read the glTF: " + one_line(error), {file_.string()});
  }
  if (!model_.asset.version.starts_with("2."))
    throw Error(fmt::format("glTF {} is not read: export it as glTF 2.0", model_.asset.version),
                {file_.string()});
}

void Document::require_known() const {
  for (const std::string& name : model_.extensionsRequired) {
    const Known* one = known(name);
    if (!one)
      throw Error(fmt::format("it needs the extension {}, which is not known here", name), {file_.string()});
    if (one->remedy) throw Error(fmt::format("{}: {}", name, one->remedy), {file_.string()});
  }
}

std::vector<std::string> Document::unknown_extensions() const {
  std::vector<std::string> unknown;
  for (const std::string& name : model_.extensionsUsed)
    if (const Known* one = known(name); !one || one->remedy) unknown.push_back(name);
  return unknown;
}

Origin Document::origin(const std::string& array, int index) const {
  const SourceLocation at = place(array, index);
  return {0, static_cast<std::uint32_t>(at.line), static_cast<std::uint32_t>(at.column)};
}

void Document::fail(const std::string& array, int index, const std::string& what) const {
  throw Error(fmt::format("{}[{}]: {}", array, index, what), place(array, index));
}

std::string Document::image_file(int index) const {
  const tinygltf::Image& image = model_.images.at(static_cast<std::size_t>(index));
  const auto base64_part = [&](const char* array, int at, std::uint64_t offset, std::uint64_t bytes) {
    const auto [begin, letters] = places_.base64_of(array, at);
    const std::uint64_t whole = letters / 4 * 3 + (letters % 4 > 1 ? letters % 4 - 1 : 0);
    if (letters == 0 || offset > whole || bytes > whole - offset)
      fail("images", index, "its data URI is not base64");
    return name_of({file_, json_at_ + begin + offset / 3 * 4, bytes ? bytes : whole, true,
                    static_cast<unsigned>(offset % 3)});
  };
  if (image.bufferView < 0) {
    if (image.uri.empty()) return base64_part("images", index, 0, 0);
    return file_from_uri(image.uri, file_.parent_path()).string();
  }
  const tinygltf::BufferView& view =
      element(model_.bufferViews, image.bufferView, "bufferViews", "images", index);
  const tinygltf::Buffer& buffer =
      element(model_.buffers, view.buffer, "buffers", "bufferViews", image.bufferView);
  if (view.byteOffset > buffer.data.size() || view.byteLength > buffer.data.size() - view.byteOffset)
    fail("images", index, fmt::format("its bufferViews[{}] ends behind the buffer", image.bufferView));
  if (places_.base64_of("buffers", view.buffer).second > 0)
    return base64_part("buffers", view.buffer, view.byteOffset, view.byteLength);
  if (buffer.uri.empty()) return name_of({file_, bin_at_ + view.byteOffset, view.byteLength, false, 0});
  return name_of(
      {file_from_uri(buffer.uri, file_.parent_path()), view.byteOffset, view.byteLength, false, 0});
}

}  // namespace vitrail::gltf
