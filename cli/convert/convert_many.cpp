// SPDX-License-Identifier: Apache-2.0
#include "cli/convert/convert_many.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <exception>
#include <fstream>
#include <map>
#include <mutex>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "cli/common/input_kind.h"
#include "cli/common/main_guard.h"
#include "cli/common/run_program.h"
#include "cli/convert/check_conversion.h"
#include "cli/convert/peer_check.h"
#include "cli/convert/scene_search.h"
#include "scene/system/diagnostics.h"
#include "scene/system/progress_line.h"
#include "scene/system/say.h"

namespace vitrail {

namespace {

namespace fs = std::filesystem;

struct Conversion {
  fs::path input, output, report;
};

using Json = nlohmann::ordered_json;

// Of a conversion that is at its end, of the scene's file as it is now.
std::optional<Json> report_of(const Conversion& c, const ManyConversions& many) {
  std::error_code missing;
  const auto written = fs::last_write_time(c.report, missing);
  if (missing || !fs::exists(c.output) || written <= fs::last_write_time(c.input)) return {};
  Json report = Json::parse(std::ifstream(c.report));
  if (report.at("options") != Json(many.options)) return {};
  if (!many.check.empty() && !report.contains(many.check == "peer" ? "peer" : "pictures")) return {};
  return report;
}

bool looks_different(const Json& report) {
  return std::ranges::any_of(std::array{"pictures", "peer"}, [&](const char* check) {
    return report.contains(check) && !report.at(check).value("passed", true);
  });
}

std::string in_words(const Json& report) {
  std::string words =
      fmt::format("{} items exact, {} approximated, {} dropped", report.at("exact").get<int>(),
                  report.at("approximated").get<int>(), report.at("dropped").get<int>());
  if (report.contains("pictures")) words += "; " + pictures_in_words(report.at("pictures"));
  if (report.contains("peer")) words += "; " + peer_in_words(report.at("peer"), "; ");
  return words;
}

// What became of the scenes so far.
class Outcomes {
 public:
  Outcomes(std::size_t scenes, bool quiet) : line_(progress_manner(quiet)), scenes_(scenes), quiet_(quiet) {}

  void add(const Conversion& c, int status, const std::string& what) {
    const std::lock_guard lock(mutex_);
    line_.clear();
    if (!quiet_) {
      show("{}: {}\n", (status <= exit_differs ? c.output : c.input).string(), what);
      std::fflush(stdout);  // what is done is said now, also to a file
    }
    ++counts_[status];
    const std::size_t done = ++done_;
    if (done < scenes_) line_.show(static_cast<double>(done) / static_cast<double>(scenes_), "converting");
  }
  // The exit statuses are in the order of their weight.
  int worst() const { return counts_.empty() ? exit_done : counts_.rbegin()->first; }
  std::string summary() const {
    const auto of = [&](int status) { return counts_.contains(status) ? counts_.at(status) : 0; };
    return fmt::format("{} scenes: {} converted, {} that look different, {} refused, {} failed\n", scenes_,
                       of(exit_done), of(exit_differs), of(exit_bad_input), of(exit_machine));
  }

 private:
  std::mutex mutex_;
  ProgressLine line_;
  std::size_t scenes_, done_ = 0;
  bool quiet_;
  std::map<int, int> counts_;
};

void convert(const Conversion& c, const ManyConversions& many, Outcomes& outcomes) {
  std::vector<std::string> words{c.input.string(),
                                 c.output.string(),
                                 "--report",
                                 c.report.string(),
                                 "--quiet",
                                 "--memory",
                                 std::to_string(many.memory_bytes)};
  words.insert(words.end(), many.options.begin(), many.options.end());
  if (!many.check.empty()) words.push_back("--check=" + many.check);
  if (!many.peer.empty()) words.insert(words.end(), {"--peer", many.peer});
  if (!many.input_peer.empty()) words.insert(words.end(), {"--peer-of-input", many.input_peer});
  if (many.strict) words.push_back("--strict");
  try {
    std::optional<Json> report;
    if (!many.again) report = report_of(c, many);
    const char* when = report ? "converted already: " : "";
    if (!report) {
      fs::create_directories(c.output.parent_path());
      fs::remove(c.report);
      run_program("vitrail-convert", words);
      report = Json::parse(std::ifstream(c.report));
    }
    if (many.strict && (report->at("approximated") != 0 || report->at("dropped") != 0))
      return outcomes.add(c, exit_bad_input, "refused: " + in_words(*report));
    outcomes.add(c, looks_different(*report) ? exit_differs : exit_done, when + in_words(*report));
  } catch (const Error&) {
    outcomes.add(c, exit_bad_input, "refused");
  } catch (const UsageError&) {  // options that are not of its format
    outcomes.add(c, exit_bad_input, "refused");
  } catch (const MachineError& e) {
    outcomes.add(c, exit_machine, e.what());
  }
}

}  // namespace

int convert_many(const ManyConversions& many) {
  for (const fs::path& input : many.inputs)
    if (kind_of_input(input) == InputKind::bundle) require_input(input, {InputKind::scene});
  const std::vector<FoundScene> scenes = find_scenes(many.inputs, many.folder);
  if (scenes.empty()) throw UsageError("there is no scene to convert");
  const std::vector<fs::path> names = converted_names(scenes, many.format);
  Outcomes outcomes(scenes.size(), many.quiet);
  std::atomic<std::size_t> next = 0;
  std::exception_ptr ended;
  std::mutex mutex;
  const auto work = [&] {
    try {
      for (std::size_t i; (i = next++) < scenes.size();) {
        const fs::path output = many.folder / names[i];
        convert({scenes[i].input, output, fs::path(output).replace_extension("report.json")}, many, outcomes);
      }
    } catch (...) {  // interrupted: nobody begins another one
      next = scenes.size();
      const std::lock_guard lock(mutex);
      if (!ended) ended = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> threads;
    for (int t = 1; t < many.at_once; ++t) threads.emplace_back(work);
    work();
  }
  if (ended) std::rethrow_exception(ended);
  if (!many.quiet) show("{}", outcomes.summary());
  return outcomes.worst();
}

}  // namespace vitrail
