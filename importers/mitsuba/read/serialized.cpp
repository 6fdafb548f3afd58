// SPDX-License-Identifier: Apache-2.0
#include "importers/mitsuba/read/serialized.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "importers/bytes/input_bytes.h"
#include "scene/system/diagnostics.h"

namespace vitrail::mitsuba {

namespace {

static_assert(std::endian::native == std::endian::little, "values are read as they lie in memory");

constexpr std::uint16_t magic = 0x041C;
enum Flag : std::uint32_t { has_normals = 1, has_uvs = 2, has_colors = 8, is_double = 0x2000 };

struct Place {
  const std::filesystem::path& file;
  int index;
  std::size_t byte = 0;
  [[noreturn]] void fail(const std::string& message) const {
    throw Error(fmt::format("mesh {} of the file (at byte {}): {}", index, byte, message), {file.string()});
  }
};

template <class T>
T load(const char* from) {
  T value;
  std::memcpy(&value, from, sizeof(T));
  return value;
}

// The values of a zlib stream, inflated as they are asked for.
class Inflater {
 public:
  Inflater(const char* begin, std::size_t size, const Place& place)
      : place_(place), in_(begin), left_(size), limit_(most_bytes(size)) {
    if (::inflateInit(&stream_) != Z_OK) throw std::bad_alloc();
  }
  ~Inflater() { ::inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  void read(void* to, std::size_t size) {
    auto* out = static_cast<Bytef*>(to);
    while (size > 0) {
      constexpr std::size_t step = std::size_t{1} << 20;
      const auto wanted = static_cast<uInt>(std::min(size, step));
      stream_.next_out = out;
      stream_.avail_out = wanted;
      inflate_some();
      const std::size_t got = wanted - stream_.avail_out;
      out += got;
      size -= got;
    }
  }

  template <class T>
  T read() {
    T value;
    read(&value, sizeof value);
    return value;
  }

  // Before memory is claimed for `count` rows of `row_size` bytes: no mesh deflates to less than 1/128.
  void require_room(std::uint64_t count, std::size_t row_size, const char* what) {
    if (count <= limit_ / row_size) {
      limit_ -= count * row_size;
      return;
    }
    place_.fail(fmt::format("{} {} cannot be in a stream of {} bytes", count, what, left_));
  }

 private:
  static std::uint64_t most_bytes(std::size_t size) {
    constexpr std::uint64_t ratio = 128, always = std::uint64_t{64} << 20;
    return std::max(ratio * size, always);
  }

  void inflate_some() {
    const uInt before = stream_.avail_out;
    if (stream_.avail_in == 0 && left_ > 0) {
      const std::size_t next = std::min(left_, std::size_t{1} << 20);
      stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(in_));
      stream_.avail_in = static_cast<uInt>(next);
      in_ += next;
      left_ -= next;
    }
    const int code = ended_ ? Z_BUF_ERROR : ::inflate(&stream_, Z_NO_FLUSH);
    ended_ |= code == Z_STREAM_END;
    if (code == Z_OK || code == Z_STREAM_END || (code == Z_BUF_ERROR && !ended_ && left_ > 0)) return;
    if (stream_.avail_out != before) return;
    if (code == Z_BUF_ERROR) place_.fail("its zlib stream ends too early");
    place_.fail(fmt::format("its zlib stream is damaged: {}", stream_.msg ? stream_.msg : "unknown"));
  }

