// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pugixml.hpp>

#include "scene/records/nesting_limits.h"

namespace vitrail {

// Returns the first element that lies deeper in others than a scene may have it, or none. pugixml itself
// parses any depth, but frees its nodes by recursion.
inline pugi::xml_node too_deep_element(pugi::xml_node document) {
  int depth = 0;
  for (pugi::xml_node node = document.first_child(); node;) {
    if (depth >= most_nested) return node;
    if (node.first_child()) {
      node = node.first_child(), ++depth;
      continue;
    }
    while (node != document && !node.next_sibling()) node = node.parent(), --depth;
    if (node == document) break;
    node = node.next_sibling();
  }
  return {};
}

}  // namespace vitrail
