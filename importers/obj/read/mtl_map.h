// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "importers/bytes/text_cursor.h"
#include "importers/obj/read/mtl.h"

namespace vitrail::obj {

// Reads the options and the name that follow a keyword such as map_Kd. The name is sought in `folder`;
// nothing is returned where it is not there. `drop(message)` reports.
using Drop = std::function<void(std::string)>;
std::optional<MtlMap> read_map(TextCursor& cursor, const std::string& keyword,
                               const std::filesystem::path& folder, const Drop& drop);

// Of ASCII letters alone.
char lower_case(char letter);

// A file of `folder` by the name that another one says: as it stands, else with the separators of Windows,
// else its last part alone; each also in other letter cases, as on systems that know none. Absolute; "" where
// there is none.
std::string find_named_file(std::string name, const std::filesystem::path& folder);

}  // namespace vitrail::obj
