// SPDX-License-Identifier: Apache-2.0
// These functions serve formats that state the coefficients of media on grids in another form.
#pragma once

#include <functional>

#include "scene/records/medium.h"

namespace vitrail {

// Returns the grid with its values in memory; it reads those of Mitsuba's volume files and of NanoVDB. Throws
// Error where the file is too short, is not there, or is of another kind.
Grid with_values(const Grid& grid);

// Returns f(a, b) in each cell of the finer of two, the other one linear in between; at least one is a grid.
// It has three channels of linear sRGB, or one where both are numbers. Throws Error as with_values does.
Grid combined_cells(const VolumeParameter& a, const VolumeParameter& b,
                    const std::function<double(double, double)>& f);

// Returns the grid with one layer of cells more on every side, beyond its bounds: of 0, or as the edge is.
Grid with_cells_around(const Grid& grid, bool zero);

// Returns whether combined_cells loses something of it: a spectrum that is neither a colour nor a number.
bool becomes_color(const VolumeParameter& value);

}  // namespace vitrail
