// SPDX-License-Identifier: Apache-2.0
// TERM and INT ask a rank to stop cleanly, USR1 to write a checkpoint and go on.
#pragma once

namespace vitrail {

void catch_signals();
// USR1 alone, which would end a program that does not know it: for its first moment. The checkpoint is
// written once there is a job.
void catch_checkpoint_signal();
// The first of TERM and INT that came; 0: none did.
int stop_signal();
// As a TERM that came.
void ask_to_stop();
// True once for each USR1 (or several in one).
bool take_checkpoint_signal();

}  // namespace vitrail
