// SPDX-License-Identifier: Apache-2.0
// These functions go through the rows of an element, value by value.
#pragma once

#include <vector>

#include "importers/ply/read/ply_source.h"

namespace vitrail::ply {

constexpr std::size_t chunk_rows = 1024;

template <class Source, class OnScalar, class OnList>
void read_rows(Source& source, const Element& element, OnScalar&& on_scalar, OnList&& on_list) {
  std::vector<double> items;
  for (std::uint64_t row = 0; row < element.count; ++row) {
    for (std::size_t i = 0; i < element.properties.size(); ++i) {
      const Property& property = element.properties[i];
      if (!property.count_type) {
        on_scalar(i, source.number(element, property));
        continue;
      }
      const std::uint64_t length = source.list_length(element, property);
      items.clear();
      for (std::uint64_t k = 0; k < length; ++k) items.push_back(source.number(element, property));
      on_list(i, items);
    }
    if (row % chunk_rows == 0) source.release_read();
  }
}

template <class Source>
void skip_element(Source& source, const Element& element) {
  source.require_room(element);
  if (element.properties.empty()) return;
  if constexpr (Source::binary) {
    if (!element.has_list()) return source.skip(element.count * element.row_size());
  }
  read_rows(
      source, element, [](std::size_t, double) {}, [](std::size_t, const std::vector<double>&) {});
}

}  // namespace vitrail::ply
