// SPDX-License-Identifier: Apache-2.0
#include "cli/render/temporary_bundle.h"

#include "cli/common/run_program.h"
#include "farm/files/signals.h"
#include "farm/transport/agreement.h"

namespace vitrail {

TemporaryBundle::TemporaryBundle(Transport& transport, const std::filesystem::path& scene,
                                 std::filesystem::path bundle, const std::vector<std::string>& options)
    : transport_(transport), bundle_(std::move(bundle)) {
  catch_signals();
  agree(transport, [&] {
    if (transport.rank() != 0) return;
    std::vector<std::string> arguments{scene.string(), "-o", bundle_.string()};
    arguments.insert(arguments.end(), options.begin(), options.end());
    run_program("vitrail-partition", arguments, [] { return stop_signal() != 0; });
  });
}

TemporaryBundle::~TemporaryBundle() {
  std::error_code ignored;
  if (transport_.rank() == 0) std::filesystem::remove_all(bundle_, ignored);
}

}  // namespace vitrail
