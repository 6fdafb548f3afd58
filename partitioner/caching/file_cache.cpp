// SPDX-License-Identifier: Apache-2.0
#include "partitioner/caching/file_cache.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#include "bundle/checksum.h"
#include "partitioner/caching/make_room.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace fs = std::filesystem;

namespace {

constexpr std::array<char, 8> entry_magic{'V', 'I', 'T', 'R', 'K', 'E', 'P', 'T'};

struct Header {
  std::array<char, 8> magic = entry_magic;
  std::uint64_t version = 1;
  std::uint64_t bytes = 0;             // of the content
  std::uint64_t content_checksum = 0;  // of the content
  FileCache::Note note{};
  std::uint64_t header_checksum = 0;  // of what stands before

  std::uint64_t sum() const {
    return checksum(std::as_bytes(std::span(this, 1)).first(sizeof(Header) - sizeof header_checksum));
  }
  bool is_whole() const { return magic == entry_magic && version == 1 && header_checksum == sum(); }
};
constexpr std::uint64_t content_offset = 4096;  // whole blocks
static_assert(sizeof(Header) == 72);

class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  int operator*() const { return number_; }
  bool is_open() const { return number_ >= 0; }
  bool close() { return number_ < 0 || ::close(std::exchange(number_, -1)) == 0; }

 private:
  int number_;
};

bool read_all(int from, std::span<std::byte> bytes, std::uint64_t offset) {
  while (!bytes.empty()) {
    const ssize_t n = ::pread(from, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(n)), offset += static_cast<std::uint64_t>(n);
  }
  return true;
}

bool write_all(int to, std::span<const std::byte> bytes, std::uint64_t offset) {
  while (!bytes.empty()) {
    const ssize_t n = ::pwrite(to, bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    bytes = bytes.subspan(static_cast<std::size_t>(n)), offset += static_cast<std::uint64_t>(n);
  }
  return true;
}

// Of a regular file, or nothing.
std::optional<std::uint64_t> size_of(int file) {
  struct stat status {};
  if (::fstat(file, &status) != 0 || !S_ISREG(status.st_mode)) return std::nullopt;
  return static_cast<std::uint64_t>(status.st_size);
}

std::optional<Header> header_of(int entry) {
  Header header;
  const auto size = size_of(entry);
  if (!size || !read_all(entry, std::as_writable_bytes(std::span(&header, 1)), 0) || !header.is_whole() ||
      *size != content_offset + header.bytes)
    return std::nullopt;
  return header;
}

enum class Copied { whole, unreadable, unwritable };

// Also gives the checksum of what was copied.
Copied copy(int from, std::uint64_t from_offset, int to, std::uint64_t to_offset, std::uint64_t bytes,
            std::uint64_t& sum) {
  std::vector<std::byte> part(std::min<std::uint64_t>(bytes, 1 << 20));
  Hasher hasher;
  for (std::uint64_t at = 0; at < bytes; at += part.size()) {
    part.resize(std::min<std::uint64_t>(part.size(), bytes - at));
    if (!read_all(from, part, from_offset + at)) return Copied::unreadable;
    hasher.add(part);
    if (!write_all(to, part, to_offset + at)) return Copied::unwritable;
  }
  sum = hasher.digest();
  return Copied::whole;
}

Descriptor open_entry(const fs::path& file) {
  return Descriptor(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK));
}

fs::path folder_named(const char* variable) {
  const char* const value = std::getenv(variable);
  return value && *value == '/' ? fs::path(value) : fs::path();
}

}  // namespace

fs::path cache_folder() {
  if (const fs::path caches = folder_named("XDG_CACHE_HOME"); !caches.empty()) return caches / "vitrail";
  if (const fs::path home = folder_named("HOME"); !home.empty()) return home / ".cache" / "vitrail";
  return {};
}

FileCache::FileCache(fs::path folder, std::uint64_t most_bytes)
    : folder_(std::move(folder)), most_bytes_(most_bytes) {}

std::optional<FileCache::Note> FileCache::note(const std::string& key) const {
  if (!is_on()) return std::nullopt;
  const Descriptor entry = open_entry(folder_ / key);
  if (!entry.is_open()) return std::nullopt;
  const auto header = header_of(*entry);
  return header ? std::optional(header->note) : std::nullopt;
}

std::optional<FileCache::Note> FileCache::take(const std::string& key, const fs::path& to) const {
  if (!is_on()) return std::nullopt;
  const Descriptor entry = open_entry(folder_ / key);
  if (!entry.is_open()) return std::nullopt;
  const auto fail = [&] {
    const int reason = errno;
    ::unlink(to.c_str());
    throw MachineError(fmt::format("cannot write {}: {}", to.string(), std::strerror(reason)));
  };
  if (const auto header = header_of(*entry)) {
    Descriptor target(::open(to.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
    if (!target.is_open()) fail();
    std::uint64_t sum = 0;
    const Copied copied = copy(*entry, content_offset, *target, 0, header->bytes, sum);
    if (copied == Copied::unwritable) fail();
    if (copied == Copied::whole && sum == header->content_checksum) {
      if (!target.close()) fail();
      ::futimens(*entry, nullptr);
      return header->note;
    }
    ::unlink(to.c_str());
  }
  ::unlink((folder_ / key).c_str());
  return std::nullopt;
}

void FileCache::keep(const std::string& key, const fs::path& from, const Note& note) const {
  if (!is_on()) return;
  std::error_code ignored;
  fs::create_directories(folder_, ignored);
  const Descriptor source(::open(from.c_str(), O_RDONLY | O_CLOEXEC));
  const auto size = source.is_open() ? size_of(*source) : std::nullopt;
  if (!size || content_offset + *size > most_bytes_) return;
  std::string temporary = (folder_ / (key + ".XXXXXX")).string();
  Descriptor entry(::mkostemp(temporary.data(), O_CLOEXEC));
  if (!entry.is_open()) return;
  Header header;
  header.bytes = *size, header.note = note;
  bool kept = copy(*source, 0, *entry, content_offset, *size, header.content_checksum) == Copied::whole;
  header.header_checksum = header.sum();
  kept = kept && write_all(*entry, std::as_bytes(std::span(&header, 1)), 0) &&
         ::ftruncate(*entry, static_cast<off_t>(content_offset + *size)) == 0 && entry.close() &&
         std::rename(temporary.c_str(), (folder_ / key).c_str()) == 0;
  if (!kept) ::unlink(temporary.c_str());
  make_room(folder_, most_bytes_);
}

}  // namespace vitrail
