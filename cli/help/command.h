// SPDX-License-Identifier: Apache-2.0
// A Command is a command line as data: help, man pages and completions are written from it.
#pragma once

#include <string>
#include <vector>

#include "cli/help/verbs.h"

namespace vitrail {

struct CommandOption {
  std::vector<std::string> names;    // with their dashes; of an argument its one name
  std::string value;                 // what stands for its value, e.g. FILE; empty: it takes none
  std::vector<std::string> choices;  // all that the value may be; empty: anything
  std::string initial;               // the value where none is given; empty: the text says it
  std::string text;                  // a phrase without a full stop
  bool is_argument = false;          // has no dashes
  bool takes_file = false;
  bool may_repeat = false;  // and all values count; of others the last

  std::string joined_names() const;  // "-o, --output FILE"
  std::string full_text() const;     // with the initial value
};

struct CommandGroup {
  std::string heading;
  std::vector<CommandOption> options;
};

struct Command {
  std::string name;  // "vitrail render"
  std::string summary;
  std::vector<CommandGroup> groups;  // none is empty
  std::vector<Example> examples;
  // These are again the options that nearly everyone needs. They are empty where all are few.
  std::vector<CommandOption> everyday{};

  std::string usage() const;    // "vitrail render [OPTION]... INPUT"
  std::string program() const;  // "vitrail-render"
  std::string verb() const;     // "render"; empty of the front program
  std::vector<CommandOption> all() const;
};

}  // namespace vitrail
