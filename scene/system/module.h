// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace vitrail {

// Loads a module of ours, which takes libraries that most runs do without, and returns what `symbol` names in
// it. The module lies beside this program; for a program that is not ours, it lies where ours are installed.
// `what_for` completes "which …", as "reads images". Throws MachineError where the module is missing or
// cannot be loaded.
void* module_symbol(const std::string& module, const char* symbol, const char* what_for);

}  // namespace vitrail
