// SPDX-License-Identifier: Apache-2.0
// A shell offers these when TAB is typed after `vitrail …`: verbs, options, choices of an option, files.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "cli/help/command.h"

namespace vitrail {

inline constexpr std::array<std::string_view, 3> completed_shells{"bash", "zsh", "fish"};

// A shell's file is completion_head, completion_of each verb, completion_tail.
std::string completion_head(std::string_view shell);
std::string completion_of(std::string_view shell, const Command& command);
std::string completion_tail(std::string_view shell);

}  // namespace vitrail
