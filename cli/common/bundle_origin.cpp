// SPDX-License-Identifier: Apache-2.0
#include "cli/common/bundle_origin.h"

#include <sys/stat.h>

#include <ctime>
#include <nlohmann/json.hpp>

#include "bundle/origin_file.h"
#include "scene/system/atomic_file.h"
#include "scene/system/input_files.h"

namespace vitrail {

using Json = nlohmann::ordered_json;

void write_bundle_origin(const std::filesystem::path& bundle, const BundleOrigin& origin) {
  const Json json{
      {"scene", origin.scene}, {"program", "vitrail " VITRAIL_VERSION}, {"options", origin.options}};
  const std::string text = json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
  AtomicFile file(bundle / bundle_origin_file);
  file.write(std::as_bytes(std::span(text)));
  file.commit();
}

BundleOrigin read_bundle_origin(const std::filesystem::path& bundle) {
  std::ifstream in = open_regular(bundle / bundle_origin_file);
  const Json json = Json::parse(in, nullptr, false);
  const auto text = [&](const char* key) {
    return json.is_object() && json.contains(key) && json[key].is_string() ? json[key].get<std::string>()
                                                                           : "";
  };
  return {text("scene"), text("program"), text("options")};
}

std::string time_of(const std::filesystem::path& file) {
  struct stat status = {};
  if (::stat(file.c_str(), &status) != 0) return {};
  std::tm utc{};
  ::gmtime_r(&status.st_mtime, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%d %H:%M:%S UTC", &utc);
  return text;
}

}  // namespace vitrail
