// SPDX-License-Identifier: Apache-2.0
#include "cli/year/year_inputs.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "bundle/checksum.h"
#include "compare/web_page.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

template <class T>
std::string hash_of(const std::vector<T>& values) {
  Hasher hasher;
  hasher.add(std::as_bytes(std::span(values)));
  return fmt::format("{:016x}", hasher.digest());
}

}  // namespace

void require_same_inputs(const YearArguments& a, const std::vector<Vector3d>& suns,
                         const std::vector<Sensor>& sensors) {
  const nlohmann::json now = {{"weather", a.weather.string()},
                              {"suns", hash_of(suns)},
                              {"sensors file", a.sensors.string()},
                              {"sensors", hash_of(sensors)},
                              {"patches", a.division}};
  const std::filesystem::path file = a.output / "inputs.json";
  std::ifstream in(file);
  const nlohmann::json then = in ? nlohmann::json::parse(in, nullptr, false) : nlohmann::json();
  const auto refuse = [&](const std::string& what) {
    throw Error(
        fmt::format("this folder holds a year {}; give another --output, or --force to trace anew", what),
        {a.output.string()});
  };
  const auto differs = [&](const char* key) { return then.contains(key) && then[key] != now[key]; };
  if (then.is_object() && !a.force) {
    if (differs("suns"))
      refuse(fmt::format("of other hours of sun: its weather was {}, and now it is {}",
                         then.value("weather", "another"), a.weather.string()));
    if (differs("sensors"))
      refuse(fmt::format("of other sensors: they were those of {}, and now of {}",
                         then.value("sensors file", "another"), a.sensors.string()));
    if (differs("patches"))
      refuse(fmt::format("of another sky: it was --patches {}, and now it is {}", then["patches"].dump(),
                         a.division));
  }
  write_whole(file, now.dump(2) + "\n");
}

}  // namespace vitrail
