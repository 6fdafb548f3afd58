// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "tests/support/command.h"

namespace vitrail::test {

// On so many ranks, by mpirun where there are several: mpirun and MPI_Init take .18 s of processor and .5 s
// of clock from one that is alone.
inline std::string vitrail_on(int ranks, const std::string& verb) {
  return ranks > 1 ? mpi_vitrail(verb, ranks) : vitrail(verb);
}

}  // namespace vitrail::test
