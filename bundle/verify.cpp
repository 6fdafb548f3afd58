// SPDX-License-Identifier: Apache-2.0
#include "bundle/verify.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <deque>
#include <map>
#include <set>
#include <span>
#include <thread>

#include "bundle/checksum.h"
#include "bundle/expected_files.h"
#include "bundle/held_ids.h"
#include "bundle/kept_glazing.h"
#include "bundle/manifest.h"
#include "bundle/matte_names.h"
#include "bundle/origin_file.h"
#include "bundle/packs.h"
#include "bundle/texture_file.h"
#include "scene/system/diagnostics.h"
#include "scene/system/machine_limits.h"

namespace vitrail {

namespace fs = std::filesystem;

namespace {

class Verifier {
 public:
  Verifier(const fs::path& bundle, const VerifyOptions& options) : bundle_(bundle), options_(options) {
    if (!fs::is_directory(bundle))
      throw Error(fs::exists(bundle)
                      ? "this is a file, and a bundle a folder of files; vitrail inspect reads "
                        "a film, or one file of a bundle"
                      : "there is no such bundle",
                  {bundle.string()});
    for (const auto& entry : fs::recursive_directory_iterator(bundle)) {
      present_.insert(entry.path());
      if (entry.is_regular_file()) bytes_to_read_ += entry.file_size();
    }
  }

  VerifyResult run() {
    const auto start = std::chrono::steady_clock::now();
    read_records();
    read_glazing();
    read_names_of_shapes();
    if (manifest_) {
      plan_domains();
      plan_objects();
      for (const TextureFileEntry& t : manifest_->texture_files) plan_texture(bundle_ / t.name, &t);
    } else {
      plan_without_manifest();
    }
    work();
    for (const HeldIds& ids : held_)
      for (const std::string& what : ids.problems()) note(bundle_ / ids.name(), what);
    if (manifest_ && held_.front().complete()) result_.census = held_.front().census();
    expected_.insert(bundle_ / bundle_origin_file);
    for (const fs::path& file : present_)
      if (!expected_.contains(file))
        result_.warnings.push_back({relative(file), "it does not belong to the bundle"});
    std::ranges::sort(result_.problems);
    std::ranges::sort(result_.warnings);
    result_.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return std::move(result_);
  }

 private:
  std::string relative(const fs::path& file) const { return file.lexically_relative(bundle_).string(); }

  void note(const fs::path& file, const std::string& what) {
    const std::lock_guard lock(mutex_);
    result_.problems.push_back({relative(file), what});
  }

  bool attempt(const fs::path& file, const std::function<void()>& check) {
    try {
      check();
      return true;
    } catch (const std::exception& e) {
      note(file, e.what());
    }
    return false;
  }

  // The same, and counts the file.
  bool read(const Stored& stored, const std::function<void()>& check) {
    std::error_code missing;
    const fs::path file = stored.name();
    const std::uint64_t all = fs::file_size(stored.file, missing);
    const std::uint64_t bytes = stored.bytes.value_or(all);
    if (missing) note(file, "it cannot be read: " + missing.message());
    const bool good = !missing && attempt(file, check);
    const std::lock_guard lock(mutex_);
    if (missing) return false;
    if (stored.offset == 0) ++result_.files;
    result_.bytes += bytes;
    if (options_.progress)
      options_.progress(static_cast<double>(result_.bytes) / static_cast<double>(bytes_to_read_));
    return good;
  }

  void expect(const fs::path& file) {
    for (fs::path at = file; at != bundle_; at = at.parent_path()) expected_.insert(at);
  }

  void read_records() {
    std::vector<fs::path> files{bundle_ / "manifest.json"};
    for (const char* name : records_file_names) files.push_back(bundle_ / name);
    fs::path blamed = files[0];
    try {
      manifest_ = read_manifest(bundle_);
    } catch (const Error& e) {
      blamed = e.location.file;
      note(blamed, e.what());
    } catch (const std::exception& e) {
      note(blamed, e.what());
    }
    for (const fs::path& file : files) {
      expect(file);
      read({file}, [&] {
        if (!manifest_ && file != blamed && file != files[0]) check_records_file(file);
      });
    }
  }

  // Glass that can be set; without a manifest it is not known whether there is to be some.
  void read_glazing() {
    const fs::path file = glazing_path(bundle_);
    if (!present_.contains(file) && !(manifest_ && manifest_->switching_glazings > 0)) return;
    expect(file);
    read({file}, [&] {
      if (manifest_) read_glazings(bundle_, *manifest_);
    });
  }

  void read_names_of_shapes() {
    const fs::path file = shape_names_path(bundle_);
    if (!present_.contains(file) && !(manifest_ && tells_shapes(manifest_->film.layers))) return;
    expect(file);
    read({file}, [&] {
      if (manifest_) read_shape_names(bundle_, *manifest_);
    });
  }

