// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <thread>

#include "scene/records/image.h"

namespace vitrail {

// It is "HOST:PORT", or HOST alone with tev's own port; "[::1]:14158" for addresses with colons.
struct DisplayAddress {
  std::string host, port = "14158";
};

// Throws UsageError.
DisplayAddress parse_display_address(const std::string& text);

// A DisplayServer sends pictures of a running render to a viewer, in linear sRGB, 32-bit floats. The protocol
// is tev's (github.com/Tom94/tev, the packets CreateImage and UpdateImageV3). It sends by a thread of its
// own; a film that comes while the last is still sent is left out. A viewer that is not there, or that takes
// nothing for 5 s, is reported once and ends nothing.
class DisplayServer {
 public:
  // `name` is what the viewer calls the picture.
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
