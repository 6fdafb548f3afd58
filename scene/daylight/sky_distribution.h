// SPDX-License-Identifier: Apache-2.0
// These are skies that are not clear: the fifteen of the CIE, and those that two measured numbers give.
#pragma once

#include "scene/daylight/sun_position.h"
#include "scene/records/light.h"

namespace vitrail {

// It holds a sky and its sun as they are measured. Below the horizon the sun gives no light.
struct MeasuredSky {
  SkyDistribution distribution;  // with its horizontal illuminance
  double direct_normal_lx = 0;   // of the sun, across its direction
};

// They return the two factors of a sky's brightness relative to another direction. gradient_of takes the
// cosine of the angle from the zenith, which as in sky_model.h ends at 0.01; scattering_of takes that of the
// angle from the sun.
double gradient_of(const SkyDistribution& sky, double cosine);
double scattering_of(const SkyDistribution& sky, double sun_cosine);

// Returns the sky of this type, 1 … 15, of the standard ISO 15469:2004 (CIE S 011). Its illuminance is the
// mean that the IESNA gives (RP-21-84; Lighting Handbook, 9th ed. 2000, chapter 8) for the sun's height:
// overcast for the types 1 to 5, which have no sun, partly cloudy to 10, clear beyond.
MeasuredSky cie_sky(int type, const SunPosition& sun, const LocalTime& time);

// Returns the all-weather sky of Perez, Seals and Michalsky ("All-weather model for sky luminance
// distribution", Solar Energy 50, 1993) under these irradiances, W/m²: of the sun across its direction, and
// of the sky on a horizontal plane. Illuminances follow from the efficacies of Perez et al. ("Modeling
// daylight availability and irradiance components from direct and global irradiance", Solar Energy 44, 1990),
// with 2 cm of water in the air. The bounds of the clearness and brightness are those of Radiance's
// gendaylit.
MeasuredSky perez_sky(double direct_normal_w, double diffuse_horizontal_w, const SunPosition& sun,
                      const LocalTime& time);
// Returns the same for illuminances, lx: the irradiances are those whose efficacies give them.
MeasuredSky perez_sky_of_lux(double direct_normal_lx, double diffuse_horizontal_lx, const SunPosition& sun,
                             const LocalTime& time);

}  // namespace vitrail
