// SPDX-License-Identifier: Apache-2.0
#include "images/nanovdb_file.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <string_view>

namespace vitrail::nanovdb_file {

namespace {

using nanovdb::io::Codec;
using nanovdb::io::Header;
using nanovdb::io::MetaData;

void check_header(const Header& header, const File& file) {
  if (header.magic != NANOVDB_MAGIC_NUMBER) file.fail("the file does not begin with NanoVDB0");
  if (header.version.getMajor() != NANOVDB_MAJOR_VERSION_NUMBER)
    file.fail(fmt::format("the file is of version {}, only {} is read; write it anew with nanovdb_convert",
                          header.version.getMajor(), NANOVDB_MAJOR_VERSION_NUMBER));
}

// The stored bytes, piece by piece, through zlib.
class Inflater {
 public:
  Inflater(const File& file, std::uint64_t at, std::uint64_t end) : file_(file), at_(at), end_(end) {
    if (inflateInit(&stream_) != Z_OK) throw MachineError("zlib cannot be started");
  }
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;
  Inflater& operator=(const Inflater&) = delete;

  void fill(std::vector<char>& to) {
    constexpr std::uint64_t piece = 1u << 20;
    std::vector<char> stored;
    for (std::uint64_t made = 0; made < to.size();) {
      if (stream_.avail_in == 0 && at_ < end_) {
        stored.resize(std::min(piece, end_ - at_));
        file_.read(at_, stored);
        at_ += stored.size();
        stream_.next_in = reinterpret_cast<Bytef*>(stored.data());
        stream_.avail_in = static_cast<uInt>(stored.size());
      }
      const auto room = static_cast<uInt>(std::min<std::uint64_t>(piece, to.size() - made));
      stream_.next_out = reinterpret_cast<Bytef*>(to.data() + made);
      stream_.avail_out = room;
      const int result = inflate(&stream_, Z_NO_FLUSH);
      made += room - stream_.avail_out;
      if (made < to.size() && result != Z_OK) file_.fail("a compressed grid ends too early");
    }
  }

 private:
  const File& file_;
  std::uint64_t at_, end_;
  z_stream stream_{};
};

}  // namespace

File::File(const std::filesystem::path& path) : path_(path), file_((check_input(path), path)) {
  if (!file_.is_open()) fail(std::strerror(file_.reason()));
}

void File::read(std::uint64_t offset, std::span<char> to) const {
  if (offset > size() || to.size() > size() - offset || !file_.read(std::as_writable_bytes(to), offset))
    fail("the file ends within a grid");
}

void File::fail(const std::string& message) const { throw Error("NanoVDB: " + message, {path_.string()}); }

std::optional<StoredGrid> find_grid(const File& file, const std::string& name) {
  std::uint64_t at = 0;
  do {
    const auto header = file.at<Header>(at);
    check_header(header, file);
    at += sizeof(Header);
    std::optional<StoredGrid> wanted;
    std::uint64_t size = 0;  // of the grids of the segment, which stand behind what describes them
    for (std::size_t i = 0; i < header.gridCount; ++i) {
      const auto meta = file.at<MetaData>(at);
      if (meta.nameSize > file.size() || meta.fileSize > file.size())
        file.fail("the file ends within a grid");
      std::string known(meta.nameSize, '\0');
      file.read(at + sizeof(MetaData), known);
      known.resize(std::min(known.size(), known.find('\0')));
      if (!wanted && known == name) wanted = StoredGrid{meta, size};
      at += sizeof(MetaData) + meta.nameSize;
      size += meta.fileSize;
    }
    if (wanted) {
      wanted->offset += at;
      return wanted;
    }
    at += size;
  } while (at < file.size());
  return {};
}

std::vector<char> unpacked(const StoredGrid& grid, std::uint64_t most, const File& file) {
  const std::uint64_t stored = grid.meta.fileSize, size = std::min(most, grid.meta.gridSize);
  constexpr std::uint64_t most_by_deflate = 1032;  // bytes of one
  const bool deflated = grid.meta.codec == Codec::ZIP;
  if (grid.meta.codec != Codec::NONE && !deflated)
    file.fail("the grid is compressed by Blosc, which is not read; write it anew with nanovdb_convert --zip");
  if (size > stored * (deflated ? most_by_deflate : 1)) file.fail("a grid ends too early");
  std::vector<char> bytes(size);
  if (deflated) {
    const auto count = file.at<std::uint64_t>(grid.offset);  // of the deflated bytes behind it
    if (count > stored - sizeof count) file.fail("a compressed grid ends too early");
    Inflater(file, grid.offset + sizeof count, grid.offset + sizeof count + count).fill(bytes);
  } else {
    file.read(grid.offset, bytes);
  }
  return bytes;
}

}  // namespace vitrail::nanovdb_file
