// SPDX-License-Identifier: Apache-2.0
// These functions measure what this process has taken of the machine so far.
#pragma once

#include <cstdint>

namespace vitrail {

double cpu_seconds();                 // of all threads, user's and system's
double thread_cpu_seconds();          // of this one
std::uint64_t peak_resident_bytes();  // at its highest
std::uint64_t resident_bytes();       // now

// Lets the system take back the pages of this program's and its libraries' code. They come again from its
// cache of files as they are run; what is resident is then what runs, whatever was read beside it or long
// ago.
void forget_code_pages();

}  // namespace vitrail
