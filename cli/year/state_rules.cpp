// SPDX-License-Identifier: Apache-2.0
#include "cli/year/state_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"

namespace vitrail {

namespace {

using RuleQuantity = RuleTerm::Quantity;
using Comparison = RuleTerm::Comparison;

constexpr std::pair<std::string_view, RuleQuantity> quantities[] = {
    {"sensor", RuleQuantity::sensor},       {"global", RuleQuantity::global},
    {"diffuse", RuleQuantity::diffuse},     {"direct", RuleQuantity::direct},
    {"elevation", RuleQuantity::elevation}, {"azimuth", RuleQuantity::azimuth},
    {"month", RuleQuantity::month},         {"hour", RuleQuantity::hour}};
constexpr std::pair<std::string_view, Comparison> comparisons[] = {{"<", Comparison::less},
                                                                   {"<=", Comparison::less_or_equal},
                                                                   {">", Comparison::greater},
                                                                   {">=", Comparison::greater_or_equal}};

class RuleReader {
 public:
  RuleReader(const std::filesystem::path& file, const std::vector<std::string>& states, std::size_t sensors)
      : file_(file), states_(states), sensors_(sensors) {}

  StateRules read() const {
    std::ifstream in = open_input(file_);
    if (!in) throw Error("cannot read the rules", {file_.string()});
    const auto json = nlohmann::json::parse(in, nullptr, false);
    if (!json.is_object() || !json.contains("rules") || !json["rules"].is_array())
      fail("expected {\"rules\": [{\"when\": \"sensor 21 > 2000 lx\", \"state\": \"dark\"}]}", "");
    for (const auto& [key, value] : json.items())
      if (key != "rules" && key != "otherwise")
        fail("there is no such word; there are rules and otherwise", key);
    StateRules rules;
    if (json.contains("otherwise")) rules.otherwise = state(json["otherwise"]);
    for (const auto& rule : json["rules"]) {
      if (!rule.is_object() || !rule.contains("when") || !rule["when"].is_string() ||
          !rule.contains("state") || rule.size() != 2)
        fail("a rule has \"when\" and \"state\"", rule.dump());
      rules.rules.push_back({terms(rule["when"].get<std::string>()), state(rule["state"])});
    }
    return rules;
  }

 private:
  [[noreturn]] void fail(const std::string& what, const std::string& excerpt) const {
    throw Error(what, {file_.string()}, excerpt.substr(0, 200));
  }
  std::size_t state(const nlohmann::json& name) const {
    const auto found = name.is_string() ? std::ranges::find(states_, name.get<std::string>()) : states_.end();
    if (found == states_.end())
      fail(fmt::format("there is no such state; --state gives {}", fmt::join(states_, ", ")), name.dump());
    return static_cast<std::size_t>(found - states_.begin());
  }
  double number(const std::string& word, const std::string& when) const {
    double value = 0;
    const char* const end = word.data() + word.size();
    const auto [at, failed] = std::from_chars(word.data(), end, value);
    if (failed != std::errc() || at != end || !std::isfinite(value))
      fail(fmt::format("expected a number, found \"{}\"", word), when);
    return value;
  }
  std::vector<RuleTerm> terms(const std::string& when) const {
    std::istringstream stream(when);
    std::vector<std::string> words;
    for (std::string word; stream >> word;) words.push_back(word);
    std::vector<RuleTerm> result;
    for (std::size_t at = 0; at < words.size();) {
      if (!result.empty() && words[at++] != "and") fail("terms are joined by \"and\"", when);
      result.push_back(term(words, at, when));
    }
    if (result.empty()) fail("a rule says when it holds, as in \"global > 20000 lx\"", when);
    return result;
  }
  RuleTerm term(const std::vector<std::string>& words, std::size_t& at, const std::string& when) const {
    const auto next = [&]() -> const std::string& {
      if (at >= words.size()) fail("the rule ends too early; it is like \"sensor 21 > 2000 lx\"", when);
      return words[at++];
    };
    RuleTerm term;
    const auto* const quantity =
        std::ranges::find(quantities, next(), &std::pair<std::string_view, RuleQuantity>::first);
    if (quantity == std::end(quantities))
      fail("there are sensor N, global, diffuse, direct, elevation, azimuth, month and hour", when);
    term.quantity = quantity->second;
    if (term.quantity == RuleQuantity::sensor) {
      const double n = number(next(), when);
      if (!(n >= 1 && n <= static_cast<double>(sensors_)) || n != std::floor(n))
        fail(fmt::format("sensors are numbered from 1 to {}", sensors_), when);
      term.sensor = static_cast<std::size_t>(n) - 1;
    }
    const auto* const comparison =
        std::ranges::find(comparisons, next(), &std::pair<std::string_view, Comparison>::first);
    if (comparison == std::end(comparisons)) fail("there are <, <=, > and >=", when);
    term.comparison = comparison->second;
    term.value = number(next(), when);
    if (at < words.size() && (words[at] == "lx" || words[at] == "degrees")) ++at;
    return term;
  }

  const std::filesystem::path& file_;
  const std::vector<std::string>& states_;
  std::size_t sensors_;
};

double value_of(const RuleTerm& term, const YearHour& hour, double lux) {
  switch (term.quantity) {
    case RuleQuantity::sensor:
      return lux;
    case RuleQuantity::global:
      return hour.global_lx;
    case RuleQuantity::diffuse:
      return hour.diffuse_lx;
    case RuleQuantity::direct:
      return hour.direct_normal_lx;
    case RuleQuantity::elevation:
      return hour.elevation_deg;
    case RuleQuantity::azimuth:
      return hour.azimuth_deg;
    case RuleQuantity::month:
      return hour.middle.month;
    case RuleQuantity::hour:
      return hour.clock_hour();
  }
  return 0;
}

bool compare(double value, Comparison comparison, double with) {
  switch (comparison) {
    case Comparison::less:
      return value < with;
    case Comparison::less_or_equal:
      return value <= with;
    case Comparison::greater:
      return value > with;
    case Comparison::greater_or_equal:
      return value >= with;
  }
  return false;
}

}  // namespace

StateRules read_state_rules(const std::filesystem::path& file, const std::vector<std::string>& states,
                            std::size_t sensors) {
  return RuleReader(file, states, sensors).read();
}

std::vector<std::size_t> sensors_of(const StateRules& rules) {
  std::vector<std::size_t> sensors;
  for (const StateRule& rule : rules.rules)
    for (const RuleTerm& term : rule.terms)
      if (term.quantity == RuleQuantity::sensor) sensors.push_back(term.sensor);
  std::ranges::sort(sensors);
  sensors.erase(std::unique(sensors.begin(), sensors.end()), sensors.end());
  return sensors;
}

std::vector<std::size_t> states_of(const StateRules& rules, const SkyYear& year,
                                   const std::function<double(std::size_t, std::size_t)>& lux) {
  std::vector<std::size_t> states;
  for (std::size_t h = 0; h < year.hours.size(); ++h) {
    const auto holds = [&](const StateRule& rule) {
      return std::ranges::all_of(rule.terms, [&](const RuleTerm& term) {
        const double of_sensor = term.quantity == RuleQuantity::sensor ? lux(term.sensor, h) : 0;
        return compare(value_of(term, year.hours[h], of_sensor), term.comparison, term.value);
      });
    };
    const auto rule = std::ranges::find_if(rules.rules, holds);
    states.push_back(rule == rules.rules.end() ? rules.otherwise : rule->state);
  }
  return states;
}

}  // namespace vitrail
