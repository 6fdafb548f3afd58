// SPDX-License-Identifier: Apache-2.0
// Mitsuba 3 as the judge of what is written for it. Tests are skipped where it is not installed.
#pragma once

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "importers/mitsuba/write/write_mitsuba.h"
#include "tests/importers/temporary_folder.h"
#include "tests/importers/written_scenes.h"
#include "tests/support/paths.h"

namespace vitrail {

using Json = nlohmann::json;

// Starts a process that has imported Mitsuba and lives as long as this one. Returns the command that runs
// scripts in it.
inline std::string start_mitsuba(const std::string& python) {
  const std::string script = test::project_file("tests/support/mitsuba_server.py"),
                    socket = fmt::format("{}/vitrail-mitsuba-{}",
                                         std::filesystem::temp_directory_path().string(), ::getpid());
  // Its standard input ends with this process.
  if (!::popen(fmt::format("exec {} {} --serve '{}'", python, script, socket).c_str(), "we")) return python;
  return fmt::format("{} -ISE {} '{}'", python, script, socket);
}

// Runs scripts by the first of $VITRAIL_MITSUBA_PYTHON, python3 and /usr/bin/python3 that can import mitsuba;
// "" if none can.
inline const std::string& mitsuba_python() {
  static const std::string found = [] {
    const char* chosen = std::getenv("VITRAIL_MITSUBA_PYTHON");
    for (const std::string& python :
         {std::string(chosen ? chosen : ""), std::string("python3"), std::string("/usr/bin/python3")})
      if (!python.empty() && std::system((python + " -c 'import mitsuba' > /dev/null 2>&1").c_str()) == 0)
        return start_mitsuba(python);
    return std::string();
  }();
  return found;
}

class MitsubaOracle : public testing::Test {
 protected:
  void SetUp() override {
    if (mitsuba_python().empty())
      GTEST_SKIP() << "skipped: Mitsuba 3 is not installed (python3 -m pip install mitsuba; "
                      "VITRAIL_MITSUBA_PYTHON names a python that has it)";
  }

  // Mitsuba's answers about the scene, which has to load without errors and warnings.
  Json ask(const Scene& scene, const Json& queries, const std::string& variant = "scalar_spectral") {
    diagnostics_ = write_mitsuba(scene, folder_ / "scene.xml");
    const Json request{
        {"scene", (folder_ / "scene.xml").string()}, {"variant", variant}, {"queries", queries}};
    std::ofstream(folder_ / "request.json") << request;
    const std::string command =
        mitsuba_python() + " " + test::project_file("tests/importers/mitsuba_oracle.py ") +
        (folder_ / "request.json").string() + " " + (folder_ / "answer.json").string();
    if (std::system(command.c_str()) != 0) {
      ADD_FAILURE() << "the oracle failed: " << command;
      return {};
    }
    const Json answer = Json::parse(std::ifstream(folder_ / "answer.json"));
    EXPECT_FALSE(answer.contains("error")) << answer.value("error", "") << "\n" << text();
    for (const std::string warning : answer.at("warnings"))
      EXPECT_TRUE(!allowed_warning_.empty() && warning.find(allowed_warning_) != std::string::npos)
          << warning;
    return answer.value("results", Json::array());
  }

  std::string text() const {
    std::ifstream file(folder_ / "scene.xml");
    return {std::istreambuf_iterator<char>(file), {}};
  }

  TemporaryFolder folder_;
  Diagnostics diagnostics_;
  std::string allowed_warning_;
};

inline const std::array<double, 4> wavelengths_nm{440, 530, 610, 680};

inline Json ray(const char* op, std::array<double, 3> o, std::array<double, 3> d) {
  return {{"op", op}, {"o", o}, {"d", d}, {"wavelengths", wavelengths_nm}};
}

inline std::vector<double> values(const Spectrum& spectrum, double factor = 1) {
  std::vector<double> result;
  for (const double lambda : wavelengths_nm) result.push_back(evaluate(resolved(spectrum), lambda) * factor);
  return result;
}

// Each within `relative` of the expected, or 1e-6.
inline void expect_near(const Json& found, const std::vector<double>& expected, double relative,
                        const std::string& what = "") {
  ASSERT_EQ(found.size(), expected.size()) << what;
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_NEAR(found[i].get<double>(), expected[i], relative * std::abs(expected[i]) + 1e-6)
        << what << " [" << i << "]";
}

}  // namespace vitrail
