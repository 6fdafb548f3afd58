// SPDX-License-Identifier: Apache-2.0
#include "importers/povray/read/extents.h"
#include "importers/povray/read/reader.h"

namespace vitrail::pov {

Numbers ask_object(Reader& reader, const Token& function) {
  reader.fail(std::string(function.symbol->name) + "() is not read", function.place);
}

}  // namespace vitrail::pov
