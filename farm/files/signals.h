// SPDX-License-Identifier: Apache-2.0
// TERM and INT ask a rank to stop cleanly, USR1 to write a checkpoint and go on.
#pragma once

namespace vitrail {

void catch_signals();
// Catches USR1 alone, which would end a program that does not know it: for its first moment. The checkpoint
// is written once there is a job.
void catch_checkpoint_signal();
// Returns the first of TERM and INT that came; 0 where none did.
int stop_signal();
// Acts as a TERM that came.
void ask_to_stop();
// Returns true once for each USR1 (or several in one).
bool take_checkpoint_signal();

}  // namespace vitrail
