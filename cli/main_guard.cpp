// SPDX-License-Identifier: Apache-2.0
#include "cli/main_guard.h"

#include <fmt/format.h>

#include <csignal>
#include <cstdio>
#include <new>
#include <string>

#include "cli/unknown_options.h"
#include "scene/diagnostics.h"
#include "scene/input_files.h"
#include "scene/say.h"

namespace vitrail {

namespace {

int fail(int status, const std::string& message) {
  say("vitrail: {}\n", message);
  return status;
}

int fail(const Error& e) {
  const std::string place = to_string(e.location);
  say("vitrail: {}{}{}\n", place, place.empty() ? "" : ": ", e.what());
  if (!e.excerpt.empty()) say("  | {}\n", e.excerpt);
  return exit_bad_input;
}

}  // namespace

int run_guarded(const std::function<int()>& body) {
  open_standard_streams();
  protect_inputs();
  try {
    return body();
  } catch (const Error& e) {
    return fail(e);
  } catch (const UsageError& e) {
    return fail(exit_usage, e.what());
  } catch (const CLI::ParseError& e) {
    return fail(exit_usage, e.what());
  } catch (const Interrupted& e) {
    return fail(128 + e.signal, e.what());
  } catch (const std::bad_alloc&) {
    return fail(exit_machine, "out of memory");
  } catch (const std::exception& e) {  // MachineError among them
    return fail(exit_machine, e.what());
  }
}

int end_with(int status) {
  const int number = status - 128;
  if (number != SIGINT && number != SIGTERM) return status;
  std::fflush(nullptr);
  std::signal(number, SIG_DFL);
  std::raise(number);
  return status;
}

int run_guarded(CLI::App& app, int argc, char** argv, const std::function<int()>& body) {
  return run_guarded([&] {
    try {
      app.parse(argc, argv);
    } catch (const CLI::Success& e) {  // --help, --version
      return app.exit(e);
    } catch (const CLI::ExtrasError&) {
      throw UsageError(fmt::format("{} (see {} --help)", about_unexpected(app), app.get_name()));
    } catch (const CLI::ParseError& e) {
      throw UsageError(fmt::format("{} (see {} --help)", e.what(), app.get_name()));
    }
    return body();
  });
}

}  // namespace vitrail
