// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <pugixml.hpp>

#include <new>

namespace vitrail {

// Makes pugixml take its memory by `new`, for which --memory holds (scene/system/memory_guard.h). It is
// called before a document is made. What is refused throws through pugixml, whose manual allows that.
inline void guard_xml() {
  static const bool is_set = [] {
    pugi::set_memory_management_functions([](std::size_t size) { return ::operator new(size); },
                                          [](void* block) { ::operator delete(block); });
    return true;
  }();
  static_cast<void>(is_set);
}

}  // namespace vitrail
