// SPDX-License-Identifier: Apache-2.0
#include "partitioner/caching/bundle_cache.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <exception>
#include <new>

#include "bundle/checked_json.h"
#include "partitioner/caching/make_room.h"
#include "partitioner/writing/bundle_directory.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* list_name = "kept.json";

Json to_json(const PlacedScene& placed) {
  const CensusResult& c = placed.census;
  return {{"scene_hash", placed.manifest.scene_hash},
          {"block_hashes", placed.block_hashes},
          {"duplicates", c.duplicates},
          {"strays", c.strays},
          {"cut_triangles", c.cut_triangles},
          {"pieces", c.pieces},
          {"area_error", c.area_error}};
}

PlacedScene read_placed(const fs::path& entry) {
  const Json json = read_checked_json(entry / list_name, "a kept bundle");
  PlacedScene placed{read_manifest(entry), json.at("block_hashes").get<std::vector<std::uint64_t>>(), {}};
  if (number<std::uint64_t>(json, "scene_hash") != placed.manifest.scene_hash)
    throw Error("this list belongs to another bundle", {(entry / list_name).string()});
  CensusResult& c = placed.census;
  c.duplicates = number<std::uint64_t>(json, "duplicates");
  c.strays = number<std::uint64_t>(json, "strays");
  c.cut_triangles = number<std::uint64_t>(json, "cut_triangles");
  c.pieces = number<std::uint64_t>(json, "pieces");
  c.area_error = number<double>(json, "area_error");
  return placed;
}

// A second name for the file, or where that cannot be a copy.
void link_or_copy(const fs::path& from, const fs::path& to) {
  std::error_code failed;
  fs::create_hard_link(from, to, failed);
  if (failed) fs::copy_file(from, to);
}

// Calls visit(file, check) for each domain and object that has a file; check(path) throws where that is
// another or is damaged.
void for_each_file(const Manifest& m, const auto& visit) {
  for (std::uint32_t i = 0; i < m.domains.size(); ++i)
    visit(domain_path("", i),
          [&m, i](const fs::path& file) { check_domain(m, i, MappedDomain(file), file); });
  for (std::uint32_t i = 0; i < m.objects.size(); ++i)
    if (!m.objects[i].quadric)
      visit(object_path("", i),
            [&m, i](const fs::path& file) { check_object(m, i, MappedDomain(file), file); });
}

std::uint64_t bytes_of_files(const Manifest& m) {
  std::uint64_t bytes = 0;
  for (const DomainInfo& domain : m.domains) bytes += domain.bytes;
  for (const ObjectInfo& object : m.objects) bytes += object.bytes;
  return bytes;
}

void link_files(const Manifest& m, const fs::path& from, const fs::path& to) {
  fs::create_directories(to / "domains");
  if (std::ranges::any_of(m.objects, [](const ObjectInfo& o) { return !o.quadric; }))
    fs::create_directories(to / "objects");
  for_each_file(m, [&](const fs::path& file, const auto&) { link_or_copy(from / file, to / file); });
}

void check_files(const Manifest& m, const fs::path& bundle) {
  std::vector<std::function<void()>> checks;
  for_each_file(m, [&](const fs::path& file, const auto& check) {
    checks.push_back([check, path = bundle / file] { check(path); });
  });
  tbb::parallel_for(std::size_t{0}, checks.size(), [&](std::size_t i) { checks[i](); });
}

void remove_files(const fs::path& bundle) {
  std::error_code ignored;
  for (const char* folder : {"domains", "objects"}) fs::remove_all(bundle / folder, ignored);
  fs::create_directories(bundle / "domains", ignored);
}

}  // namespace

BundleCache::BundleCache(fs::path folder, std::uint64_t most_bytes)
    : folder_(std::move(folder)), most_bytes_(most_bytes) {}

std::optional<PlacedScene> BundleCache::take(const std::string& key, const fs::path& bundle) const {
  const fs::path entry = folder_ / key;
  std::error_code unknown;
  if (!is_on() || !fs::exists(entry, unknown)) return std::nullopt;
  bool damaged = true;
  try {
    PlacedScene placed = read_placed(entry);
    link_files(placed.manifest, entry, bundle);
    check_files(placed.manifest, bundle);
    ::utimensat(AT_FDCWD, entry.c_str(), nullptr, 0);
    return placed;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const MachineError&) {
    damaged = false;
  } catch (const fs::filesystem_error&) {
    damaged = false;
  } catch (const std::exception&) {  // Error, or JSON's
  }
  remove_files(bundle);
  if (damaged) fs::remove_all(entry, unknown);
  return std::nullopt;
}

void BundleCache::keep(const std::string& key, const fs::path& bundle, const PlacedScene& placed) const {
  const std::uint64_t bytes = bytes_of_files(placed.manifest);
  if (!is_on() || bytes < least_bytes || bytes > most_bytes_) return;
  try {
    BundleDirectory entry(folder_ / key);
    link_files(placed.manifest, bundle, entry.path());
    write_checked_json(entry.path() / list_name, to_json(placed));
    write_manifest(entry.path(), placed.manifest);
    entry.commit();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {  // a full disk, a folder that cannot be written
  }
  make_room(folder_, most_bytes_);
}

}  // namespace vitrail
