// SPDX-License-Identifier: Apache-2.0
#include "cli/common/rank_guard.h"

#include <fmt/format.h>

#include <new>
#include <string>

#include "cli/common/main_guard.h"
#include "farm/files/signals.h"
#include "farm/transport/agreement.h"

namespace vitrail {

int guarded(const Transport& transport, const std::function<int()>& job) {
  const std::string who =
      transport.size() > 1 ? fmt::format("rank {} of {}: ", transport.rank(), transport.size()) : "";
  try {
    return job();
  } catch (const OtherRankFailed& failed) {
    if (stop_signal()) return 128 + stop_signal();
    return failed.bad_input ? exit_bad_input : exit_machine;
  } catch (const Interrupted&) {
    throw;
  } catch (const AlreadySaid&) {
    throw;
  } catch (const Error& error) {
    throw Error(who + error.what(), error.location, error.excerpt);
  } catch (const UsageError& error) {
    throw UsageError(who + error.what());
  } catch (const std::bad_alloc&) {
    throw MachineError(who + "out of memory; a large picture is rendered in parts with --crop");
  } catch (const std::exception& error) {
    throw MachineError(who + error.what());
  }
}

}  // namespace vitrail
