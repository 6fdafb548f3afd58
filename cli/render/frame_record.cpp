// SPDX-License-Identifier: Apache-2.0
#include "cli/render/frame_record.h"

#include <fmt/format.h>

#include <chrono>
#include <fstream>
#include <memory>
#include <span>
#include <vector>

#include "bundle/checksum.h"
#include "farm/files/output_lock.h"
#include "scene/system/atomic_file.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* format = "vitrail frames";

// Without the names of masks, which may be many and are the scene's.
Json to_json(const WorkWords& work) {
  Json about = Json::parse(work.about);
  about.erase("mattes");
  Json fields = Json::object();
  for (const auto& [name, value] : work.fields) fields[name] = value;
  return {{"scene_hash", fmt::format("{:016x}", work.scene_hash)}, {"about", about}, {"fields", fields}};
}

WorkWords from_json(const Json& json) {
  WorkWords work{
      std::stoull(json.at("scene_hash").get<std::string>(), nullptr, 16), json.at("about").dump(), {}};
  for (const auto& [name, value] : json.at("fields").items())
    work.fields.emplace_back(name, value.get<std::string>());
  return work;
}

std::optional<FileMark> mark_from_json(const Json& json) {
  const auto found = json.find("file");
  if (found == json.end()) return std::nullopt;
  return FileMark{found->at("bytes").get<std::uint64_t>(),
                  std::stoull(found->at("hash").get<std::string>(), nullptr, 16)};
}

std::string key_of(const std::filesystem::path& picture) { return picture.filename().string(); }

}  // namespace

FileMark mark_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::vector<char> part(1 << 20);
  FileMark mark;
  Hasher hasher;
  while (in.read(part.data(), static_cast<std::streamsize>(part.size())) || in.gcount() > 0) {
    const auto bytes = static_cast<std::size_t>(in.gcount());
    hasher.add(std::as_bytes(std::span(part.data(), bytes)));
    mark.bytes += bytes;
  }
  if (!in.eof()) throw MachineError("cannot read " + file.string());
  mark.hash = hasher.digest();
  return mark;
}

FrameRecord::FrameRecord(std::filesystem::path file) : file_(std::move(file)) { read_again(); }

void FrameRecord::read_again() {
  std::ifstream in(file_);
  if (!in) return;
  try {
    const Json json = Json::parse(in);
    if (json.at("format") != format) throw std::invalid_argument("another format");
    pictures_ = json.at("pictures");
    for (const auto& [name, work] : pictures_.items()) from_json(work), mark_from_json(work);
  } catch (const std::exception&) {
    throw Error("this is not a record of frames; remove it, or give another --output", {file_.string()});
  }
}

std::string FrameRecord::differences(const std::filesystem::path& picture, const WorkWords& asked) const {
  const auto found = pictures_.find(key_of(picture));
  if (found == pictures_.end()) return fmt::format("{} does not know it", file_.string());
  return vitrail::differences(from_json(*found), asked);
}

std::optional<FileMark> FrameRecord::mark(const std::filesystem::path& picture) const {
  const auto found = pictures_.find(key_of(picture));
  return found == pictures_.end() ? std::nullopt : mark_from_json(*found);
}

void FrameRecord::put(const std::filesystem::path& picture, const WorkWords& work, const FileMark& mark) {
  Json json = to_json(work);
  json["file"] = {{"bytes", mark.bytes}, {"hash", fmt::format("{:016x}", mark.hash)}};
  change([&](Json& pictures) {
    Json& kept = pictures[key_of(picture)];
    const bool is_new = kept != json;
    kept = std::move(json);
    return is_new;
  });
}

void FrameRecord::remove(const std::filesystem::path& picture) {
  change([&](Json& pictures) { return pictures.erase(key_of(picture)) > 0; });
}

void FrameRecord::change(const std::function<bool(Json& pictures)>& changed) {
  // Others hold it for as long as it takes to write the file.
  const std::unique_ptr<OutputLock> alone = wait_for_lock(file_, std::chrono::minutes(1));
  remove_temporaries(file_);
  read_again();
  if (changed(pictures_)) write();
}

void FrameRecord::write() const {
  const std::string text =
      Json{{"format", format}, {"pictures", pictures_}}.dump(1, ' ', false, Json::error_handler_t::replace) +
      "\n";
  AtomicFile file(file_);
  file.write(std::as_bytes(std::span(text)));
  file.commit();
}

}  // namespace vitrail
