// SPDX-License-Identifier: Apache-2.0
// Whether a parameter's type and values are what pbrt-v4 takes.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tests/conformance/gate/pbrt_tokens.h"

namespace vitrail::test::pbrt {

// The number that a token is to pbrt; nothing where it is none.
std::optional<double> number_of(const Token& token);

// What is wrong with `parameter`, of which pbrt_table.h says `type`; "" where nothing is.
std::string wrong_value(const Parameter& parameter, std::string_view type);

// The type that the table gives `name` in `parameters`, "" where it is not there.
std::string_view type_of(std::string_view parameters, std::string_view name);

}  // namespace vitrail::test::pbrt
