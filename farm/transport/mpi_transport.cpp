// SPDX-License-Identifier: Apache-2.0
// The C interface only.
#define OMPI_SKIP_MPICXX 1
#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <list>
#include <thread>

#include "farm/transport/round_tree.h"
#include "farm/transport/transport.h"
#include "scene/system/diagnostics.h"
#include "scene/system/machine_limits.h"

namespace vitrail {

namespace {

// Buffers of collectives are cut into parts, so that the library's own copies stay small.
constexpr std::size_t collective_bytes = 2 << 20;
template <class T>
constexpr std::size_t collective_part = collective_bytes / sizeof(T);

constexpr int tag_of_rays = 0, tag_of_words = 1;

template <class T>
void add_all(void* from, void* to, int* count, MPI_Datatype*) {
  for (int i = 0; i < *count; ++i) static_cast<T*>(to)[i] += static_cast<const T*>(from)[i];
}

class MpiTransport final : public Transport {
 public:
  MpiTransport(int* argc, char*** argv) {
    // On machines with more ranks than cores a rank that spins takes the core from one that works.
    ::setenv("OMPI_MCA_mpi_yield_when_idle", "1", 0);
    // A part is one message. Open MPI 4.1's own choice for up to four ranks is a chain of small pieces, 256
    // reads of the other's memory for a part of 2 MiB, each of which waits for a rank that may wait for a
    // core.
    ::setenv("OMPI_MCA_coll_libnbc_ireduce_algorithm", "2", 0);  // binomial
    allow_many_files();
    int provided = 0;
    MPI_Init_thread(argc, argv, MPI_THREAD_FUNNELED, &provided);
    if (provided < MPI_THREAD_FUNNELED)
      throw MachineError("this MPI does not allow threads beside the one that calls it");
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
    round_.emplace(rank_, size_);
    MPI_Type_contiguous(2, MPI_UINT64_T, &wide_sum_);
    MPI_Type_commit(&wide_sum_);
    MPI_Op_create(add_all<WideSum>, /*commute=*/1, &add_wide_sums_);
    MPI_Type_contiguous(sizeof(MattePixel), MPI_BYTE, &matte_pixel_);
    MPI_Type_commit(&matte_pixel_);
    MPI_Op_create(add_all<MattePixel>, /*commute=*/1, &add_matte_pixels_);
    listen();
  }
  ~MpiTransport() override {
    MPI_Cancel(&hearing_);
    MPI_Request_free(&hearing_);
    MPI_Op_free(&add_matte_pixels_);
    MPI_Type_free(&matte_pixel_);
    MPI_Op_free(&add_wide_sums_);
    MPI_Type_free(&wide_sum_);
    MPI_Finalize();
  }

  int rank() const override { return rank_; }
  int size() const override { return size_; }

  void send(int to, std::vector<std::byte> message) override {
    complete_sends();
    Sending& s = sending_.emplace_back(Sending{std::move(message), MPI_REQUEST_NULL});
    MPI_Isend(s.message.data(), static_cast<int>(s.message.size()), MPI_BYTE, to, tag_of_rays, MPI_COMM_WORLD,
              &s.request);
  }

  std::uint64_t sending_bytes() override {
    complete_sends();
    std::uint64_t bytes = 0;
    for (const Sending& s : sending_) bytes += s.message.capacity();
    return bytes;
  }

  // A message that begins to arrive is received beside others: its sender may take long to send the rest, or
  // be stopped before it does.
  std::optional<Message> receive() override {
    complete_sends();
    begin_to_receive();
    for (auto r = receiving_.begin(); r != receiving_.end(); ++r) {
      int done = 0;
      MPI_Test(&r->request, &done, MPI_STATUS_IGNORE);
      if (!done) continue;
      Message message{r->from, std::move(r->bytes)};
      receiving_.erase(r);
      return message;
    }
    return std::nullopt;
  }

  void start_round(const RoundSums& mine, const RankReport& report) override { round_->start(mine, report); }

  std::optional<Round> finish_round() override { return round_->finish(); }

  void say(int to, Word word) override {
    static constexpr Word words[] = {Word::are_you_there, Word::here, Word::failed};
    MPI_Request request;
    MPI_Isend(&words[static_cast<std::size_t>(word)], 1, MPI_BYTE, to, tag_of_words, MPI_COMM_WORLD,
              &request);
    MPI_Request_free(&request);
  }

  std::optional<std::pair<int, Word>> hear() override {
    int arrived = 0;
    MPI_Status status;
    MPI_Test(&hearing_, &arrived, &status);
    if (!arrived) return std::nullopt;
    const std::pair heard{status.MPI_SOURCE, word_};
    listen();
    return heard;
  }

  void abandon(int status) override {
    MPI_Abort(MPI_COMM_WORLD, status);
    std::_Exit(status);
  }

  void leave() override {
    MPI_Request request;
    MPI_Ibarrier(MPI_COMM_WORLD, &request);
    wait(request);
  }

