// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

namespace vitrail::test {

// Calls add(format, bytes) with the files of a small bundle, a profile and films.
void add_bundle_seeds(const std::function<void(const char*, const std::string&)>& add);

}  // namespace vitrail::test
