// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace vitrail {

// Makes a crash of this process (BUS, SEGV, FPE, ILL, ABRT) look whether a watched file has changed in place
// (bundle/watched_files.h): then it ends with status 3 and the file's name. Where a mapped file cannot be
// read any more (BUS) it ends with 4 and that file's name; else as it would have without us.
void catch_crashes();

}  // namespace vitrail
