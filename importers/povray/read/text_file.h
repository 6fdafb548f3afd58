// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>

#include "importers/povray/read/value.h"

namespace vitrail::pov {

// It is a file of #fopen. One that is read holds numbers, vectors and quoted texts between commas.
struct OpenFile {
  std::string name, content;
  std::size_t at = 0;
  bool writes = false;

  // Returns nothing where the file ends or something else stands there.
  Value next();
  bool at_end();

 private:
  void skip_blanks();
  bool number(double& value);
};

}  // namespace vitrail::pov
