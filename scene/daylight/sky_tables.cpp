// SPDX-License-Identifier: Apache-2.0
#include "scene/daylight/sky_tables.h"

#include "scene/daylight/sky_tables_text.h"
#include "scene/system/number_tables.h"

namespace vitrail {

const SkyTables& sky_tables() {
  static const SkyTables data = [] {
    const auto tables = number_tables<float>(sky_tables_text, "scene/daylight/sky_tables.txt");
    SkyTables read;
    fill_from(tables, "shape", SkyTables::shapes, read.shape);
    fill_from(tables, "radiance", SkyTables::bands, read.radiance);
    fill_from(tables, "sun", SkyTables::sun_powers, read.sun);
    fill_from(tables, "limb", SkyTables::limb_powers, read.limb);
    return read;
  }();
  return data;
}

}  // namespace vitrail
