// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "glazing/standard.h"
#include "glazing/text_file.h"
#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

namespace fs = std::filesystem;

// "Key : value", the key in lower case.
std::pair<std::string, std::string> key_and_value(std::string_view line) {
  const std::size_t colon = line.find(':');
  if (colon == line.npos) return {};
  return {lower(trimmed(line.substr(0, colon))), std::string(trimmed(line.substr(colon + 1)))};
}

// A file of weights (.ssp, .dsp) or of wavelengths (.wvl): "Key: value" lines, then rows of one or two
// numbers.
WeightTable read_weights(const fs::path& file) {
  const std::string text = read_text(file), name = file.string();
  WeightTable table;
  double to_nm = 0;
  Lines lines(text);
  for (std::string_view line; lines.next(line);) {
    line = trimmed(line);
    std::string_view rest = line;
    double nm = 0, value = 1;
    const std::string_view first = next_word(rest);
    if (first.empty()) continue;
    if (!parse_number(first, nm)) {
      if (!table.empty())
        throw Error("expected a wavelength", {name, lines.number(), 0}, std::string(line.substr(0, 80)));
      const auto [key, unit] = key_and_value(line);
      if (key != "wavelength units") continue;
      to_nm = nanometres_in(unit);
      if (to_nm == 0)
        throw Error(fmt::format("knows no unit of wavelength \"{}\": Nanometers and Microns", unit),
                    {name, lines.number(), 0});
      continue;
    }
    const std::string_view second = next_word(rest);
    if (!second.empty() && !parse_number(second, value))
      throw Error("expected a number", {name, lines.number(), 0}, std::string(line.substr(0, 80)));
    if (to_nm == 0)
      throw Error("has no line \"Wavelength Units: …\" above its rows", {name, lines.number(), 0});
    table.emplace_back(nm * to_nm, value);
  }
  if (table.empty()) throw Error("there are no weights in it", {name});
  std::ranges::stable_sort(table, {}, &std::pair<double, double>::first);
  return table;
}

// Numbers in brackets behind a word: "UV Action (a=3.6, b=12.0)".
std::vector<double> arguments(const std::string& text) {
  std::vector<double> result;
  for (std::size_t at = 0; (at = text.find('=', at)) != text.npos;) {
    const std::size_t end = std::min(text.find_first_of(",)K", ++at), text.size());
    if (double value = 0; parse_number(trimmed(std::string_view(text).substr(at, end - at)), value))
      result.push_back(value);
  }
  return result;
}

class StandardReader {
 public:
  explicit StandardReader(const fs::path& file) : file_(file), text_(read_text(file)) {}

  Standard read() {
    Lines lines(text_);
    for (std::string_view line; lines.next(line);) {
      const auto [key, value] = key_and_value(line);
      line_ = lines.number();
      if (key == "standard description") standard_.description = value;
      if (key == "name") begin(value);
      if (standard_.methods.empty() || skipped_) continue;
      take(key, value);
    }
    if (standard_.methods.empty())
      throw Error("there are no methods (\"Name : SOLAR\" …) in it", {file_.string()});
    for (Method& method : standard_.methods) finish(method);
    return std::move(standard_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw Error(message, {file_.string(), line_, 0});
  }

  // What is known of a method that its weights may be needed for, when all of it is read.
  struct Ends {
    std::string set = "source", min, max;
  };

  void begin(const std::string& name) {
    skipped_ = lower(name).starts_with("thermal");
    if (skipped_) return;
    standard_.methods.push_back({.name = name});
    ends_.emplace_back();
  }

  void take(const std::string& key, const std::string& value) {
    Method& method = standard_.methods.back();
    if (key == "source spectrum") method.source = read_weights(file_.parent_path() / value);
    if (key == "detector spectrum") take_detector(method, value);
    if (key == "wavelength set") ends_.back().set = value;
    if (key == "minimum wavelength") ends_.back().min = value;
    if (key == "maximum wavelength") ends_.back().max = value;
    if (key == "integration rule") method.rule = rule_of(lower(value));
  }

  void take_detector(Method& method, const std::string& value) const {
    const std::string known = lower(value);
    if (known == "none") return;
    if (known.starts_with("uv action")) {
      const auto ab = arguments(value);
      if (ab.size() != 2) fail("\"UV Action\" has two numbers, as in (a=3.6, b=12.0)");
      method.action = {ab[0], ab[1]};
    } else if (known == "krochmann") {
      method.action = {12.28, 25.56};
    } else {
      method.detector = read_weights(file_.parent_path() / value);
    }
  }

  IntegrationRule rule_of(const std::string& rule) const {
    if (rule.starts_with("trapezoidal")) return IntegrationRule::trapezoidal;
    if (rule.starts_with("rectangular")) return IntegrationRule::rectangular;
    if (rule.starts_with("pre-weighted")) return IntegrationRule::pre_weighted;
    fail(fmt::format("knows no integration rule \"{}\"", rule));
  }

  void finish(Method& method) const {
    const Ends& ends = ends_[static_cast<std::size_t>(&method - standard_.methods.data())];
    if (method.source.empty())
      throw Error(fmt::format("{} has no source spectrum", method.name), {file_.string()});
    const std::string set = lower(ends.set);
    if (set == "source")
      for (const auto& [nm, value] : method.source) method.wavelengths_nm.push_back(nm);
    else if (set != "data")
      for (const auto& [nm, value] : read_weights(file_.parent_path() / ends.set))
        method.wavelengths_nm.push_back(nm);
    take_limit(ends.min, method.min_nm);
    take_limit(ends.max, method.max_nm);
  }

  // "Wavelength set" and nothing mean all of the set.
  void take_limit(const std::string& text, double& nm) const {
    if (text.empty() || same_word(text, "wavelength set")) return;
    double um = 0;
    if (!parse_number(text, um))
      throw Error(fmt::format("\"{}\" is no wavelength in µm", text), {file_.string()});
    nm = 1000 * um;
  }

  fs::path file_;
  std::string text_;
  Standard standard_;
  std::vector<Ends> ends_;
  int line_ = 0;
  bool skipped_ = false;
};

}  // namespace

Standard read_standard(const fs::path& file) { return StandardReader(file).read(); }

}  // namespace vitrail
