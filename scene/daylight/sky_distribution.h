// SPDX-License-Identifier: Apache-2.0
// Skies that are not clear: the fifteen of the CIE, and those that two measured numbers tell.
#pragma once

#include "scene/daylight/sun_position.h"
#include "scene/records/light.h"

namespace vitrail {

// A sky and its sun as they are measured. Below the horizon the sun gives none.
struct MeasuredSky {
  SkyDistribution distribution;  // with its horizontal illuminance
  double direct_normal_lx = 0;   // of the sun, across its direction
};

// The two factors of how bright a sky is in one direction beside another: by the cosine of the angle from the
// zenith, which as in sky_model.h ends at 0.01, and by that of the angle from the sun.
double gradient_of(const SkyDistribution& sky, double cosine);
double scattering_of(const SkyDistribution& sky, double sun_cosine);

// The sky of this type, 1 … 15, of the standard ISO 15469:2004 (CIE S 011). Its illuminance is the mean that
// the IESNA gives (RP-21-84; Lighting Handbook, 9th ed. 2000, chapter 8) for the sun's height: overcast for
// the types 1 to 5, which have no sun, partly cloudy to 10, clear beyond.
MeasuredSky cie_sky(int type, const SunPosition& sun, const LocalTime& time);

// The all-weather sky of Perez, Seals and Michalsky ("All-weather model for sky luminance distribution",
// Solar Energy 50, 1993) under these irradiances, W/m²: of the sun across its direction, and of the sky on a
// horizontal plane. Illuminances follow from the efficacies of Perez et al. ("Modeling daylight availability
// and irradiance components from direct and global irradiance", Solar Energy 44, 1990), with 2 cm of water in
// the air. The bounds of the clearness and brightness are those of Radiance's gendaylit.
MeasuredSky perez_sky(double direct_normal_w, double diffuse_horizontal_w, const SunPosition& sun,
                      const LocalTime& time);
// The same by illuminances, lx: the irradiances are those whose efficacies give them.
MeasuredSky perez_sky_of_lux(double direct_normal_lx, double diffuse_horizontal_lx, const SunPosition& sun,
                             const LocalTime& time);

}  // namespace vitrail