  void plan(HeldIds& ids, const Stored& stored, const std::function<void(const MappedDomain&)>& check) {
    expect(stored.file);
    const std::uint32_t part = ids.add_part();
    jobs_.push_back([this, &ids, stored, part, check] {
      read(stored, [&] {
        const MappedDomain mapped(stored);
        const fs::path file = stored.name();
        const bool fits = attempt(file, [&] { check(mapped); });
        if (attempt(file, [&] { mapped.check_cold(), mapped.pieces(); }) && fits) ids.count(part, mapped);
      });
    });
  }

  // Files that are damaged are found later.
  std::vector<HeldInstance> instances_in(const Stored& stored) const try {
    std::vector<HeldInstance> held;
    for (const InstanceRef& ref : read_instances(stored)) {
      Hasher hasher;
      hasher.add(std::as_bytes(std::span(ref.to_parent.m)));
      held.push_back({hasher.digest(), ref.first_triangle, ref.object});
    }
    return held;
  } catch (const std::exception&) {
    return {};
  }

  void plan_domains() {
    const Manifest& m = *manifest_;
    std::vector<HeldInstance> instances;
    for (std::uint32_t i = 0; i < m.domains.size(); ++i)
      if (m.domains[i].instances > 0)
        std::ranges::copy(instances_in(stored_domain(m, bundle_, i)), std::back_inserter(instances));
    HeldIds& ids = held_.emplace_back("domains", m, m.triangles, m.cut_triangles, std::move(instances));
    std::map<fs::path, std::vector<Stored>> packs;
    for (std::uint32_t i = 0; i < m.domains.size(); ++i) {
      const Stored stored = stored_domain(m, bundle_, i);
      plan(ids, stored, [&m, i, file = stored.name()](const MappedDomain& mapped) {
        check_domain(m, i, mapped, file);
        check_counts(m, i, mapped, file);
      });
      if (stored.bytes) packs[stored.file].push_back(stored);
    }
    for (const auto& [file, domains] : packs)
      jobs_.push_back(
          [this, file = file, domains = domains] { attempt(file, [&] { check_pack(file, domains); }); });
  }

  void plan_objects() {
    const Manifest& m = *manifest_;
    for (std::uint32_t i = 0; i < m.objects.size();) {
      if (m.objects[i].quadric) {
        ++i;
        continue;
      }
      const std::uint32_t end = end_of_prototype(m, i);
      std::vector<HeldInstance> instances;
      for (std::uint32_t part = i; part < end; ++part)
        std::ranges::copy(instances_in({object_path(bundle_, part)}), std::back_inserter(instances));
      HeldIds& ids = held_.emplace_back(relative(object_path(bundle_, i)), m, m.objects[i].triangles, 0,
                                        std::move(instances));
      for (; i < end; ++i) {
        const fs::path file = object_path(bundle_, i);
        plan(ids, {file}, [&m, i, file](const MappedDomain& mapped) { check_object(m, i, mapped, file); });
      }
    }
  }

  void plan_texture(const fs::path& file, const TextureFileEntry* entry = nullptr) {
    expect(file);
    jobs_.push_back([this, file, entry] {
      read({file}, [&] {
        const TextureFile texture(file);
        if (entry) attempt(file, [&] { check_texture(*entry, texture, file); });
        texture.check_tiles();
      });
    });
  }

  void plan_without_manifest() {
    HeldIds& nothing = held_.emplace_back();
    for (const fs::path& file : expected_files(bundle_, present_))
      if (file.extension() == ".dom")
        plan(nothing, {file}, [](const MappedDomain&) {});
      else
        plan_texture(file);
    for (const fs::path& file : present_)
      if (is_pack(file))
        for (const Stored& stored : domains_of_pack(file)) plan(nothing, stored, [](const MappedDomain&) {});
  }

  void work() {
    std::atomic<std::size_t> next{0};
    const auto worker = [&] {
      for (std::size_t i = next++; i < jobs_.size(); i = next++) jobs_[i]();
    };
    const auto threads = static_cast<std::size_t>(threads_for(options_.threads));
    std::vector<std::jthread> others;
    while (others.size() + 1 < std::min(threads, jobs_.size())) others.emplace_back(worker);
    worker();
  }

  fs::path bundle_;
  const VerifyOptions& options_;
  std::set<fs::path> present_, expected_;
  std::uint64_t bytes_to_read_ = 0;
  std::optional<Manifest> manifest_;
  std::deque<HeldIds> held_;  // of the domains first
  std::vector<std::function<void()>> jobs_;
  std::mutex mutex_;
  VerifyResult result_;
};

}  // namespace

VerifyResult verify_bundle(const fs::path& bundle, const VerifyOptions& options) {
  return Verifier(bundle.has_filename() ? bundle : bundle.parent_path(), options).run();
}

}  // namespace vitrail
