// SPDX-License-Identifier: Apache-2.0
// These functions write elements of SVG pictures.
#pragma once

#include <fmt/format.h>

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vitrail {

// An SvgAttribute writes a number with as many digits as it needs.
struct SvgAttribute {
  SvgAttribute(const char* attribute, std::string text) : name(attribute), value(std::move(text)) {}
  SvgAttribute(const char* attribute, double number) : name(attribute), value(fmt::format("{}", number)) {}

  std::string name, value;
};

// Returns one element; the content, if there is any, stands in it as it is.
std::string svg_element(std::string_view name, const std::vector<SvgAttribute>& attributes,
                        std::string_view content = {});

// Returns a whole file, with sans-serif text and a white ground of so many units; `size` are attributes that
// say how large it is shown. The content is lines of elements.
std::string svg_picture(const std::vector<SvgAttribute>& size, double width, double height, double font_size,
                        std::string_view content);

}  // namespace vitrail
