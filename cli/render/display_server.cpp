// SPDX-License-Identifier: Apache-2.0
#include "cli/render/display_server.h"

#include <fmt/format.h>
#include <netdb.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>

#include "film/develop.h"
#include "film/film_rows.h"
#include "scene/system/diagnostics.h"
#include "scene/system/say.h"

namespace vitrail {

namespace {

static_assert(std::endian::native == std::endian::little, "the protocol's numbers are");

constexpr std::uint8_t create_image = 4, update_image = 6;

// What follows a packet's length: numbers as they are in memory, names that end in 0.
struct Packet {
  std::string bytes;
  template <class Number>
  void put(Number number) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
  }
  void put_name(const std::string& name) { bytes.append(name.c_str(), name.size() + 1); }
  void put_channels() {
    put(std::int32_t{3});
    for (const char* channel : {"R", "G", "B"}) put_name(channel);
  }
};

Packet packet(std::uint8_t kind, bool grabs_focus, const std::string& name) {
  Packet p;
  p.put(kind), p.put(std::uint8_t{grabs_focus}), p.put_name(name);
  return p;
}

}  // namespace

DisplayAddress parse_display_address(const std::string& text) {
  DisplayAddress address;
  const std::size_t bracket = text.find(']'), colon = text.rfind(':');
  const bool has_port = colon != std::string::npos && (bracket == std::string::npos || colon > bracket);
  address.host = text.substr(0, has_port ? colon : std::string::npos);
  if (has_port) address.port = text.substr(colon + 1);
  if (address.host.starts_with('[') && address.host.ends_with(']'))
    address.host = address.host.substr(1, address.host.size() - 2);
  const bool is_number = !address.port.empty() && address.port.size() <= 5 &&
                         std::ranges::all_of(address.port, [](char c) { return c >= '0' && c <= '9'; });
  if (address.host.empty() || !is_number || std::stoi(address.port) < 1 || std::stoi(address.port) > 65535)
    throw UsageError("--display-server takes HOST:PORT, such as localhost:14158: " + text);
  return address;
}

DisplayServer::DisplayServer(DisplayAddress address, std::string name)
    : address_(std::move(address)), name_(std::move(name)) {}

DisplayServer::~DisplayServer() {
  finish();
  if (socket_ >= 0) ::close(socket_);
}

void DisplayServer::finish() {
  if (sending_.joinable()) sending_.join();
}

void DisplayServer::show(const std::filesystem::path& film) {
  if (failed_ || busy_) return;
  finish();
  busy_ = true;
  sending_ = std::thread([this, film] {
    send_film(film);
    busy_ = false;
  });
}

void DisplayServer::send_film(const std::filesystem::path& file) {
  try {
    const FilmRows film(file, nullptr);
    if (film.samples() == 0) return;
    if (socket_ < 0) connect();
    send_picture(develop_colors(film).rgb);
  } catch (const std::exception& e) {
    failed_ = true;
    say("vitrail: --display-server {}:{}: {}; the render continues\n", address_.host, address_.port,
        e.what());
  }
}

void DisplayServer::connect() {
  addrinfo hints{}, *found = nullptr;
  hints.ai_socktype = SOCK_STREAM;
  if (const int error = ::getaddrinfo(address_.host.c_str(), address_.port.c_str(), &hints, &found))
    throw MachineError(::gai_strerror(error));
  int reason = ECONNREFUSED;
  for (const addrinfo* a = found; a && socket_ < 0; a = a->ai_next) {
    socket_ = ::socket(a->ai_family, a->ai_socktype | SOCK_CLOEXEC, a->ai_protocol);
    if (socket_ < 0) continue;
    constexpr timeval patience{5, 0};  // of connecting, too
    ::setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
    if (::connect(socket_, a->ai_addr, a->ai_addrlen) == 0) break;
    reason = errno;
    ::close(std::exchange(socket_, -1));
  }
  ::freeaddrinfo(found);
  if (socket_ < 0) throw MachineError(std::strerror(reason));
}

void DisplayServer::send_picture(const Image& rgb) {
  if (!created_) {
    Packet create = packet(create_image, true, name_);
    create.put(std::int32_t{rgb.width}), create.put(std::int32_t{rgb.height});
    create.put_channels();
    send(create.bytes);
    created_ = true;
  }
  // Some rows a packet: its length has 32 bits.
  const int rows = std::max(1, (1 << 20) / rgb.width);
  const std::size_t values_a_row = 3 * static_cast<std::size_t>(rgb.width);
  for (int y = 0; y < rgb.height; y += rows) {
    const int count = std::min(rows, rgb.height - y);
    Packet update = packet(update_image, false, name_);
    update.put_channels();
    for (const std::int32_t v : {0, y, rgb.width, count}) update.put(v);
    for (const std::int64_t offset : {0, 1, 2}) update.put(offset);
    for (const std::int64_t stride : {3, 3, 3}) update.put(stride);
    const auto part = std::span(rgb.values)
                          .subspan(static_cast<std::size_t>(y) * values_a_row,
                                   static_cast<std::size_t>(count) * values_a_row);
    update.bytes.append(reinterpret_cast<const char*>(part.data()), part.size_bytes());
    send(update.bytes);
  }
}

void DisplayServer::send(const std::string& payload) {
  Packet whole;
  whole.put(static_cast<std::uint32_t>(payload.size() + sizeof(std::uint32_t)));
  whole.bytes += payload;
  for (std::string_view left = whole.bytes; !left.empty();) {
    const ssize_t sent = ::send(socket_, left.data(), left.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) throw MachineError(std::strerror(errno));
    left.remove_prefix(static_cast<std::size_t>(sent));
  }
}

}  // namespace vitrail
