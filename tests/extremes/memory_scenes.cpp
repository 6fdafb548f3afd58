// SPDX-License-Identifier: Apache-2.0
#include "tests/extremes/memory_scenes.h"

#include <fmt/format.h>
#include <fmt/os.h>
#include <zlib.h>

#include <array>
#include <bit>
#include <cmath>
#include <fstream>
#include <random>

#include "importers/ply/write_ply.h"
#include "scene/mesh.h"

namespace vitrail::test {

namespace {

using Path = std::filesystem::path;

constexpr const char* head =
    "LookAt 0 0 30 0 0 0 0 1 0\nCamera \"perspective\" \"float fov\" 40\n"
    "Film \"rgb\" \"integer xresolution\" 64 \"integer yresolution\" 64\nWorldBegin\n";
constexpr const char* triangle =
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point3 P\" [0 0 0 1 0 0 0 1 0]\n";
constexpr const char* mitsuba_head =
    "<scene version=\"3.0.0\">\n<sensor type=\"perspective\"><transform name=\"to_world\">"
    "<lookat origin=\"0,0,30\" target=\"0,0,0\" up=\"0,1,0\"/></transform></sensor>\n"
    "<emitter type=\"constant\"/>\n";

int times(double share, double count) { return std::max(1, static_cast<int>(share * count)); }

// A pbrt file: `count` times what `line(i)` gives, then `tail`.
Path write_lines(const Path& directory, int count, const auto& line, const std::string& tail = triangle) {
  const Path file = directory / "scene.pbrt";
  fmt::ostream out = fmt::output_file(file.string());
  out.print("{}", head);
  for (int i = 0; i < count; ++i) out.print("{}", line(i));
  out.print("{}", tail);
  return file;
}

// ---- Triangles

// Of random directions and that length: `width` across.
TriangleMesh sticks(int count, float length, float width) {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> place(-1, 1);
  const auto direction = [&] {
    Vector3f d;
    do d = {place(random), place(random), place(random)};
    while (dot(d, d) > 1 || dot(d, d) < 0.01f);
    return normalize(d);
  };
  TriangleMesh mesh;
  for (int i = 0; i < count; ++i) {
    const Point3f p{place(random), place(random), place(random)};
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {p, p + direction() * length, p + direction() * width});
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

Path large_triangles(const Path& directory, double share) {
  write_ply(sticks(times(share, 50'000), 1.5f, 1.5f), directory / "scene.ply");
  return directory / "scene.ply";
}

Path needles(const Path& directory, double share) {
  write_ply(sticks(times(share, 200'000), 1.5f, 1e-4f), directory / "scene.ply");
  return directory / "scene.ply";
}

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
        i, i % 16, 1.0 / (1 + i / 16), triangle);
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

// ---- Records

Path lights(const Path& directory, double share) {
  return write_lines(directory, times(share, 500'000), [](int i) {
    return fmt::format("LightSource \"point\" \"rgb I\" [1 2 {}] \"point3 from\" [{} {} 5]\n", i % 7,
                       i % 1000, i / 1000);
  });
}

Path materials(const Path& directory, double share) {
  return write_lines(directory, times(share, 200'000), [](int i) {
    return fmt::format(
        "Material \"diffuse\" \"rgb reflectance\" [.1 .{} .5]\nShape \"trianglemesh\" "
        "\"integer indices\" [0 1 2] \"point3 P\" [{} {} 0 1 0 0 0 1 0]\n",
        i + 1, i % 1000, i / 1000);
  });
}

Path small_shapes(const Path& directory, double share) {
  return write_lines(directory, times(share, 500'000), [](int i) {
    return fmt::format(
        "Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point3 P\" [{0} {1} 0 {0} {1} 1 1 0 0]\n",
        i % 1000, i / 1000);
  });
}

Path long_names(const Path& directory, double share) {
  return write_lines(directory, times(share, 50'000), [](int i) {
    return fmt::format("MakeNamedMaterial \"{:04096}\" \"string type\" \"diffuse\"\n", i);
  });
}

Path diagnostics(const Path& directory, double share) {
  return write_lines(directory, times(share, 1'000'000), [](int i) {
    return fmt::format("LightSource \"point\" \"float nothing{}\" 1 \"rgb I\" [0 0 0]\n", i);
  });
}

Path prototypes(const Path& directory, double share) {
  return write_lines(directory, times(share, 200'000), [](int i) {
    return fmt::format("ObjectBegin \"{0}\"\n{1}ObjectEnd\nObjectInstance \"{0}\"\nObjectInstance \"{0}\"\n",
                       i, triangle);
  });
}

// Each object holds the one before it twice: 2²² triangles.
Path nested_objects(const Path& directory, double) {
  std::ofstream scene(directory / "scene.pbrt");
  scene << head << "ObjectBegin \"0\"\n" << triangle << "ObjectEnd\n";
  for (int i = 1; i <= 22; ++i)
    scene << fmt::format(
        "ObjectBegin \"{0}\"\nObjectInstance \"{1}\"\nAttributeBegin\nTranslate {2} 0 0\n"
        "ObjectInstance \"{1}\"\nAttributeEnd\nObjectEnd\n",
        i, i - 1, std::pow(2.0, i));
  scene << "ObjectInstance \"22\"\n";
  return directory / "scene.pbrt";
}

Path mitsuba_instances(const Path& directory, double share) {
  const Path file = directory / "scene.xml";
  fmt::ostream out = fmt::output_file(file.string());
  out.print("{}<shape type=\"shapegroup\" id=\"g\"><shape type=\"rectangle\"/></shape>\n", mitsuba_head);
  for (int i = 0; i < times(share, 200'000); ++i)
    out.print(
        "<shape type=\"instance\"><ref id=\"g\"/><transform name=\"to_world\">"
        "<translate x=\"{}\" y=\"{}\"/></transform></shape>\n",
        i % 500, i / 500);
  out.print("</scene>\n");
  return file;
}

Path grid_medium(const Path& directory, double share) {
  const int size = times(std::cbrt(share), 256);
  const Path file = directory / "scene.pbrt";
  fmt::ostream out = fmt::output_file(file.string());
  out.print(
      "{0}MakeNamedMedium \"m\" \"string type\" \"uniformgrid\" \"integer nx\" {1} \"integer ny\" {1} "
      "\"integer nz\" {1} \"float density\" [",
      head, size);
  for (int i = 0; i < size * size * size; ++i) out.print("{} ", i % 10);
  out.print("]\nMediumInterface \"m\" \"\"\nMaterial \"interface\"\nShape \"sphere\"\n");
  return file;
}

Path obj_groups(const Path& directory, double share) {
  const Path file = directory / "scene.obj";
  fmt::ostream out = fmt::output_file(file.string());
  for (int i = 0; i < times(share, 200'000); ++i)
    out.print("g part{0}\nv {0} 0 0\nv {0} 1 0\nv {0} 0 1\nf -1 -2 -3\n", i);
  return file;
}

Path curves(const Path& directory, double share) {
  return write_lines(directory, times(share, 100'000), [](int i) {
    return fmt::format("Shape \"curve\" \"point3 P\" [{0} 0 0 {0} 1 0 {0} 1 1 {0} 0 1] \"float width\" .1\n",
                       i);
  });
}

Path attributes(const Path& directory, double share) {
  TriangleMesh mesh = sticks(times(share, 200'000), 0.1f, 0.1f);
  for (int k = 0; k < 8; ++k)
    mesh.attributes.push_back(
        {fmt::format("vertex_a{}", k), false, 3, std::vector<float>(3 * mesh.positions.size(), 0.5f)});
  write_ply(mesh, directory / "a.ply");
  std::ofstream out(directory / "scene.xml");
  out << mitsuba_head;
  for (int k = 0; k < 8; ++k)
    out << fmt::format(
        "<shape type=\"ply\"><string name=\"filename\" value=\"a.ply\"/><bsdf type=\"diffuse\"><texture "
        "type=\"mesh_attribute\" name=\"reflectance\"><string name=\"name\" "
        "value=\"vertex_a{}\"/></texture></bsdf>"
        "</shape>\n",
        k);
  out << "</scene>\n";
  return directory / "scene.xml";
}

Path open_blocks(const Path& directory, double share) {
  const int count = times(share, 99'000);
  std::string closing = triangle;
  for (int i = 0; i < count; ++i) closing += "AttributeEnd\n";
  return write_lines(
      directory, count,
      [](int i) { return fmt::format("AttributeBegin\nAttribute \"shape\" \"float a{}\" 1\n", i); }, closing);
}

constexpr std::uint64_t mib = 1 << 20;

}  // namespace

std::vector<MemoryRow> memory_rows() {
  return {{"large_triangles", 64 * mib, "--domains 4096", large_triangles},
          {"needles", 200 * mib, "--domains 512", needles},
          {"image", 256 * mib, "", image, true},
          {"lights", 128 * mib, "", lights},
          {"materials", 256 * mib, "", materials},
          {"mitsuba_instances", 256 * mib, "", mitsuba_instances},
          {"small_shapes", 256 * mib, "", small_shapes},
          {"many_images", 256 * mib, "", many_images, true},
          {"environment", 256 * mib, "", environment, true},
          {"long_names", 128 * mib, "", long_names},
          {"diagnostics", 128 * mib, "", diagnostics},
          {"prototypes", 256 * mib, "", prototypes},
          {"nested_objects", 256 * mib, "--flatten", nested_objects},
          {"grid_medium", 256 * mib, "", grid_medium},
          {"obj_groups", 128 * mib, "", obj_groups},
          {"curves", 256 * mib, "", curves},
          {"attributes", 128 * mib, "", attributes},
          {"open_blocks", 64 * mib, "", open_blocks}};
}

}  // namespace vitrail::test
