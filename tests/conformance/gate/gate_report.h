// SPDX-License-Identifier: Apache-2.0
// Counts what passes and fails, and says so a line a scene.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

namespace vitrail::test {

class GateReport {
 public:
  explicit GateReport(std::string what) : what_(std::move(what)) {}
  ~GateReport() { fmt::print("{}: {} checked, {} failed\n", what_, checked_, failed_); }
  GateReport(const GateReport&) = delete;
  GateReport& operator=(const GateReport&) = delete;

  // `wrong` is "" where nothing is.
  void check(const std::string& name, const std::string& wrong) {
    ++checked_;
    if (wrong.empty()) return;
    ++failed_;
    ADD_FAILURE() << what_ << ": " << name << "\n    " << wrong;
  }

 private:
  std::string what_;
  int checked_ = 0, failed_ = 0;
};

}  // namespace vitrail::test
