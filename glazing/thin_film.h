// SPDX-License-Identifier: Apache-2.0
// This file computes interference in thin films, and sheets too thick for it between them.
#pragma once

#include <complex>
#include <span>

#include "glazing/pane.h"

namespace vitrail {

// They are fractions of the power that an interface reflects and transmits, from the
// first medium to the last and back.
struct InterfaceValues {
  double r = 0, t = 0, r_back = 0, t_back = 0;
};

struct FilmAt {
  std::complex<double> index;  // n − ik
  double thickness_nm = 0;
};

// Returns the values of films between two media, by the product of their characteristic matrices (Abelès
// 1950; Born & Wolf, ch. 1.6; Macleod, "Thin-Film Optical Filters", ch. 2). `sine` is n·sin θ, the same in
// all media; media that light comes from count as transparent. `parallel` is the p polarisation.
InterfaceValues film_stack(double n_first, std::span<const FilmAt> films, std::complex<double> n_last,
                           double sine, double nm, bool parallel);

// Returns a pane in air, for one polarisation: films coherent, slabs by the sum of all inner reflections.
PaneValues stack_values(const StackPane& stack, double nm, double cosine, bool parallel);

}  // namespace vitrail
