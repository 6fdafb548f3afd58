// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/import_files.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <memory>
#include <stdexcept>

namespace vitrail::bench {

namespace {

// Streams text and words to a file.
class Output {
 public:
  explicit Output(const std::filesystem::path& path) : file_(std::fopen(path.c_str(), "wb"), &std::fclose) {
    if (!file_) throw std::runtime_error("cannot write " + path.string());
  }
  ~Output() { flush(); }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  template <class... Values>
  void print(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(buffer_), format, std::forward<Values>(values)...);
    if (buffer_.size() > 1u << 20) flush();
  }
  template <class Word>
  void word(Word value, bool swapped) {
    auto bits = std::bit_cast<std::uint32_t>(value);
    if (swapped) bits = __builtin_bswap32(bits);
    buffer_.append(reinterpret_cast<const char*>(&bits), reinterpret_cast<const char*>(&bits) + 4);
    if (buffer_.size() > 1u << 20) flush();
  }
  void byte(char value) { buffer_.push_back(value); }

 private:
  void flush() {
    std::fwrite(buffer_.data(), 1, buffer_.size(), file_.get());
    buffer_.clear();
  }
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  fmt::memory_buffer buffer_;
};

using Triple = std::array<float, 3>;

// Six decimals, which is what modellers write: text and bytes hold the same number.
float rounded(double value) { return static_cast<float>(std::round(value * 1e6) / 1e6); }

struct Vertex {
  Triple position, normal;
  std::array<float, 2> uv;
};

// Rings from pole to pole, each of `sectors` quads; the first and the last vertex of a ring coincide.
struct Sphere {
  std::uint32_t rings, sectors;

  std::uint32_t row() const { return sectors + 1; }
  std::uint64_t vertices() const { return std::uint64_t{rings + 1} * row(); }
  std::uint64_t triangles() const { return std::uint64_t{2} * rings * sectors; }

