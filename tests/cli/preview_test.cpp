// SPDX-License-Identifier: Apache-2.0
// What is seen of a picture while it is rendered.
#include <arpa/inet.h>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <future>

#include "tests/support/background.h"
#include "tests/support/partitioned_box.h"

namespace vitrail::test::preview_test {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

// Speaks tev's protocol as far as a render does, and keeps what it was shown.
class StandInViewer {
 public:
  StandInViewer() : listening_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::bind(listening_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    ::listen(listening_, 1);
    socklen_t size = sizeof address;
    ::getsockname(listening_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
    done_ = std::async(std::launch::async, [this] { receive(); });
  }
  ~StandInViewer() {
    ::shutdown(listening_, SHUT_RDWR);
    done_.wait();
    ::close(listening_);
  }
  int port() const { return port_; }
  // Waits until the render has hung up.
  void wait() { done_.wait(); }

  std::string name, problem;
  std::int32_t width = 0, height = 0;
  int pictures = 0;
  std::vector<float> values;  // [y][x][channel]

 private:
  struct Reader {
    std::string bytes;
    std::size_t at = 0;
    template <class Number>
    Number number() {
      Number n{};
      if (at + sizeof n <= bytes.size()) std::memcpy(&n, bytes.data() + at, sizeof n);
      at += sizeof n;
      return n;
    }
    std::string text() {
      const std::string t = bytes.substr(at).c_str();
      at += t.size() + 1;
      return t;
    }
  };

  void receive() {
    const int peer = ::accept(listening_, nullptr, nullptr);
    for (std::uint32_t length;
         peer >= 0 && ::recv(peer, &length, sizeof length, MSG_WAITALL) == sizeof length;) {
      Reader in{std::string(length - sizeof length, '\0')};
      if (::recv(peer, in.bytes.data(), in.bytes.size(), MSG_WAITALL) !=
          static_cast<ssize_t>(in.bytes.size()))
        break;
      take(in);
    }
    ::close(peer);
  }
  void take(Reader& in) {
    const auto kind = in.number<std::uint8_t>();
    in.number<std::uint8_t>();  // whether it grabs the focus
    const std::string called = in.text();
    if (kind == 4) {
      name = called;
      width = in.number<std::int32_t>(), height = in.number<std::int32_t>();
      values.assign(3 * static_cast<std::size_t>(width * height), NAN);
      take_channels(in);
    } else if (kind == 6) {
      take_channels(in);
      const auto x = in.number<std::int32_t>(), y = in.number<std::int32_t>(), w = in.number<std::int32_t>(),
                 h = in.number<std::int32_t>();
      std::array<std::int64_t, 6> layout{};
      for (std::int64_t& n : layout) n = in.number<std::int64_t>();
      if (called != name || layout != std::array<std::int64_t, 6>{0, 1, 2, 3, 3, 3} || x != 0 || w != width ||
          in.bytes.size() - in.at != 12 * static_cast<std::size_t>(w * h))
        problem = "an update that is none";
      else
        std::memcpy(&values[3 * static_cast<std::size_t>(y * w)], &in.bytes[in.at], in.bytes.size() - in.at);
      if (y + h == height) ++pictures;
    } else {
      problem = fmt::format("a packet of kind {}", kind);
    }
  }
  void take_channels(Reader& in) {
    if (in.number<std::int32_t>() != 3 || in.text() != "R" || in.text() != "G" || in.text() != "B")
      problem = "other channels";
  }

  int listening_, port_ = 0;
  std::future<void> done_;
};

class Previews : public PartitionedBox {
 protected:
  Previews() : PartitionedBox(1) {}
  std::string line(const std::string& more) const {
    return fmt::format("{} '{}' -o '{}' --crop 0,64,0,48 --threads 1 {}", vitrail("render"), path("box.vit"),
                       path("x.png"), more);
  }
};

TEST_F(Previews, AViewerIsShownWhatIsDone) {
  StandInViewer viewer;
  const CommandResult done =
      run(line(fmt::format("--spp 65536 --time 2.2 --display-server localhost:{}", viewer.port())));
  ASSERT_EQ(done.status, 0) << done.output;
  viewer.wait();
  EXPECT_EQ(viewer.problem, "");
  EXPECT_EQ(viewer.name, "x.png");
  EXPECT_EQ(viewer.width, 64);
  EXPECT_EQ(viewer.height, 48);
  EXPECT_GE(viewer.pictures, 3) << "after 0.25 s, 0.5 s, 1 s …";
  EXPECT_LE(viewer.pictures, 7) << "at doubling times";
  EXPECT_EQ(std::ranges::count_if(viewer.values, [](float v) { return std::isnan(v); }), 0);
  EXPECT_GT(*std::ranges::max_element(viewer.values), 0);
}

TEST_F(Previews, AViewerThatIsNotThereEndsNothing) {
  const CommandResult done = run(line("--spp 200 --display-server localhost:9"));
  EXPECT_EQ(done.status, 0) << done.output;
  EXPECT_THAT(done.output, HasSubstr("--display-server localhost:9: "));
  EXPECT_TRUE(std::filesystem::exists(path("x.png")));
  EXPECT_EQ(run(line("--spp 1 --display-server here:99999")).status, 2);
}

TEST_F(Previews, APreviewIsThereAtOnceAndWhereTheRenderIsStopped) {
  Background job(line(fmt::format("--spp 400000 --preview '{}'", path("p.png"))));
  const auto begin = std::chrono::steady_clock::now();
  while (job.running() && !std::filesystem::exists(path("p.png"))) std::this_thread::sleep_for(5ms);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, 20s);
  ASSERT_TRUE(job.running());
  std::filesystem::remove(path("p.png"));
  job.send(SIGINT);
  EXPECT_EQ(job.wait(), 128 + SIGINT);
  EXPECT_TRUE(std::filesystem::exists(path("p.png"))) << "the picture so far";
}

}  // namespace
}  // namespace vitrail::test::preview_test
