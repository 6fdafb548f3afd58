// SPDX-License-Identifier: Apache-2.0
#include "scene/system/say.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>

#include "scene/system/diagnostics.h"

namespace vitrail {

namespace {

// Of a well-formed character of so many bytes.
std::uint32_t code_of(std::string_view text, std::size_t bytes) {
  const auto first = static_cast<unsigned char>(text[0]);
  std::uint32_t code = bytes == 1 ? first : first & (0x7fu >> bytes);
  for (std::size_t i = 1; i < bytes; ++i) code = code << 6 | (static_cast<unsigned char>(text[i]) & 0x3fu);
  return code;
}

bool is_control(std::uint32_t code) {
  const bool turns = code == 0x200e || code == 0x200f || (code >= 0x202a && code <= 0x202e) ||
                     (code >= 0x2066 && code <= 0x2069);
  return code < 0x20 || (code >= 0x7f && code < 0xa0) || turns;
}

std::atomic<bool> line_is_open = false;
constexpr const char* clear_line = "\r\033[K";

void write_to_terminal(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stderr); }

[[noreturn]] void fail_output(int reason) {
  throw MachineError(fmt::format("cannot write to standard output: {}", std::strerror(reason)));
}

}  // namespace

std::size_t utf8_size(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t size = first < 0xc2 ? 0 : first < 0xe0 ? 2 : first < 0xf0 ? 3 : first < 0xf5 ? 4 : 0;
  if (size == 0 || text.size() < size) return 0;
  const unsigned low = first == 0xe0 ? 0xa0 : first == 0xf0 ? 0x90 : 0x80;
  const unsigned high = first == 0xed ? 0x9f : first == 0xf4 ? 0x8f : 0xbf;
  if (byte(1) < low || byte(1) > high) return 0;
  for (std::size_t i = 2; i < size; ++i) {
    if (byte(i) < 0x80 || byte(i) > 0xbf) return 0;
  }
  return size;
}

std::string for_terminal(std::string_view text, bool lines) {
  std::string shown;
  while (!text.empty()) {
    const std::size_t bytes = utf8_size(text);
    const std::uint32_t code = code_of(text, bytes);
    const bool stays = lines && (code == '\n' || code == '\t');
    if (bytes == 0)
      shown += fmt::format("\\x{:02x}", static_cast<unsigned char>(text[0]));
    else if (stays || !is_control(code))
      shown += text.substr(0, bytes);
    else
      shown += fmt::format("\\u{:04x}", code);
    text.remove_prefix(bytes > 0 ? bytes : 1);
  }
  return shown;
}

void say_text(const std::string& text) {
  write_to_terminal((line_is_open.exchange(false) ? clear_line : "") + for_terminal(text));
}

void say_over_shown(const std::string& shown) {
  line_is_open = true;
  write_to_terminal(clear_line + shown);
}

void close_line() {
  if (line_is_open.exchange(false)) write_to_terminal(clear_line);
}

void show_text(const std::string& text) {
  close_line();
  const std::string shown = for_terminal(text);
  if (std::fwrite(shown.data(), 1, shown.size(), stdout) != shown.size()) fail_output(errno);
}

void flush_shown() {
  if (std::fflush(stdout) != 0) fail_output(errno);
}

void open_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(stream, F_GETFD) < 0) ::open("/dev/null", stream == STDERR_FILENO ? O_WRONLY : O_RDONLY);
}

}  // namespace vitrail
