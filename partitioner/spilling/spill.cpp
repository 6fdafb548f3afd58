// SPDX-License-Identifier: Apache-2.0
#include "partitioner/spilling/spill.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>

#include "scene/system/diagnostics.h"
#include "scene/system/memory_guard.h"

namespace vitrail {

namespace {

[[noreturn]] void fail(const char* what, const std::filesystem::path& file, int reason) {
  throw MachineError(fmt::format("cannot {} {}: {}", what, file.string(), std::strerror(reason)));
}

class Descriptor {
 public:
  Descriptor(const std::filesystem::path& file, int flags)
      : file_(file), number_(::open(file.c_str(), flags | O_CLOEXEC, 0600)) {
    if (number_ < 0) fail("open", file, errno);
  }
  ~Descriptor() { ::close(number_); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  void write(std::span<const std::byte> bytes) const {
    while (!bytes.empty()) {
      const ssize_t n = ::write(number_, bytes.data(), bytes.size());
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) fail("write", file_, errno);
      bytes = bytes.subspan(static_cast<std::size_t>(n));
    }
  }
  void read(std::span<std::byte> bytes, std::uint64_t offset) const {
    while (!bytes.empty()) {
      const ssize_t n = ::pread(number_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
      if (n < 0 && errno == EINTR) continue;
      if (n <= 0) fail("read", file_, n < 0 ? errno : EIO);
      bytes = bytes.subspan(static_cast<std::size_t>(n));
      offset += static_cast<std::uint64_t>(n);
    }
  }

 private:
  const std::filesystem::path& file_;
  int number_;
};

template <class T>
void append(std::vector<std::byte>& to, std::span<const T> values) {
  const auto bytes = std::as_bytes(values);
  to.insert(to.end(), bytes.begin(), bytes.end());
}

template <class T>
void append_chosen(std::vector<std::byte>& to, const std::vector<T>& values,
                   std::span<const std::uint32_t> chosen) {
  if (values.empty()) return;
  std::size_t at = to.size();
  to.resize(at + chosen.size() * sizeof(T));
  for (const std::uint32_t i : chosen) {
    std::memcpy(to.data() + at, &values[i], sizeof(T));
    at += sizeof(T);
  }
}

// Reads what was appended.
class Cursor {
 public:
  explicit Cursor(const std::byte* at) : at_(at) {}
  template <class T>
  void take(std::span<T> values) {
    if (!values.empty()) std::memcpy(static_cast<void*>(values.data()), at_, values.size_bytes());
    at_ += values.size_bytes();
  }

