// SPDX-License-Identifier: Apache-2.0
#include "cli/common/main_guard.h"

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "cli/common/command_line.h"
#include "cli/help/completion.h"
#include "cli/help/describe.h"
#include "cli/help/help_text.h"
#include "cli/help/licence.h"
#include "cli/help/man_page.h"
#include "cli/help/markdown_page.h"
#include "scene/system/diagnostics.h"
#include "scene/system/input_files.h"
#include "scene/system/say.h"

namespace vitrail {

namespace {

// What the JSON library throws begins with its own number, "[json.exception.out_of_range.403] ".
std::string without_numbers(std::string message) {
  constexpr const char* begin = "[json.exception.";
  for (std::size_t at; (at = message.find(begin)) != std::string::npos;) {
    const std::size_t end = message.find("] ", at);
    message.erase(at, end == std::string::npos ? end : end + 2 - at);
  }
  return message;
}

int fail(int status, const std::string& message) {
  say("vitrail: {}\n", without_numbers(message));
  return status;
}

int fail(const Error& e) {
  const std::string place = for_terminal(to_string(e.location), false);
  say("vitrail: {}{}{}\n", place, place.empty() ? "" : ": ", without_numbers(e.what()));
  if (!e.excerpt.empty()) say("  | {}\n", for_terminal(e.excerpt, false));
  return exit_bad_input;
}

// What a library throws about a file that is not as it should be, where nobody said which.
int fail_in_library(const std::string& input, const std::string& message) {
  return fail(exit_bad_input, fmt::format("{}{}this cannot be read: {}", for_terminal(input, false),
                                          input.empty() ? "" : ": ", message));
}

// A full disk and what may not be written are the machine's; other names and files are the input's.
int fail(const std::filesystem::filesystem_error& e) {
  const std::error_code code = e.code();
  for (const std::errc of_machine :
       {std::errc::no_space_on_device, std::errc::io_error, std::errc::read_only_file_system,
        std::errc::permission_denied, std::errc::too_many_files_open, std::errc::not_enough_memory})
    if (code == of_machine)
      return fail(exit_machine, fmt::format("{}: {}", e.path1().string(), code.message()));
  return fail_in_library(e.path1().string(), code.message());
}

int run(const std::string& input, const std::function<int()>& body) {
  open_standard_streams();
  protect_inputs();
  try {
    const int status = body();
    close_line();
    flush_shown();
    return status;
  } catch (const AlreadySaid& e) {
    return e.status;
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
  } catch (const std::filesystem::filesystem_error& e) {
    return fail(e);
  } catch (const std::length_error& e) {  // that a file states
    return fail_in_library(input, e.what());
  } catch (const std::out_of_range& e) {
    return fail_in_library(input, e.what());
  } catch (const nlohmann::json::exception& e) {
    return fail_in_library(input, e.what());
  } catch (const std::exception& e) {  // MachineError among them
    return fail(exit_machine, e.what());
  }
}

// What was named first: the scene, the bundle or the film.
std::string first_input(const CLI::App& app) {
  for (const CLI::Option* option : app.get_options())
    if (option->get_positional() && !option->results().empty()) return option->results().front();
  return {};
}

// "render" of "vitrail render".
std::string verb_of(const CLI::App& app) {
  const std::string& name = app.get_name();
  return name.substr(name.rfind(' ') + 1);
}

// Of the hidden `--describe man|markdown|bash|zsh|fish`, which the build and the documentation's test ask
// for; empty of another word.
std::string description(const CLI::App& app, const std::string& writer) {
  if (writer == "man") return man_page(describe(app), VITRAIL_VERSION);
  if (writer == "markdown") return markdown_page(describe(app));
  const bool is_shell = std::ranges::find(completed_shells, writer) != completed_shells.end();
  return is_shell ? completion_of(writer, describe(app)) : "";
}

int answer(const std::string& text) {
  show("{}", text);
  flush_shown();
  return exit_done;
}

}  // namespace

int run_guarded(const std::function<int()>& body) { return run({}, body); }

int end_with(int status) {
  const int number = status - 128;
  if (number != SIGINT && number != SIGTERM) return status;
  std::fflush(nullptr);
  std::signal(number, SIG_DFL);
  std::raise(number);
  return status;
}

int run_guarded(CLI::App& app, int argc, char** argv, const std::function<int()>& body) {
  std::string input;
  app.set_version_flag(
      "-V,--version", [&] { return version_text(VITRAIL_VERSION, verb_of(app)); },
      "print the version and the licence");
  app.set_help_flag("-h,--help", "print this help");
  app.set_help_all_flag("--help-all", "print all options");
  let_the_last_count(app);
  return run(input, [&] {
    try {
      if (argc == 3 && std::string(argv[1]) == "--describe")
        if (const std::string text = description(app, argv[2]); !text.empty()) return answer(text);
      std::vector<std::string> words = as_parsed(app, {argv + 1, argv + argc});
      std::ranges::reverse(words);  // as CLI11 takes them
      app.parse(std::move(words));
      input = first_input(app);
    } catch (const CLI::CallForHelp&) {
      return answer(short_help_text(describe(app), help_width()));
    } catch (const CLI::CallForAllHelp&) {
      return answer(help_text(describe(app), help_width()));
    } catch (const CLI::CallForVersion& e) {
      return answer(e.what());
    } catch (const CLI::Success&) {  // an option that answers by itself, as develop --find-denoiser
      return answer({});
    } catch (const CLI::ParseError& e) {
      throw UsageError(fmt::format("{} (see {} --help)", about(app, e), app.get_name()));
    }
    return body();
  });
}

}  // namespace vitrail
