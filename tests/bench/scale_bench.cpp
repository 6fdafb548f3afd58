// SPDX-License-Identifier: Apache-2.0
// Seconds of processors that a scene of N, 4N and 16N like things takes: they are to grow as the things do.
//
//   bench_scale [case …]        names of cases; all of them without any
#include <fmt/format.h>

#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>

#include "images/image_files.h"
#include "importers/export.h"
#include "importers/import.h"
#include "partitioner/appearance/bake_image.h"
#include "partitioner/partition.h"
#include "scene/spectra/rgb_to_spectrum.h"

namespace vitrail {
namespace {

namespace fs = std::filesystem;

constexpr const char* triangle = "Shape \"trianglemesh\" \"point3 P\" [0 0 0 1 0 0 0 1 0]\n";
constexpr const char* head = "Film \"rgb\"\nWorldBegin\n";

fs::path folder() {
  const fs::path path = fs::temp_directory_path() / "vitrail-bench-scale";
  fs::create_directories(path);
  return path;
}

fs::path written(const char* name, const std::function<std::string(int)>& line, int count,
                 const std::string& before = "", const std::string& after = "") {
  const fs::path path = folder() / name;
  std::ofstream file(path);
  file << before;
  for (int i = 0; i < count; ++i) file << line(i);
  file << after;
  return path;
}

void convert(const fs::path& in, const char* out) { export_scene(import_scene(in).scene, folder() / out); }

void bundle(const fs::path& in) {
  fs::remove_all(folder() / "out.vit");
  partition(import_scene(in).scene, folder() / "out.vit", {.domains = 8});
}

fs::path image() {
  const fs::path path = folder() / "small.exr";
  if (!fs::exists(path)) write_exr_image(path, black_image(2, 2, 3));
  return path;
}

fs::path shapes_with_alpha(int n) {
  return written(
      "alpha.pbrt",
      [&](int i) {
        return fmt::format(
            "Shape \"trianglemesh\" \"point3 P\" [{0} 0 0 {0}.5 0 0 {0} 1 0] \"float alpha\" {1}\n", i % 1000,
            0.1 + 0.8 * i / n);
      },
      n, head);
}

fs::path library(int n) {
  const fs::path map = image().filename();
  written(
      "many.mtl",
      [&](int i) {
        return fmt::format("newmtl m{0}\nKd {1} {1} {1}\nKa 1 1 1\nmap_Kd {2}\n", i, 0.1 + 0.8 * i / n,
                           map.string());
      },
      n);
  return written(
      "many.obj", [](int i) { return fmt::format("usemtl m{}\nf 1 2 3\n", i); }, n,
      "mtllib many.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n");
}

fs::path bumps(int n) {
  return written(
      "bumps.pbrt",
      [&](int i) {
        return fmt::format(
            "Texture \"t{0}\" \"float\" \"imagemap\" \"string filename\" \"{1}\"\n"
            "Texture \"s{0}\" \"float\" \"scale\" \"texture tex\" \"t{0}\" \"float scale\" .5\n"
            "Material \"diffuse\" \"texture displacement\" \"s{0}\" \"string normalmap\" \"{1}\"\n",
            i, image().string());
      },
      n, head, triangle);
}

fs::path equal_names(int n) {
  return written(
      "names.pbrt",
      [](int) {
        return std::string(
                   "MakeNamedMaterial \"same\" \"string type\" \"diffuse\"\nNamedMaterial \"same\"\n") +
               triangle;
      },
      n, head);
}

fs::path colours(int n) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(0, 1);
  return written(
      "colours.pbrt",
      [&](int) {
        const double r = u(random), g = u(random), b = u(random);
        return fmt::format("Material \"diffuse\" \"rgb reflectance\" [{} {} {}]\n{}", r, g, b, triangle);
      },
      n, head);
}

// Objects of a few shapes, of which none shines, used n times.
fs::path instances(int n) {
  std::string object = std::string(head) + "ObjectBegin \"o\"\n";
  for (int i = 0; i < 100; ++i) object += triangle;
  return written(
      "instances.pbrt",
      [](int i) {
        return fmt::format("AttributeBegin Translate {} {} 0 ObjectInstance \"o\" AttributeEnd\n", i % 100,
                           i / 100);
      },
      n, object + "ObjectEnd\n");
}

// Two of the level before in each.
fs::path nested(int levels) {
  return written(
      "nested.pbrt",
      [](int i) {
        return fmt::format(
            "ObjectBegin \"o{0}\" ObjectInstance \"o{1}\" Translate {2} 0 0 ObjectInstance \"o{1}\" "
            "ObjectEnd\n",
            i + 1, i, std::ldexp(2.0, i));
      },
      levels, std::string(head) + "ObjectBegin \"o0\" " + triangle + "ObjectEnd\n",
      fmt::format("ObjectInstance \"o{}\"\n", levels));
}

fs::path shared_mesh(int n) {
  constexpr int side = 40;
  std::string ply = fmt::format(
      "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float "
      "z\nelement face "
      "{}\nproperty list uchar int vertex_indices\nend_header\n",
      (side + 1) * (side + 1), 2 * side * side);
  for (int j = 0; j <= side; ++j)
    for (int i = 0; i <= side; ++i) ply += fmt::format("{} {} {}\n", i, j, (i * j) % 7);
  for (int j = 0; j < side; ++j)
    for (int i = 0; i < side; ++i) {
      const int a = j * (side + 1) + i, b = a + side + 1;
      ply += fmt::format("3 {} {} {}\n3 {} {} {}\n", a, a + 1, b, b, a + 1, b + 1);
    }
  std::ofstream(folder() / "leaf.ply") << ply;
  return written(
      "shared.xml",
      [](int i) {
        return fmt::format(
            "<shape type=\"ply\"><string name=\"filename\" value=\"leaf.ply\"/><transform "
            "name=\"to_world\"><translate x=\"{}\" y=\"{}\"/></transform></shape>\n",
            50 * (i % 100), 50 * (i / 100));
      },
      n, "<scene version=\"3.0.0\">\n", "</scene>\n");
}

void noise(int pixels) {
  const int size = static_cast<int>(std::sqrt(static_cast<double>(pixels)));
  Image values = black_image(size, size, 3);
  std::mt19937 random(1);
  std::uniform_int_distribution<int> u(0, 255);
  for (float& v : values.values) v = static_cast<float>(srgb_decode(u(random) / 255.0));
  const ReflectanceFitter fitter;
  write_baked_image(folder() / "noise.tex", rows_of(std::move(values)), TextureUse::reflectance, true,
                    fitter);
}

struct Case {
  const char* name;
  int count;  // at 1×
  std::function<void(int)> prepare, run;
};

double seconds(const std::function<void()>& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

std::vector<Case> cases() {
  const auto of = [](fs::path (*make)(int), const char* file, auto work) {
    return std::pair<std::function<void(int)>, std::function<void(int)>>{[=](int n) { make(n); },
                                                                         [=](int) { work(folder() / file); }};
  };
  std::vector<Case> all;
  const auto add = [&](const char* name, int count, auto parts) {
    all.push_back({name, count, parts.first, parts.second});
  };
  add("alpha-import", 8000, of(shapes_with_alpha, "alpha.pbrt", [](const fs::path& f) { import_scene(f); }));
  add("alpha-mitsuba", 8000,
      of(shapes_with_alpha, "alpha.pbrt", [](const fs::path& f) { convert(f, "out.xml"); }));
  add("alpha-partition", 8000, of(shapes_with_alpha, "alpha.pbrt", bundle));
  add("mtl-import", 5000, of(library, "many.obj", [](const fs::path& f) { import_scene(f); }));
  add("mtl-pbrt", 5000, of(library, "many.obj", [](const fs::path& f) { convert(f, "out.pbrt"); }));
  add("bumps-mitsuba", 2000, of(bumps, "bumps.pbrt", [](const fs::path& f) { convert(f, "out.xml"); }));
  add("names-mitsuba", 2000, of(equal_names, "names.pbrt", [](const fs::path& f) { convert(f, "out.xml"); }));
  add("names-pbrt", 2000, of(equal_names, "names.pbrt", [](const fs::path& f) { convert(f, "out.pbrt"); }));
  add("names-obj", 2000, of(equal_names, "names.pbrt", [](const fs::path& f) { convert(f, "out.obj"); }));
  add("names-povray", 2000, of(equal_names, "names.pbrt", [](const fs::path& f) { convert(f, "out.pov"); }));
  add("colours-import", 5000, of(colours, "colours.pbrt", [](const fs::path& f) { import_scene(f); }));
  add("colours-partition", 5000, of(colours, "colours.pbrt", bundle));
  add("instances-partition", 2000, of(instances, "instances.pbrt", bundle));
  add("nested-partition", 7, of(nested, "nested.pbrt", bundle));
  add("nested-mitsuba", 7, of(nested, "nested.pbrt", [](const fs::path& f) { convert(f, "out.xml"); }));
  add("shared-partition", 100, of(shared_mesh, "shared.xml", bundle));
  all.push_back({"noise", 1 << 20, [](int) {}, noise});
  return all;
}

}  // namespace
}  // namespace vitrail

int main(int argc, char** argv) {
  using namespace vitrail;
  const std::vector<std::string> wanted(argv + 1, argv + argc);
  for (const Case& c : cases()) {
    if (!wanted.empty() && std::ranges::find(wanted, c.name) == wanted.end()) continue;
    fmt::print("{:20} {:>8} ×", c.name, c.count);
    std::fflush(stdout);
    const bool levels = std::string(c.name).starts_with("nested");
    for (const int factor : {1, levels ? 2 : 4, levels ? 4 : 16}) {
      c.prepare(c.count * factor);
      fmt::print("  {}: {:.2f} s", factor, seconds([&] { c.run(c.count * factor); }));
      std::fflush(stdout);
    }
    fmt::print("\n");
  }
  fs::remove_all(folder());
}
