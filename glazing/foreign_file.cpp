// SPDX-License-Identifier: Apache-2.0
#include "glazing/foreign_file.h"

#include "glazing/text_file.h"

namespace vitrail {

std::string foreign_kind(std::string_view text, std::string_view name) {
  const std::string_view start = trimmed(text.substr(0, 4096));
  const std::string ending = lower(name.substr(std::min(name.rfind('.'), name.size())));
  if (start.starts_with("IESNA") || ending == ".ies") return "the light of a lamp by direction (IES LM-63)";
  if (ending == ".ldt") return "the light of a lamp by direction (EULUMDAT)";
  if (start.starts_with("LOCATION,") || ending == ".epw") return "a weather file (EPW)";
  if (ending == ".wea") return "a weather file (WEA)";
  if (start.find("<WindowElement") != start.npos) return "a BSDF as XML, as WINDOW and Radiance have it";
  if (ending == ".rad") return "a scene of Radiance";
  return "";
}

}  // namespace vitrail
