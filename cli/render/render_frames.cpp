// SPDX-License-Identifier: Apache-2.0
#include "cli/render/render_frames.h"

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <numeric>
#include <thread>

#include "cli/common/main_guard.h"
#include "cli/common/rank_guard.h"
#include "cli/render/check_frames.h"
#include "cli/render/found_picture.h"
#include "cli/render/frame_job.h"
#include "cli/render/frame_progress.h"
#include "cli/render/picture_output.h"
#include "farm/files/signals.h"
#include "farm/transport/agreement.h"
#include "farm/transport/doing.h"
#include "scene/system/resource_usage.h"
#include "scene/system/say.h"

namespace vitrail {

namespace fs = std::filesystem;

namespace {

// Of a frame, on all ranks as on rank 0.
enum class State : std::uint64_t { open, elsewhere, done, failed };

class FrameRun {
 public:
  FrameRun(Transport& transport, const RenderArguments& command, std::span<char* const> typed)
      : transport_(transport),
        command_(command),
        typed_(typed),
        list_(read_frame_list(command)),
        progress_(list_, command),
        states_(list_.frames.size()),
        was_there_(list_.frames.size()),
        of_films_(command.output.extension() == ".film") {}

  int render_all();

 private:
  struct Failed {
    std::size_t frame;
    int status;
  };
  // How an attempt ended: of those, on rank 0 and then on all.
  struct Attempt {
    State state = State::open;
    int status = exit_done;
    bool out_of_step = false;  // this rank failed where others did not hear of it: the job ends
  };

  void check();
  void survey(std::size_t i, const WorkWords& asked);
  std::optional<int> pass();
  Attempt attempt(std::size_t i);
  int render_frame(std::size_t i);
  bool take(std::size_t i, const RenderArguments& arguments);
  bool must_render(std::size_t i, const RenderArguments& arguments);
  void passes_by(std::size_t i, const BeingWritten& other);
  void wait();
  bool reopen_failed();
  void leave_a_few();
  void say_how_long() const;
  int conclude() const;
  bool is_first() const { return transport_.rank() == 0; }
  std::size_t count(State state) const {
    return static_cast<std::size_t>(std::ranges::count(states_, state));
  }
  bool keeps_record() const { return !of_films_ && !command_.options.outputs.dry_run; }