 private:
  const std::byte* at_;
};

// All triangles of the content, ascending.
std::vector<std::uint32_t> triangles_in(const CellContent& content) {
  std::vector<std::uint32_t> all(content.size()), cut;
  for (const Piece& p : content.pieces) cut.push_back(p.triangle);
  std::ranges::merge(content.whole, cut, all.begin());
  return all;
}

}  // namespace

BucketSpill::BucketSpill(std::filesystem::path directory, std::size_t buckets, const PlacementRule& rule,
                         std::uint64_t buffer_bytes)
    : directory_(std::move(directory)), rule_(rule), buffer_bytes_(buffer_bytes), buckets_(buckets) {
  std::error_code error;
  std::filesystem::create_directory(directory_, error);
  if (error) fail("make", directory_, error.value());
  for (std::size_t i = 0; i < buckets; ++i) buckets_[i].file = directory_ / fmt::format("{:06}.bucket", i);
}

BucketSpill::~BucketSpill() {
  const GrantedMemory in_any_case;
  std::error_code ignored;
  std::filesystem::remove_all(directory_, ignored);
}

std::size_t BucketSpill::bytes_of(const Chunk& c) const {
  const std::size_t triangle =
      sizeof(std::uint32_t) + sizeof(Triangle) + (rule_.normals ? sizeof(CornerNormals) : 0) +
      (rule_.uvs ? sizeof(CornerUvs) : 0) + rule_.attributes.size() * sizeof(CornerValues);
  return c.triangles * triangle + c.pieces * sizeof(Piece) + c.vertices * sizeof(Point3d);
}

void BucketSpill::add(std::size_t index, const NumberedTriangles& block, const CellContent& content) {
  if (content.size() == 0) return;
  const std::vector<std::uint32_t> chosen = triangles_in(content);
  std::vector<Piece> pieces = content.pieces;
  for (Piece& p : pieces)
    p.triangle = static_cast<std::uint32_t>(std::ranges::lower_bound(chosen, p.triangle) - chosen.begin());

  Bucket& bucket = buckets_[index];
  const std::lock_guard lock(bucket.mutex);
  bucket.chunks.push_back(
      {bucket.written + bucket.buffer.size(), block.ids[chosen[0]], static_cast<std::uint32_t>(chosen.size()),
       static_cast<std::uint32_t>(pieces.size()), static_cast<std::uint32_t>(content.piece_vertices.size())});
  append_chosen(bucket.buffer, block.ids, chosen);
  append_chosen(bucket.buffer, block.triangles, chosen);
  append_chosen(bucket.buffer, block.normals, chosen);
  append_chosen(bucket.buffer, block.uvs, chosen);
  for (const auto& slot : block.attributes) append_chosen(bucket.buffer, slot, chosen);
  append(bucket.buffer, std::span<const Piece>(pieces));
  append(bucket.buffer, std::span<const Point3d>(content.piece_vertices));
  if (bucket.buffer.size() >= buffer_bytes_) write(bucket);
}

void BucketSpill::write(Bucket& bucket) {
  if (bucket.buffer.empty()) return;
  Descriptor(bucket.file, O_WRONLY | O_CREAT | O_APPEND).write(bucket.buffer);
  bucket.written += bucket.buffer.size();
  bucket.buffer.clear();
}

void BucketSpill::flush() {
  for (Bucket& bucket : buckets_) {
    write(bucket);
    bucket.buffer = {};
    bytes_ += bucket.written;
  }
}

LoadedCell BucketSpill::take(std::size_t index) {
  Bucket& bucket = buckets_[index];
  std::vector<Chunk>& chunks = bucket.chunks;
  std::ranges::sort(chunks, {}, &Chunk::first_id);
  struct Start {
    std::size_t triangle = 0, piece = 0, vertex = 0;
  };
  std::vector<Start> starts{{}};
  for (const Chunk& c : chunks)
    starts.push_back({starts.back().triangle + c.triangles, starts.back().piece + c.pieces,
                      starts.back().vertex + c.vertices});
  const Start all = starts.back();
  LoadedCell cell;
  if (chunks.empty()) return cell;
  if (all.vertex > std::numeric_limits<std::uint32_t>::max())
    throw MachineError(
        "too many triangles are cut for one part of the scene; less --memory makes parts smaller");
  static_cast<PlacedTriangles&>(cell.triangles) = make_room(rule_, all.triangle);
  cell.triangles.ids.resize(all.triangle);
  cell.cut.pieces.resize(all.piece);
  cell.cut.piece_vertices.resize(all.vertex);
  {
    const Descriptor file(bucket.file, O_RDONLY);
    tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t i) {
      const Chunk& c = chunks[i];
      std::vector<std::byte> bytes(bytes_of(c));
      file.read(bytes, c.offset);
      Cursor cursor(bytes.data());
      const Start at = starts[i];
      const auto part = [&](auto& values) { return std::span(values).subspan(at.triangle, c.triangles); };
      cursor.take(part(cell.triangles.ids));
      cursor.take(part(cell.triangles.triangles));
      if (rule_.normals) cursor.take(part(cell.triangles.normals));
      if (rule_.uvs) cursor.take(part(cell.triangles.uvs));
      for (auto& slot : cell.triangles.attributes) cursor.take(part(slot));
      const auto pieces = std::span(cell.cut.pieces).subspan(at.piece, c.pieces);
      cursor.take(pieces);
      for (Piece& p : pieces) {
        p.triangle += static_cast<std::uint32_t>(at.triangle);
        p.first_vertex += static_cast<std::uint32_t>(at.vertex);
      }
      cursor.take(std::span(cell.cut.piece_vertices).subspan(at.vertex, c.vertices));
    });
  }
  std::error_code ignored;
  std::filesystem::remove(bucket.file, ignored);
  chunks = {};
  return cell;
}

}  // namespace vitrail
