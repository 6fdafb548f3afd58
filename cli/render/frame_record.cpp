// SPDX-License-Identifier: Apache-2.0
#include "cli/render/frame_record.h"

#include <fmt/format.h>

#include <fstream>

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

std::string key_of(const std::filesystem::path& picture) { return picture.filename().string(); }

}  // namespace

FrameRecord::FrameRecord(std::filesystem::path file) : file_(std::move(file)) {
  std::ifstream in(file_);
  if (!in) return;
  try {
    const Json json = Json::parse(in);
    if (json.at("format") != format) throw std::invalid_argument("another format");
    pictures_ = json.at("pictures");
    for (const auto& [name, work] : pictures_.items()) from_json(work);
  } catch (const std::exception&) {
    throw Error("this is not a record of frames; remove it, or give another --output", {file_.string()});
  }
}

std::string FrameRecord::differences(const std::filesystem::path& picture, const WorkWords& asked) const {
  const auto found = pictures_.find(key_of(picture));
  if (found == pictures_.end()) return fmt::format("{} does not know it", file_.string());
  return vitrail::differences(from_json(*found), asked);
}

void FrameRecord::put(const std::filesystem::path& picture, const WorkWords& work) {
  Json json = to_json(work);
  Json& kept = pictures_[key_of(picture)];
  if (kept == json) return;
  kept = std::move(json);
  write();
}

void FrameRecord::remove(const std::filesystem::path& picture) {
  if (pictures_.erase(key_of(picture)) > 0) write();
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
