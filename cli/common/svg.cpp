// SPDX-License-Identifier: Apache-2.0
#include "cli/common/svg.h"

namespace vitrail {

std::string svg_element(std::string_view name, const std::vector<SvgAttribute>& attributes,
                        std::string_view content) {
  std::string element = fmt::format("<{}", name);
  for (const SvgAttribute& a : attributes) element += fmt::format(" {}=\"{}\"", a.name, a.value);
  return element + (content.empty() ? "/>" : fmt::format(">{}</{}>", content, name));
}

std::string svg_picture(const std::vector<SvgAttribute>& size, double width, double height, double font_size,
                        std::string_view content) {
  std::vector<SvgAttribute> attributes{{"xmlns", "http://www.w3.org/2000/svg"}};
  attributes.insert(attributes.end(), size.begin(), size.end());
  attributes.insert(attributes.end(), {{"font-family", "sans-serif"}, {"font-size", font_size}});
  const std::string ground = svg_element("rect", {{"width", width}, {"height", height}, {"fill", "white"}});
  return svg_element("svg", attributes, fmt::format("\n<!-- by vitrail -->\n{}\n{}", ground, content)) + "\n";
}

}  // namespace vitrail
