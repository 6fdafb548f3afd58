// SPDX-License-Identifier: Apache-2.0
#include "scene/say.h"

#include <fcntl.h>
#include <unistd.h>

#include <cstdio>

namespace vitrail {

void say_text(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stderr); }

void open_standard_streams() {
  int opened = 0;
  while (opened >= 0 && opened <= STDERR_FILENO) opened = ::open("/dev/null", O_RDWR);
  if (opened >= 0) ::close(opened);
}

}  // namespace vitrail
