// SPDX-License-Identifier: Apache-2.0
#include "farm/transport/share_text.h"

namespace vitrail {

void share_from_root(Transport& transport, std::string& text) {
  std::uint64_t count[] = {text.size()};
  transport.broadcast_from_root(std::span(count));
  text.resize(count[0]);
  std::vector<std::uint32_t> letters(text.begin(), text.end());
  transport.broadcast_from_root(std::span(letters));
  for (std::size_t i = 0; i < text.size(); ++i) text[i] = static_cast<char>(letters[i]);
}

}  // namespace vitrail
