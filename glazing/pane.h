// SPDX-License-Identifier: Apache-2.0
// A Pane is one pane at any angle: by measurements at normal incidence, or by its layers.
#pragma once

#include <variant>
#include <vector>

#include "glazing/optical_rows.h"
#include "glazing/product.h"

namespace vitrail {

// They are for the electric field perpendicular (s) and parallel (p) to the plane of incidence.
struct PolarisedValues {
  PaneValues s, p;
};
PaneValues mean(const PolarisedValues& v);

// Returns values of homogeneous glass with known T and R at normal incidence. The index follows from R and T
// by the infinite series of inner reflections, the absorption from T. Fresnel's equations and the longer path
// in the glass then give every angle. Furler, "Angular dependence of optical properties of homogeneous
// glasses", ASHRAE Transactions 97 (1991); Finlayson et al., "WINDOW 4.0: documentation of calculation
// procedures", LBL-33943 (1993). Each face takes the index of its own reflectance.
PolarisedValues clear_glass(PaneValues normal, double cosine);

// Returns the index that clear_glass finds: real index n and extinction k of the glass.
IndexRow clear_glass_index(double nm, double t, double r, double thickness_mm);

// Returns values of any other pane that is measured at normal incidence alone. Their curves have the shape of
// 3 mm clear (T > 0.645) or bronze glass, polynomials in the cosine, whatever the polarisation (Finlayson et
// al. 1993, table of "polynomial coefficients"). T of each wavelength decides, as in WINDOW's engine.
PaneValues coated_glass(PaneValues normal, double cosine);

struct MeasuredPane {
  OpticalRows rows;
  PaneKind kind = PaneKind::clear;
  OpticalRows scattered{};  // the part of `rows` that leaves in all directions (system.h); values_at has all
};

// Slabs are thick sheets that light passes without interference; coherent films lie on their faces, from
// outside. All are in optical contact: a laminate is several slabs, a coated glass one with films.
struct FilmLayer {
  IndexRows index;
  double thickness_nm = 0;
};
struct Slab {
  IndexRows index;
  double thickness_mm = 0;
};
struct StackPane {
  std::vector<Slab> slabs;                    // at least one
  std::vector<std::vector<FilmLayer>> films;  // before, between and behind the slabs: one more than slabs
};

using Pane = std::variant<MeasuredPane, StackPane>;

// Returns values in air, for `cosine` of the incidence in [0, 1]; up to 1e-6 all light is reflected.
PolarisedValues values_at(const Pane& pane, double nm, double cosine);

// Returns the wavelengths that a pane is given at, ascending: those of its rows; for layers 300 to
// 2500 nm, whatever their tables hold.
std::vector<double> wavelengths_of(const Pane& pane);

// Returns the range of the data, beyond which values are held. It is between the ends of its rows, or of all
// tables of its layers (a table of one row is a constant and has no ends).
WavelengthRange range_of(const Pane& pane);

// Makes a pane of a product with rows, or with an index where `thickness_mm` (or the product's
// own) is above 0. Throws Error.
Pane pane_of(const Product& product, double thickness_mm = 0);

}  // namespace vitrail