  Vertex vertex(std::uint32_t ring, std::uint32_t sector) const {
    const double theta = 3.14159265358979 * ring / rings;
    const double phi = 6.28318530717959 * (sector % sectors) / sectors;
    const double x = std::sin(theta) * std::cos(phi), y = std::sin(theta) * std::sin(phi),
                 z = std::cos(theta);
    const double r = 10 * (1 + 0.04 * std::sin(23 * theta) * std::sin(31 * phi));
    return {{rounded(r * x), rounded(r * y), rounded(r * z)},
            {rounded(x), rounded(y), rounded(z)},
            {rounded(double{1} * sector / sectors), rounded(double{1} * ring / rings)}};
  }
  void each_vertex(const std::function<void(const Vertex&)>& visit, bool seam_shared = false) const {
    for (std::uint32_t i = 0; i <= rings; ++i)
      for (std::uint32_t j = 0; j < (seam_shared ? sectors : row()); ++j) visit(vertex(i, j));
  }
  // Corners as (ring, sector).
  using Corner = std::array<std::uint32_t, 2>;
  void each_triangle(const std::function<void(const std::array<Corner, 3>&)>& visit) const {
    for (std::uint32_t i = 0; i < rings; ++i)
      for (std::uint32_t j = 0; j < sectors; ++j) {
        visit({Corner{i, j}, Corner{i + 1, j}, Corner{i, j + 1}});
        visit({Corner{i, j + 1}, Corner{i + 1, j}, Corner{i + 1, j + 1}});
      }
  }
  std::uint32_t index(const Corner& corner) const { return corner[0] * row() + corner[1]; }
};

void write_obj(Output& out, const Sphere& sphere, bool bare, bool seam_shared) {
  out.print("# a rippled sphere\no sphere\n");
  sphere.each_vertex(
      [&](const Vertex& v) {
        out.print("v {:.6f} {:.6f} {:.6f}\n", v.position[0], v.position[1], v.position[2]);
      },
      seam_shared);
  if (!bare) {
    sphere.each_vertex([&](const Vertex& v) { out.print("vt {:.6f} {:.6f}\n", v.uv[0], v.uv[1]); });
    sphere.each_vertex(
        [&](const Vertex& v) {
          out.print("vn {:.6f} {:.6f} {:.6f}\n", v.normal[0], v.normal[1], v.normal[2]);
        },
        seam_shared);
  }
  sphere.each_triangle([&](const std::array<Sphere::Corner, 3>& corners) {
    out.print("f");
    for (const Sphere::Corner& corner : corners) {
      const std::uint32_t uv = sphere.index(corner) + 1;
      const std::uint32_t position =
          seam_shared ? corner[0] * sphere.sectors + corner[1] % sphere.sectors + 1 : uv;
      if (bare)
        out.print(" {}", position);
      else
        out.print(" {}/{}/{}", position, uv, position);
    }
    out.print("\n");
  });
}

void write_ply(Output& out, const Sphere& sphere, bool bare, const std::string& format) {
  out.print("ply\nformat {} 1.0\nelement vertex {}\n", format, sphere.vertices());
  constexpr std::array<const char*, 8> names{"x", "y", "z", "nx", "ny", "nz", "u", "v"};
  const std::size_t columns = bare ? 3 : names.size();
  for (std::size_t i = 0; i < columns; ++i) out.print("property float {}\n", names[i]);
  out.print("element face {}\nproperty list uchar int vertex_indices\nend_header\n", sphere.triangles());
  const bool ascii = format == "ascii", swapped = format == "binary_big_endian";
  sphere.each_vertex([&](const Vertex& v) {
    const std::array<float, names.size()> row{v.position[0], v.position[1], v.position[2], v.normal[0],
                                              v.normal[1],   v.normal[2],   v.uv[0],       v.uv[1]};
    for (std::size_t i = 0; i < columns; ++i) {
      if (ascii)
        out.print("{:.6f} ", row[i]);
      else
        out.word(row[i], swapped);
    }
    if (ascii) out.print("\n");
  });
  sphere.each_triangle([&](const std::array<Sphere::Corner, 3>& c) {
    const std::array<std::uint32_t, 3> i{sphere.index(c[0]), sphere.index(c[1]), sphere.index(c[2])};
    if (ascii) return out.print("3 {} {} {}\n", i[0], i[1], i[2]);
    out.byte(3);
    for (const std::uint32_t index : i) out.word(index, swapped);
  });
}

void write_pbrt(Output& out, const Sphere& sphere, bool bare) {
  out.print("LookAt 0 -40 0 0 0 0 0 0 1\nCamera \"perspective\" \"float fov\" 40\nWorldBegin\n");
  out.print("LightSource \"infinite\"\nMaterial \"diffuse\"\nShape \"trianglemesh\"\n  \"point3 P\" [\n");
  sphere.each_vertex([&](const Vertex& v) {
    out.print("{:.6f} {:.6f} {:.6f}\n", v.position[0], v.position[1], v.position[2]);
  });
  if (!bare) {
    out.print("]\n  \"normal N\" [\n");
    sphere.each_vertex(
        [&](const Vertex& v) { out.print("{:.6f} {:.6f} {:.6f}\n", v.normal[0], v.normal[1], v.normal[2]); });
    out.print("]\n  \"point2 uv\" [\n");
    sphere.each_vertex([&](const Vertex& v) { out.print("{:.6f} {:.6f}\n", v.uv[0], v.uv[1]); });
  }
  out.print("]\n  \"integer indices\" [\n");
  sphere.each_triangle([&](const std::array<Sphere::Corner, 3>& c) {
    out.print("{} {} {}\n", sphere.index(c[0]), sphere.index(c[1]), sphere.index(c[2]));
  });
  out.print("]\n");
}

}  // namespace

std::vector<MeshFile> write_mesh_files(const std::filesystem::path& folder, std::uint32_t triangles) {
  const auto rings = static_cast<std::uint32_t>(std::sqrt(triangles / 4.0));
  const Sphere sphere{rings, 2 * rings};
  std::vector<MeshFile> files;
  const auto add = [&](const std::string& form, const std::string& name, bool bare, auto&& write) {
    const std::filesystem::path path = folder / fmt::format("{}-{}{}", triangles, bare ? "bare-" : "", name);
    files.push_back({form, path, bare});
    if (std::filesystem::exists(path)) return;
    const std::filesystem::path unfinished = path.string() + ".part";
    {
      Output out(unfinished);
      write(out);
    }
    std::filesystem::rename(unfinished, path);
  };
  for (const bool bare : {false, true}) {
    add("pbrt", "mesh.pbrt", bare, [&](Output& out) { write_pbrt(out, sphere, bare); });
    add("ply", "mesh.ply", bare, [&](Output& out) { write_ply(out, sphere, bare, "binary_little_endian"); });
    add("ply, swapped", "swapped.ply", bare,
        [&](Output& out) { write_ply(out, sphere, bare, "binary_big_endian"); });
    add("ply, ascii", "ascii.ply", bare, [&](Output& out) { write_ply(out, sphere, bare, "ascii"); });
    add("obj", "mesh.obj", bare, [&](Output& out) { write_obj(out, sphere, bare, false); });
    if (!bare) add("obj, seam", "seam.obj", bare, [&](Output& out) { write_obj(out, sphere, bare, true); });
  }
  return files;
}

}  // namespace vitrail::bench
