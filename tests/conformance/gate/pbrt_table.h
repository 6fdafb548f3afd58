// SPDX-License-Identifier: Apache-2.0
// What pbrt-v4 (commit 5f7a6068) takes: for each directive and kind its parameters and what each may be.
#pragma once

#include <span>
#include <string_view>

namespace vitrail::test::pbrt {

// `parameters` is a list of NAME:TYPE. A type is one letter, and what may follow it:
//   f float   i integer   b bool   s string   p point3   v vector3   n normal   u point2
//   c any colour or spectrum   a one that is an albedo: an rgb of at most 1   g rgb alone
//   *    any number of them (else one); 2, 4: so many
//   t    or a texture of the kind (f: of numbers; c, a: of colours)
//   c|f  a spectrum or one number
struct Kind {
  std::string_view directive, kind, parameters;
};
std::span<const Kind> kinds();

// The spectra that pbrt has by name.
bool is_named_spectrum(std::string_view name);

}  // namespace vitrail::test::pbrt
