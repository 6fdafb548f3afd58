// SPDX-License-Identifier: Apache-2.0
#include "bundle/packs.h"

#include <fmt/format.h>

#include <algorithm>

#include "bundle/domain_layout.h"
#include "bundle/write_file.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace fs = std::filesystem;

namespace {

std::uint64_t next_page(std::uint64_t offset) { return (offset + pack_page - 1) / pack_page * pack_page; }

// Writes a domain's file into a pack, piece by piece.
void append(const fs::path& file, std::uint64_t bytes, const ByteSink& write) {
  constexpr std::uint64_t piece = 1 << 20;
  const RegularFile in(file);
  std::vector<std::byte> buffer(std::min(bytes, piece));
  for (std::uint64_t done = 0; done < bytes;) {
    const std::span<std::byte> part(buffer.data(), std::min(bytes - done, piece));
    if (!in.is_open() || !in.read(part, done))
      throw MachineError(fmt::format("cannot read {}: it was cut or removed", file.string()));
    write(part);
    done += part.size();
  }
}

}  // namespace

std::shared_ptr<const RegularFile> OpenPacks::open(const fs::path& pack) {
  const std::lock_guard lock(mutex_);
  for (const auto& [path, file] : open_)
    if (path == pack) return file;
  auto file = std::make_shared<const RegularFile>(pack);
  if (!file->is_open()) return file;
  if (open_.size() == most) open_.pop_front();
  return open_.emplace_back(pack, std::move(file)).second;
}

bool is_pack(const fs::path& file) { return file.filename().string().starts_with("pack-"); }

std::vector<Stored> domains_of_pack(const fs::path& pack) {
  const RegularFile in(pack);
  std::vector<Stored> found;
  for (std::uint64_t offset = 0; offset < in.size();) {
    layout::DomainHeader header{};
    const std::uint64_t left = in.size() - offset;
    const bool sound = in.read(std::as_writable_bytes(std::span(&header, 1)), offset) &&
                       header.magic == layout::domain_magic && 0 < header.file_bytes &&
                       header.file_bytes <= left;
    found.push_back({pack, offset, sound ? header.file_bytes : left});
    offset = next_page(offset + *found.back().bytes);
  }
  return found;
}

void check_pack(const fs::path& pack, std::vector<Stored> domains) {
  const RegularFile in(pack);
  const auto reject = [&](std::uint64_t at) {
    throw Error(fmt::format("its bytes from {} on belong to no domain", at), {pack.string()});
  };
  std::ranges::sort(domains, {}, &Stored::offset);
  std::uint64_t end = 0;
  for (const Stored& s : domains) {
    if (s.offset != next_page(end)) reject(end);
    std::vector<std::byte> between(s.offset - end);
    if (!in.read(between, end)) return;
    if (std::ranges::any_of(between, [](std::byte b) { return b != std::byte{0}; })) reject(end);
    end = s.offset + s.bytes.value_or(0);
  }
  if (in.size() > end) reject(end);
}

void write_packs(const fs::path& bundle, Manifest& manifest, std::uint64_t most_bytes) {
  std::vector<DomainInfo>& domains = manifest.domains;
  std::uint32_t next = 0;
  for (std::uint32_t pack = 0; next < domains.size(); ++pack)
    write_file(pack_path(bundle, pack), [&](const ByteSink& write) {
      std::uint64_t end = 0;
      do {
        const PackPlace at{pack, next_page(end)};
        write(std::vector<std::byte>(at.offset - end));
        const fs::path file = domain_path(bundle, next);
        append(file, domains[next].bytes, write);
        fs::remove(file);
        domains[next].pack = at;
        end = at.offset + domains[next++].bytes;
      } while (next < domains.size() && next_page(end) + domains[next].bytes <= most_bytes);
    });
}

}  // namespace vitrail
