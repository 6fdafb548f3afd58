// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <thread>

#include "scene/records/image.h"

namespace vitrail {

// "HOST:PORT", or HOST alone: tev's own port. "[::1]:14158" for addresses with colons.
struct DisplayAddress {
  std::string host, port = "14158";
};

// Throws UsageError.
DisplayAddress parse_display_address(const std::string& text);

// Pictures of a render that goes on, sent to a viewer that speaks the protocol of tev (github.com/Tom94/tev,
// the packets CreateImage and UpdateImageV3): linear sRGB, 32-bit floats. Sent by a thread of its own; a film
// that comes while the last is still sent is left out. A viewer that is not there, or that takes nothing for
// 5 s, is told once and ends nothing.
class DisplayServer {
 public:
  // `name`: what the viewer calls the picture.
  DisplayServer(DisplayAddress address, std::string name);
  ~DisplayServer();
  DisplayServer(const DisplayServer&) = delete;
  DisplayServer& operator=(const DisplayServer&) = delete;

  void show(const std::filesystem::path& film);
  // Waits until all that is shown was sent.
  void finish();

 private:
  void send_film(const std::filesystem::path& film);
  void send_picture(const Image& rgb);
  void connect();
  void send(const std::string& payload);

  DisplayAddress address_;
  std::string name_;
  int socket_ = -1;  // not connected
  bool created_ = false, failed_ = false;
  std::atomic<bool> busy_ = false;
  std::thread sending_;
};

}  // namespace vitrail
