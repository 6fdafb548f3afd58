// SPDX-License-Identifier: Apache-2.0
// Scenes in which one file, or a few, take the memory.
#include <fmt/format.h>
#include <fmt/os.h>
#include <zlib.h>

#include <cmath>
#include <cstring>
#include <fstream>

#include "tests/extremes/memory_scenes.h"
#include "tests/extremes/memory_text.h"

namespace vitrail::test {

namespace {

using Path = std::filesystem::path;

// ---- Images

void append_word(std::string& to, std::uint32_t word) {
  for (int shift = 24; shift >= 0; shift -= 8) to += static_cast<char>(word >> shift);
}

void append_chunk(std::string& png, const std::string& kind, const std::string& content) {
  append_word(png, static_cast<std::uint32_t>(content.size()));
  const std::string checked = kind + content;
  png += checked;
  append_word(png, static_cast<std::uint32_t>(::crc32(0, reinterpret_cast<const Bytef*>(checked.data()),
                                                      static_cast<uInt>(checked.size()))));
}

// A square colour image of 8 bits; few different colours.
void write_png(const Path& file, int size, int seed) {
  std::string rows;
  for (int y = 0; y < size; ++y) {
    rows += '\0';
    for (int x = 0; x < size; ++x)
      for (const int v : {x / 64 * 5, y / 64 * 3 + seed, 90}) rows += static_cast<char>(v % 256);
  }
  uLongf bytes = ::compressBound(rows.size());
  std::string packed(bytes, '\0');
  ::compress2(reinterpret_cast<Bytef*>(packed.data()), &bytes, reinterpret_cast<const Bytef*>(rows.data()),
              rows.size(), 1);
  packed.resize(bytes);
  std::string png = "\x89PNG\r\n\x1a\n", header;
  append_word(header, static_cast<std::uint32_t>(size));
  append_word(header, static_cast<std::uint32_t>(size));
  header += std::string("\x08\x02\0\0\0", 5);
  append_chunk(png, "IHDR", header);
  append_chunk(png, "IDAT", packed);
  append_chunk(png, "IEND", "");
  std::ofstream(file, std::ios::binary) << png;
}

Path image(const Path& directory, double share) {
  write_png(directory / "a.png", times(std::sqrt(share), 4096), 0);
  return write_lines(directory, 1, [](int) {
    return "Texture \"a\" \"spectrum\" \"imagemap\" \"string filename\" \"a.png\" \"string filter\" "
           "\"trilinear\"\n"
           "Material \"diffuse\" \"texture reflectance\" \"a\"\n";
  });
}

Path many_images(const Path& directory, double share) {
  for (int i = 0; i < 16; ++i) write_png(directory / fmt::format("{}.png", i), 16, i);
  return write_lines(directory, times(share, 20'000), [&](int i) {
    return fmt::format(
        "Texture \"t{0}\" \"spectrum\" \"imagemap\" \"string filename\" \"{1}.png\" \"float scale\" {2}\n"
        "Material \"diffuse\" \"texture reflectance\" \"t{0}\"\n{3}",
        i, i % 16, 1.0 / (1 + i / 16), pbrt_triangle);
  });
}

// Radiance's format, which holds a row after the other.
Path environment(const Path& directory, double share) {
  const int height = times(std::sqrt(share), 4096);
  std::ofstream out(directory / "sky.hdr", std::ios::binary);
  out << fmt::format("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y {} +X {}\n", height, 2 * height);
  for (int y = 0; y < height; ++y) {
    std::string row;
    for (int x = 0; x < 2 * height; ++x) {
      row += static_cast<char>(128 + x / 512);
      row += static_cast<char>(128 + y / 512);
      row += "\xc8\x80";
    }
    out << row;
  }
  out.close();
  std::ofstream scene(directory / "scene.xml");
  scene << "<scene version=\"3.0.0\"><emitter type=\"envmap\"><string name=\"filename\" value=\"sky.hdr\"/>"
           "</emitter><shape type=\"sphere\"/></scene>";
  return directory / "scene.xml";
}

Path large_images(const Path& directory, double share) {
  const int size = times(std::sqrt(share), 4096);
  return write_lines(directory, 20, [&](int i) {
    write_png(directory / fmt::format("{}.png", i), size, i);
    return fmt::format(
        "Texture \"{0}\" \"spectrum\" \"imagemap\" \"string filename\" \"{0}.png\"\n"
        "Material \"diffuse\" \"texture reflectance\" \"{0}\"\n{1}",
        i, pbrt_triangle);
  });
}

// Each in a file of its own.
Path single_pixels(const Path& directory, double share) {
  return write_lines(directory, times(share, 100'000), [&](int i) {
    write_png(directory / fmt::format("{}.png", i), 1, i);
    return fmt::format(
        "Texture \"{0}\" \"spectrum\" \"imagemap\" \"string filename\" \"{0}.png\"\n"
        "Material \"diffuse\" \"texture reflectance\" \"{0}\"\n{1}",
        i, pbrt_triangle);
  });
}

void append(std::string& to, const auto& value) {
  to.append(reinterpret_cast<const char*>(&value), sizeof value);
}

// Halves in scan lines, not packed.
Path exr_environment(const Path& directory, double share) {
  const auto height = static_cast<std::uint32_t>(times(std::sqrt(share), 4096)), width = 2 * height;
  std::string header("\x76\x2f\x31\x01\x02\0\0\0", 8);
  const auto attribute = [&](const char* name, const char* type, const std::string& value) {
    header.append(name, std::strlen(name) + 1).append(type, std::strlen(type) + 1);
    append(header, static_cast<std::uint32_t>(value.size()));
    header += value;
  };
  std::string channels, window, one, centre(8, '\0');
  for (const char c : {'B', 'G', 'R'}) {
    channels += c;
    channels += '\0';
    for (const std::uint32_t v : {1u, 0u, 1u, 1u}) append(channels, v);
  }
  channels += '\0';
  for (const std::uint32_t v : {0u, 0u, width - 1, height - 1}) append(window, v);
  append(one, 1.0f);
  attribute("channels", "chlist", channels);
  attribute("compression", "compression", std::string(1, '\0'));
  attribute("dataWindow", "box2i", window);
  attribute("displayWindow", "box2i", window);
  attribute("lineOrder", "lineOrder", std::string(1, '\0'));
  attribute("pixelAspectRatio", "float", one);
  attribute("screenWindowCenter", "v2f", centre);
  attribute("screenWindowWidth", "float", one);
  header += '\0';
  const std::uint64_t first = header.size() + 8ull * height, line = 8 + 6ull * width;
  for (std::uint32_t y = 0; y < height; ++y) append(header, first + y * line);
  std::ofstream out(directory / "sky.exr", std::ios::binary);
  out << header;
  for (std::uint32_t y = 0; y < height; ++y) {
    std::string row;
    append(row, y);
    append(row, 6 * width);
    for (std::uint32_t i = 0; i < 3 * width; ++i)
      append(row, static_cast<std::uint16_t>(0x3800 + (i * 7 + y * 13) % 1024));  // 0.5 … 1
    out << row;
  }
  out.close();
  std::ofstream(directory / "scene.xml")
      << "<scene version=\"3.0.0\"><emitter type=\"envmap\"><string name=\"filename\" value=\"sky.exr\"/>"
         "</emitter><shape type=\"sphere\"/></scene>";
  return directory / "scene.xml";
}

// ---- Volumes

Path grid_file(const Path& directory, double share) {
  const int size = times(std::cbrt(share), 512);
  std::string header("VOL\x03", 4);
  for (const int v : {1, size, size, size, 1}) append(header, v);
  for (const float v : {0.f, 0.f, 0.f, 1.f, 1.f, 1.f}) append(header, v);
  std::ofstream out(directory / "smoke.vol", std::ios::binary);
  out << header;
  for (int z = 0; z < size; ++z) {
    std::string slice;
    for (int i = 0; i < size * size; ++i) append(slice, static_cast<float>((i + z) % 10));
    out << slice;
  }
  out.close();
  std::ofstream(directory / "scene.xml")
      << mitsuba_head
      << "<shape type=\"cube\"><bsdf type=\"null\"/><medium type=\"heterogeneous\" name=\"interior\">"
         "<volume type=\"gridvolume\" name=\"sigma_t\"><string name=\"filename\" value=\"smoke.vol\"/>"
         "</volume></medium></shape></scene>\n";
  return directory / "scene.xml";
}

// ---- Meshes

// n × n quadrilaterals, row by row: `corner(i, k)` is called for each vertex, `face(a, b, c, d)` with the
// numbers of its four.
void terrain(int n, const auto& corner, const auto& face) {
  for (int k = 0; k <= n; ++k)
    for (int i = 0; i <= n; ++i)
      corner(static_cast<float>(i), static_cast<float>(k), static_cast<float>((i * k) % 17) / 8);
  for (int k = 0; k < n; ++k)
    for (int i = 0; i < n; ++i) {
      const int a = k * (n + 1) + i;
      face(a, a + 1, a + n + 2, a + n + 1);
    }
}

Path terrain_ply(const Path& file, int n, bool quads) {
  std::ofstream out(file, std::ios::binary);
  const std::int64_t side = n + 1;
  out << fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\n"
      "property float z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
      side * side, std::int64_t{n} * n * (quads ? 1 : 2));
  std::string text;
  const auto put = [&](std::initializer_list<std::int32_t> indices) {
    append(text, static_cast<std::uint8_t>(indices.size()));
    for (const std::int32_t i : indices) append(text, i);
    if (text.size() > 1 << 20) out << std::exchange(text, {});
  };
  terrain(
      n, [&](float x, float y, float z) { append(text, x), append(text, y), append(text, z); },
      [&](int a, int b, int c, int d) {
        if (quads) return put({a, b, c, d});
        put({a, b, c});
        put({a, c, d});
      });
  out << text;
  return file;
}

Path quads_ply(const Path& directory, double share) {
  return terrain_ply(directory / "scene.ply", times(std::sqrt(share), 1000), true);
}

Path two_gigabytes_ply(const Path& directory, double share) {
  return terrain_ply(directory / "scene.ply", times(std::sqrt(share), 7250), false);
}

Path many_plys(const Path& directory, double share) {
  terrain_ply(directory / "0.ply", 220, false);
  return write_lines(directory, times(share, 200), [&](int i) {
    if (i > 0) std::filesystem::copy_file(directory / "0.ply", directory / fmt::format("{}.ply", i));
    return fmt::format("Translate 0 0 9\nShape \"plymesh\" \"string filename\" \"{}.ply\"\n", i);
  });
}

Path large_obj(const Path& directory, double share) {
  const Path file = directory / "scene.obj";
  fmt::ostream out = fmt::output_file(file.string());
  terrain(
      times(std::sqrt(share), 2240), [&](float x, float y, float z) { out.print("v {} {} {}\n", x, y, z); },
      [&](int a, int b, int c, int d) {
        out.print("f {} {} {}\nf {} {} {}\n", a + 1, b + 1, c + 1, a + 1, c + 1, d + 1);
      });
  return file;
}

// Written into the scene itself.
Path mesh_in_scene(const Path& directory, double share) {
  const Path file = directory / "scene.pbrt";
  fmt::ostream out = fmt::output_file(file.string());
  std::string indices;
  out.print("{}Shape \"trianglemesh\" \"point3 P\" [", pbrt_head);
  terrain(
      times(std::sqrt(share), 700), [&](float x, float y, float z) { out.print("{} {} {}\n", x, y, z); },
      [&](int a, int b, int c, int d) { indices += fmt::format("{} {} {} {} {} {}\n", a, b, c, a, c, d); });
  out.print("] \"integer indices\" [{}]\n", indices);
  return file;
}

Path serialized(const Path& directory, double share) {
  std::string content("\x00\x10\0\0terrain\0", 12);  // single precision
  const int n = times(std::sqrt(share), 1000);
  append(content, std::uint64_t(n + 1) * std::uint64_t(n + 1));
  append(content, 2ull * std::uint64_t(n) * std::uint64_t(n));
  terrain(
      n, [&](float x, float y, float z) { append(content, x), append(content, y), append(content, z); },
      [&](int a, int b, int c, int d) {
        for (const int i : {a, b, c, a, c, d}) append(content, i);
      });
  uLongf bytes = ::compressBound(content.size());
  std::string packed(bytes, '\0');
  ::compress2(reinterpret_cast<Bytef*>(packed.data()), &bytes, reinterpret_cast<const Bytef*>(content.data()),
              content.size(), 1);
  std::string file("\x1c\x04\x04\0", 4);
  file.append(packed, 0, bytes);
  append(file, std::uint64_t{0});
  append(file, std::uint32_t{1});
  std::ofstream(directory / "mesh.serialized", std::ios::binary) << file;
  std::ofstream(directory / "scene.xml") << mitsuba_head
                                         << "<shape type=\"serialized\"><string name=\"filename\" "
                                            "value=\"mesh.serialized\"/></shape></scene>\n";
  return directory / "scene.xml";
}

}  // namespace

std::vector<MemoryRow> memory_file_rows() {
  return {{"image", 256 * mib, "", image, true},
          {"many_images", 256 * mib, "", many_images, true},
          {"large_images", 256 * mib, "", large_images, true},
          {"single_pixels", 512 * mib, "", single_pixels, true},
          {"environment", 256 * mib, "", environment, true},
          {"exr_environment", 256 * mib, "", exr_environment, true},
          {"grid_file", 256 * mib, "", grid_file},
          {"quads_ply", 128 * mib, "", quads_ply},
          {"two_gigabytes_ply", 512 * mib, "", two_gigabytes_ply},
          {"many_plys", 128 * mib, "", many_plys},
          {"large_obj", 512 * mib, "", large_obj},
          {"mesh_in_scene", 128 * mib, "", mesh_in_scene},
          {"serialized", 128 * mib, "", serialized}};
}

}  // namespace vitrail::test
