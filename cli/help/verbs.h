// SPDX-License-Identifier: Apache-2.0
// This file lists the verbs of vitrail, with what each one does and how it is typed.
#pragma once

#include <span>
#include <string_view>
#include <vector>

namespace vitrail {

struct Example {
  std::string_view command;
  std::string_view effect;
};

struct Verb {
  std::string_view name;
  std::string_view summary;  // a phrase without a full stop
  std::vector<Example> examples;
  // Its program has parts of CGAL that are under GPL-3.0-or-later (tests/laws/source/licences_test.cpp).
  bool contains_cgal = false;
};

std::span<const Verb> verbs();

// Returns nullptr where there is no such verb.
const Verb* find_verb(std::string_view name);

// They are for somebody who types `vitrail help` for the first time.
std::span<const Example> first_steps();

}  // namespace vitrail