  const Place& place_;
  const char* in_;
  std::size_t left_;
  std::uint64_t limit_;  // of bytes that rows may still take
  z_stream stream_{};
  bool ended_ = false;
};

// `width` numbers a row, of either precision, in pieces that stay in the cache.
template <std::size_t width, class T>
std::vector<T> read_rows(Inflater& in, std::uint64_t count, bool doubles, const Place& place,
                         const char* what) {
  static_assert(sizeof(T) == width * sizeof(float) && std::is_trivially_copyable_v<T>);
  in.require_room(count, width * (doubles ? sizeof(double) : sizeof(float)), what);
  const std::size_t piece = std::min<std::uint64_t>(4096, count);
  std::vector<T> rows;
  std::vector<float> values(width * piece);
  std::vector<double> wide(doubles ? values.size() : 0);
  for (std::uint64_t done = 0; done < count; done += piece) {
    const std::size_t rows_now = std::min<std::uint64_t>(piece, count - done), n = width * rows_now;
    if (doubles) {
      in.read(wide.data(), n * sizeof(double));
      std::transform(wide.begin(), wide.begin() + static_cast<std::ptrdiff_t>(n), values.begin(),
                     [](double v) { return static_cast<float>(v); });
    } else {
      in.read(values.data(), n * sizeof(float));
    }
    for (std::size_t i = 0; i < n; ++i)
      if (!std::isfinite(values[i]))
        place.fail(fmt::format("value {} of its {} is not a finite single-precision number", done * width + i,
                               what));
    rows.resize(done + rows_now);
    std::memcpy(static_cast<void*>(rows.data() + done), values.data(), rows_now * sizeof(T));
  }
  return rows;
}

std::vector<std::array<std::uint32_t, 3>> read_triangles(Inflater& in, std::uint64_t count,
                                                         std::uint64_t vertices, const Place& place) {
  in.require_room(count, 3 * sizeof(std::uint32_t), "triangles");
  constexpr std::uint64_t piece = 65536;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (std::uint64_t done = 0; done < count; done += piece) {
    const std::uint64_t now = std::min(piece, count - done);
    triangles.resize(done + now);
    in.read(&triangles[done], now * sizeof(triangles[0]));
    for (std::uint64_t i = done; i < done + now; ++i)
      for (const std::uint32_t corner : triangles[i])
        if (corner >= vertices)
          place.fail(fmt::format("triangle {} refers to vertex {}, but there are {} (counted from 0)", i,
                                 corner, vertices));
  }
  return triangles;
}

void skip_name(Inflater& in, const Place& place) {
  constexpr int longest = 1 << 16;
  for (int i = 0; in.read<char>() != 0; ++i)
    if (i == longest) place.fail("its name does not end");
}

TriangleMesh read_mesh(Inflater& in, int version, const Place& place) {
  const auto flags = in.read<std::uint32_t>();
  if (version == 4) skip_name(in, place);
  const auto vertices = in.read<std::uint64_t>(), triangles = in.read<std::uint64_t>();
  if (vertices > std::numeric_limits<std::uint32_t>::max())
    place.fail(fmt::format("{} vertices are more than 32 bits count", vertices));
  const bool doubles = flags & is_double;
  TriangleMesh mesh;
  mesh.positions = read_rows<3, Point3f>(in, vertices, doubles, place, "positions");
  if (flags & has_normals) mesh.normals = read_rows<3, Normal3f>(in, vertices, doubles, place, "normals");
  if (flags & has_uvs) mesh.uvs = read_rows<2, Point2f>(in, vertices, doubles, place, "texture coordinates");
  if (flags & has_colors) {
    const auto colors = read_rows<3, Point3f>(in, vertices, doubles, place, "colours");
    MeshAttribute attribute{"vertex_color", false, 3, {}};
    for (const Point3f& c : colors) attribute.values.insert(attribute.values.end(), {c.x, c.y, c.z});
    mesh.attributes.push_back(std::move(attribute));
  }
  mesh.triangles = read_triangles(in, triangles, vertices, place);
  return mesh;
}

// Where the mesh begins and where what belongs to it ends.
struct Extent {
  std::size_t begin, end;
};

Extent extent_of(const InputBytes& bytes, int version, int index, const Place& place) {
  if (index == 0) return {0, bytes.size()};
  const std::size_t offset_size = version == 4 ? sizeof(std::uint64_t) : sizeof(std::uint32_t);
  const auto count = load<std::uint32_t>(bytes.end() - sizeof(std::uint32_t));
  if (count > (bytes.size() - sizeof(std::uint32_t)) / offset_size)
    place.fail(
        fmt::format("the file of {} bytes cannot hold the {} meshes that it announces", bytes.size(), count));
  if (index < 0 || static_cast<std::uint32_t>(index) >= count)
    place.fail(fmt::format("shape_index is {}, but the file has {} meshes (counted from 0)", index, count));
  const std::size_t table = bytes.size() - sizeof(std::uint32_t) - count * offset_size;
  const char* const entry = bytes.begin() + table + static_cast<std::size_t>(index) * offset_size;
  const std::uint64_t begin = version == 4 ? load<std::uint64_t>(entry) : load<std::uint32_t>(entry);
  if (begin >= table) place.fail(fmt::format("its offset {} is not within the file", begin));
  return {begin, table};
}

}  // namespace

TriangleMesh read_serialized(const std::filesystem::path& file, int index) {
  constexpr std::size_t header = 4;
  const InputBytes bytes(file);
  Place place{file, index};
  if (bytes.size() < header) place.fail("the file is too short");
  const auto version_at = [&](std::size_t byte) -> int {
    if (load<std::uint16_t>(bytes.begin() + byte) != magic)
      place.fail("not a serialized mesh of Mitsuba: it does not begin with 1c 04");
    const int version = load<std::uint16_t>(bytes.begin() + byte + 2);
    if (version != 3 && version != 4) place.fail(fmt::format("version {} is neither 3 nor 4", version));
    return version;
  };
  const Extent extent = extent_of(bytes, version_at(0), index, place);
  place.byte = extent.begin;
  if (extent.end - extent.begin < header) place.fail("the file ends there");
  const int version = version_at(extent.begin);
  Inflater in(bytes.begin() + extent.begin + header, extent.end - extent.begin - header, place);
  return read_mesh(in, version, place);
}

}  // namespace vitrail::mitsuba