  Transport& transport_;
  const RenderArguments& command_;
  std::span<char* const> typed_;
  FrameList list_;
  FrameProgress progress_;
  std::vector<State> states_;
  std::vector<bool> was_there_;  // on rank 0, before the first frame
  bool of_films_;
  std::vector<Failed> failed_;  // as time went
  // On rank 0.
  std::optional<FrameRecord> record_;
  KnownViews views_;
  std::vector<std::pair<fs::path, std::string>> others_;  // pictures of other work, and in what they differ
  std::string holders_;                                   // who renders frames elsewhere
  std::size_t wanted_ = 0;                                // of a dry run: the frames that are not there
  std::vector<double> expected_s_;                        // of those that it tries
  // Of the frame under way.
  std::unique_ptr<OutputLock> lock_;
  WorkWords asked_;
  State found_ = State::open;
};

// Says of the first, and how many more there are.
[[noreturn]] void refuse_other_pictures(const std::vector<std::pair<fs::path, std::string>>& others) {
  const auto& [picture, difference] = others.front();
  throw Error(
      fmt::format("this picture is not what its line asks for: {}{}; --force renders all frames anew, and "
                  "another --output keeps it",
                  difference, others.size() > 1 ? fmt::format(" ({} more differ)", others.size() - 1) : ""),
      {picture.string()});
}

// A work file lies beside a picture (RenderArguments::name_outputs).
fs::path work_of(const fs::path& picture) { return fs::path(picture) += ".work"; }

// A job that was killed between its picture and its end leaves its work file and its lock.
void remove_leftovers(const fs::path& work) {
  if (!fs::exists(work) && !fs::exists(lock_path(work))) return;
  try {
    const OutputLock lock(work);
    fs::remove(work);
  } catch (const BeingWritten&) {
    // Its job is about to end.
  }
}

// Whole pictures stay. Films tell by themselves what they are of.
void FrameRun::survey(std::size_t i, const WorkWords& asked) {
  const fs::path& picture = list_.outputs[i];
  if (of_films_ || command_.options.outputs.force) return;
  if (command_.options.outputs.dry_run) {  // of so few seconds, it asks for no picture that there may be
    states_[i] = fs::exists(picture) ? State::done : State::open;
    return;
  }
  const FoundPicture there = find_picture(picture, work_of(picture), *record_, asked);
  if (there.found == Found::another) others_.emplace_back(picture, there.words);
  if (there.found != Found::whole) return;
  states_[i] = State::done;
  was_there_[i] = true;
  remove_leftovers(work_of(picture));
  if (!record_->mark(picture) && keeps_record()) record_->put(picture, asked, mark_of(picture));
}

void FrameRun::check() {
  now_doing("checking the frames");
  agree_on_root(transport_, [&] {
    if (!of_films_) record_.emplace(record_path(command_.output));
    check_frames(list_, command_, typed_, views_,
                 [&](std::size_t i, const WorkWords& asked) { survey(i, asked); });
    if (!others_.empty()) refuse_other_pictures(others_);
    if (count(State::open) > 0) require_denoiser(command_);
  });
  std::vector<std::uint64_t> states;
  for (const State state : states_) states.push_back(static_cast<std::uint64_t>(state));
  transport_.broadcast_from_root(std::span(states));
  for (std::size_t i = 0; i < states.size(); ++i) states_[i] = static_cast<State>(states[i]);
}

// Whether the frame is still to be rendered, now that nobody else does. On rank 0.
bool FrameRun::must_render(std::size_t i, const RenderArguments& a) {
  const fs::path& picture = list_.outputs[i];
  if (of_films_) return true;
  asked_ = FrameJob(typed_, list_.frames[i].words, picture).words(read_manifest(a.input), views_);
  if (a.options.outputs.force) return true;
  record_->read_again();
  const FoundPicture there = find_picture(picture, a.options.outputs.film, *record_, asked_);
  if (there.found == Found::another) refuse_other_pictures({{picture, there.words}});
  if (there.found == Found::damaged) {
    say("vitrail: {} is damaged and is rendered again: {}\n", picture.string(), there.words);
    if (!a.options.outputs.dry_run) fs::remove(picture);
  }
  return there.found != Found::whole;
}

void FrameRun::passes_by(std::size_t i, const BeingWritten& other) {
  holders_ += fmt::format("{}{} ({})", holders_.empty() ? "" : ", ", list_.outputs[i].string(), other.holder);
  if (states_[i] == State::elsewhere) return;
  progress_.says(i, fmt::format("is rendered elsewhere, by {}", other.holder));
  if (other.is_only_named) say("vitrail: {}\n", other.what());
}

// On rank 0. Returns whether the frame is rendered here; else `found_` says how it stands.
bool FrameRun::take(std::size_t i, const RenderArguments& a) {
  try {
    lock_film(a, lock_);
  } catch (const BeingWritten& other) {
    passes_by(i, other);
    found_ = State::elsewhere;
    return false;
  }
  found_ = State::done;
  if (!must_render(i, a)) {
    lock_.reset();
    progress_.says(i, "was rendered elsewhere");
    return false;
  }
  check_outputs(a);
  // Killed between, a job leaves the old picture: nobody takes that for the new one.
  if (keeps_record() && fs::exists(list_.outputs[i])) record_->remove(list_.outputs[i]);
  progress_.begins(i);
  return true;
}

// What earlier frames have left resident counts as this one's own (farm/plan/job.cpp).
void give_back_memory() {
  ::malloc_trim(0);
  forget_code_pages();
}

int FrameRun::render_frame(std::size_t i) {
  give_back_memory();
  std::optional<FrameJob> job;
  agree(transport_, [&] { job.emplace(typed_, list_.frames[i].words, list_.outputs[i]); });
  const JobSteps steps{&views_,
                       [&] {
                         if (keeps_record())
                           record_->put(list_.outputs[i], asked_, mark_of(list_.outputs[i]));
                       },
                       [&](double s) { expected_s_.push_back(s); }};
  return job
      ->render(
          transport_, [&](const RenderArguments& a) { return take(i, a); }, steps)
      .value_or(exit_done);
}

// Rank 0 decides how it ended.
FrameRun::Attempt FrameRun::attempt(std::size_t i) {
  const std::uint64_t failures = agreed_failures();
  bool out_of_step = false;
  const int status = run_guarded([&] {
    return guarded(transport_, [&] {
      try {
        return render_frame(i);
      } catch (...) {
        out_of_step = transport_.size() > 1 && agreed_failures() == failures;
        throw;
      }
    });
  });
  lock_.reset();
  if (out_of_step) return {State::failed, status, true};
  const State state = status == exit_done ? found_ : State::failed;
  std::array<std::uint64_t, 2> end{static_cast<std::uint64_t>(state), static_cast<std::uint64_t>(status)};
  transport_.broadcast_from_root(std::span<std::uint64_t>(end));
  return {static_cast<State>(end[0]), static_cast<int>(end[1])};
}

// Goes over all frames that are not done. Returns a status where the whole job ends with it.
std::optional<int> FrameRun::pass() {
  holders_.clear();
  for (std::size_t i = 0; i < states_.size(); ++i) {
    if (is_first() && was_there_[i]) progress_.says(i, "is there and stays");
    was_there_[i] = false;  // that is said once
    if (states_[i] == State::done || states_[i] == State::failed) continue;
    progress_.done(count(State::done));
    const Attempt end = attempt(i);
    if (end.out_of_step || end.status > 128) return end.status;
    states_[i] = end.state;
    if (end.state == State::failed) failed_.push_back({i, end.status});
  }
  return std::nullopt;
}

// For those who render the rest: they may end before it is done.
void FrameRun::wait() {
  using namespace std::chrono_literals;
  catch_signals();
  const auto end = std::chrono::steady_clock::now() + 1s;
  while (std::chrono::steady_clock::now() < end && !stop_signal()) {
    transport_.goes_on();
    std::this_thread::sleep_for(20ms);
  }
  agree(transport_, [&] {
    if (is_first() && stop_signal())
      throw Interrupted(stop_signal(), "stopped while others render " + holders_);
  });
}

// Returns whether there are any that may succeed now.
bool FrameRun::reopen_failed() {
  const auto may_succeed = [](const Failed& failed) { return failed.status == exit_machine; };
  for (const Failed& failed : failed_)
    if (may_succeed(failed)) states_[failed.frame] = State::open;
  return std::erase_if(failed_, may_succeed) > 0;
}

// A dry run tries some frames, from the first to the last. What it passes by counts as done.
void FrameRun::leave_a_few() {
  constexpr std::size_t tried = 5;
  std::vector<std::size_t> open;
  for (std::size_t i = 0; i < states_.size(); ++i)
    if (states_[i] == State::open) open.push_back(i);
  wanted_ = open.size();
  if (wanted_ <= tried) return;
  for (const std::size_t i : open) states_[i] = State::done;
  for (std::size_t k = 0; k < tried; ++k) states_[open[k * (wanted_ - 1) / (tried - 1)]] = State::open;
}

void FrameRun::say_how_long() const {
  if (expected_s_.empty()) return;
  const double mean =
      std::accumulate(expected_s_.begin(), expected_s_.end(), 0.0) / static_cast<double>(expected_s_.size());
  const auto [least, most] = std::ranges::minmax(expected_s_);
  show("list: about {:.2g} machine hours for {} frames, by {} of them that take {:.2g} to {:.2g} min each\n",
       mean * static_cast<double>(wanted_) / 3600, wanted_, expected_s_.size(), least / 60, most / 60);
}

int FrameRun::conclude() const {
  if (failed_.empty()) return exit_done;
  constexpr std::size_t most = 10;
  std::vector<std::string> names;
  for (const Failed& failed : std::span(failed_).first(std::min(most, failed_.size())))
    names.push_back(fmt::format("{} (status {})", list_.outputs[failed.frame].string(), failed.status));
  if (is_first())
    say("vitrail: {} of {} frames failed: {}{}; the same command tries them again\n", failed_.size(),
        states_.size(), fmt::join(names, ", "), failed_.size() > most ? " and others" : "");
  return failed_.front().status;
}

int FrameRun::render_all() {
  check();
  if (command_.options.outputs.dry_run) leave_a_few();
  bool waits = false;
  for (int retries = 0;;) {
    if (const std::optional<int> end = pass()) return *end;
    if (count(State::elsewhere) > 0) {
      if (is_first() && !command_.quiet && !std::exchange(waits, true))
        say("vitrail: waits for {}, and renders what they leave unfinished\n", holders_);
      wait();
    } else if (retries < command_.retries && reopen_failed()) {
      ++retries;
    } else {
      if (is_first()) say_how_long();
      return conclude();
    }
  }
}

}  // namespace

int render_frames(Transport& transport, const RenderArguments& command, std::span<char* const> typed) {
  std::optional<OutputLock> held;
  std::optional<FrameRun> run;
  agree(transport, [&] {
    if (transport.rank() == 0 && !command.held_lock.empty()) held.emplace(command.held_lock);
    run.emplace(transport, command, typed);
  });
  return run->render_all();
}

}  // namespace vitrail
