// SPDX-License-Identifier: Apache-2.0
#include "cli/common/number_checks.h"

#include <CLI/CLI.hpp>

namespace vitrail {

std::string more_than_0(const std::string& text) {
  double number = 0;
  return CLI::detail::lexical_cast(text, number) && number > 0 ? "" : "has to be more than 0, not " + text;
}

std::string not_below_0(const std::string& text) {
  double number = 0;
  return CLI::detail::lexical_cast(text, number) && number >= 0 ? "" : "must not be negative: " + text;
}

}  // namespace vitrail
