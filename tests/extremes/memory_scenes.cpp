// SPDX-License-Identifier: Apache-2.0
#include "tests/extremes/memory_scenes.h"

#include <fmt/format.h>
#include <fmt/os.h>

#include <array>
#include <cmath>
#include <fstream>
#include <random>

#include "importers/writing/write_ply.h"
#include "scene/shapes/mesh.h"
#include "tests/extremes/memory_text.h"

namespace vitrail::test {

namespace {

using Path = std::filesystem::path;

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
                       i, pbrt_triangle);
  });
}

// Each object holds the one before it twice: 2^levels triangles.
Path nested(const Path& directory, int levels) {
  std::ofstream scene(directory / "scene.pbrt");
  scene << pbrt_head << "ObjectBegin \"0\"\n" << pbrt_triangle << "ObjectEnd\n";
  for (int i = 1; i <= levels; ++i)
    scene << fmt::format(
        "ObjectBegin \"{0}\"\nObjectInstance \"{1}\"\nAttributeBegin\nTranslate {2} 0 0\n"
        "ObjectInstance \"{1}\"\nAttributeEnd\nObjectEnd\n",
        i, i - 1, std::pow(2.0, i));
  scene << fmt::format("ObjectInstance \"{}\"\n", levels);
  return directory / "scene.pbrt";
}

Path nested_objects(const Path& directory, double) { return nested(directory, 22); }
Path deeply_nested_objects(const Path& directory, double) { return nested(directory, 30); }

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
      pbrt_head, size);
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
  std::string closing = pbrt_triangle;
  for (int i = 0; i < count; ++i) closing += "AttributeEnd\n";
  return write_lines(
      directory, count,
      [](int i) { return fmt::format("AttributeBegin\nAttribute \"shape\" \"float a{}\" 1\n", i); }, closing);
}

}  // namespace

std::vector<MemoryRow> memory_record_rows() {
  return {{"large_triangles", 64 * mib, "--domains 4096", large_triangles},
          {"needles", 200 * mib, "--domains 512", needles},
          {"lights", 128 * mib, "", lights},
          {"materials", 256 * mib, "", materials},
          {"mitsuba_instances", 256 * mib, "", mitsuba_instances},
          {"small_shapes", 256 * mib, "", small_shapes},
          {"long_names", 128 * mib, "", long_names},
          {"diagnostics", 128 * mib, "", diagnostics},
          {"prototypes", 256 * mib, "", prototypes},
          {"nested_objects", 256 * mib, "--flatten", nested_objects},
          {"deeply_nested_objects", 64 * mib, "", deeply_nested_objects},
          {"grid_medium", 256 * mib, "", grid_medium},
          {"obj_groups", 128 * mib, "", obj_groups},
          {"curves", 256 * mib, "", curves},
          {"attributes", 128 * mib, "", attributes},
          {"open_blocks", 64 * mib, "", open_blocks}};
}

}  // namespace vitrail::test
