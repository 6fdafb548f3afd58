// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "importers/bytes/text_cursor.h"
#include "importers/obj/read/mtl.h"
#include "importers/reading/named_file.h"

namespace vitrail::obj {

// Reads the options and the name that follow a keyword such as map_Kd. The name is sought in `folder`.
// `drop(message)` reports.
using Drop = std::function<void(std::string)>;
MtlMap read_map(TextCursor& cursor, const std::string& keyword, const std::filesystem::path& folder,
                const Drop& drop);

}  // namespace vitrail::obj