  void sum_to_root(std::span<std::int64_t> values) override { reduce(values, MPI_INT64_T, MPI_SUM); }
  void sum_to_root(std::span<std::uint32_t> values) override { reduce(values, MPI_UINT32_T, MPI_SUM); }
  void sum_to_root(std::span<double> values) override { reduce(values, MPI_DOUBLE, MPI_SUM); }
  void sum_to_root(std::span<WideSum> values) override { reduce(values, wide_sum_, add_wide_sums_); }
  void sum_to_root(std::span<MattePixel> values) override { reduce(values, matte_pixel_, add_matte_pixels_); }
  void max_to_root(std::span<std::int64_t> values) override { reduce(values, MPI_INT64_T, MPI_MAX); }

  void broadcast_from_root(std::span<std::uint64_t> values) override { broadcast(values, MPI_UINT64_T); }
  void broadcast_from_root(std::span<std::uint32_t> values) override { broadcast(values, MPI_UINT32_T); }

 private:
  struct Sending {
    std::vector<std::byte> message;
    MPI_Request request;
  };

  struct Receiving {
    int from;
    std::vector<std::byte> bytes;
    MPI_Request request;
  };

  // So much at a time, and what was begun last: their memory would not be bounded otherwise.
  void begin_to_receive() {
    constexpr std::size_t most_bytes = 2 << 20;
    std::size_t held = 0;
    for (const Receiving& r : receiving_) held += r.bytes.size();
    while (held < most_bytes) {
      int arrived = 0;
      MPI_Message message;
      MPI_Status status;
      MPI_Improbe(MPI_ANY_SOURCE, tag_of_rays, MPI_COMM_WORLD, &arrived, &message, &status);
      if (!arrived) return;
      int bytes = 0;
      MPI_Get_count(&status, MPI_BYTE, &bytes);
      Receiving& r = receiving_.emplace_back(Receiving{
          status.MPI_SOURCE, std::vector<std::byte>(static_cast<std::size_t>(bytes)), MPI_REQUEST_NULL});
      held += r.bytes.size();
      MPI_Imrecv(r.bytes.data(), bytes, MPI_BYTE, &message, &r.request);
    }
  }

  void listen() { MPI_Irecv(&word_, 1, MPI_BYTE, MPI_ANY_SOURCE, tag_of_words, MPI_COMM_WORLD, &hearing_); }

  void complete_sends() {
    std::erase_if(sending_, [](Sending& s) {
      int done = 0;
      MPI_Test(&s.request, &done, MPI_STATUS_IGNORE);
      return done != 0;
    });
  }

  void wait(MPI_Request& request) {
    constexpr int quick_tests = 1000;
    int done = 0;
    for (int tests = 0;; ++tests) {
      MPI_Test(&request, &done, MPI_STATUS_IGNORE);
      if (done) return;
      goes_on();
      if (tests > quick_tests) std::this_thread::sleep_for(std::chrono::microseconds(20));
    }
  }

  template <class T>
  void reduce(std::span<T> values, MPI_Datatype type, MPI_Op operation) {
    constexpr std::size_t part = collective_part<T>;
    for (std::size_t at = 0; at < values.size(); at += part) {
      const int count = static_cast<int>(std::min(part, values.size() - at));
      MPI_Request request;
      MPI_Ireduce(rank_ == 0 ? MPI_IN_PLACE : values.data() + at, values.data() + at, count, type, operation,
                  0, MPI_COMM_WORLD, &request);
      wait(request);
      // Who sends is done with a part before it is received: the parts of one who is ahead would fill the
      // memory of one who is not.
      MPI_Ibarrier(MPI_COMM_WORLD, &request);
      wait(request);
    }
    // Pages that nothing was written to stay so.
    if (rank_ != 0)
      for (T& value : values)
        if (!(value == T{})) value = T{};
  }

  template <class T>
  void broadcast(std::span<T> values, MPI_Datatype type) {
    constexpr std::size_t part = collective_part<T>;
    for (std::size_t at = 0; at < values.size(); at += part) {
      MPI_Request request;
      MPI_Ibcast(values.data() + at, static_cast<int>(std::min(part, values.size() - at)), type, 0,
                 MPI_COMM_WORLD, &request);
      wait(request);
    }
  }

  int rank_ = 0, size_ = 1;
  std::list<Sending> sending_;
  std::list<Receiving> receiving_;  // as they came
  Word word_{};                     // the next that is heard
  MPI_Request hearing_ = MPI_REQUEST_NULL;
  std::optional<RoundTree> round_;
  MPI_Datatype wide_sum_ = MPI_DATATYPE_NULL, matte_pixel_ = MPI_DATATYPE_NULL;
  MPI_Op add_wide_sums_ = MPI_OP_NULL, add_matte_pixels_ = MPI_OP_NULL;
};

}  // namespace

const char* name_of_mpi() {
#if defined(OPEN_MPI)
  return "Open MPI";
#elif defined(I_MPI_VERSION)
  return "Intel MPI";
#elif defined(MPICH_VERSION)
  return "MPICH";
#else
  return "another MPI";
#endif
}

std::unique_ptr<Transport> make_mpi_transport(int* argc, char*** argv) {
  return std::make_unique<MpiTransport>(argc, argv);
}

}  // namespace vitrail
