// SPDX-License-Identifier: Apache-2.0
#include "tests/conformance/gate/pbrt_table.h"

#include <algorithm>
#include <array>

namespace vitrail::test::pbrt {

namespace {

#define SCREEN "frameaspectratio:f screenwindow:f4 lensradius:f focaldistance:f shutteropen:f shutterclose:f"
#define FILM                                                                                         \
  "xresolution:i yresolution:i pixelbounds:i4 cropwindow:f4 diagonal:f filename:s savefp16:b iso:f " \
  "whitebalance:f sensor:s maxcomponentvalue:f imagingratio:f"
#define MAPPING "mapping:s uscale:f vscale:f udelta:f vdelta:f v1:v v2:v"
#define IMAGE "filename:s wrap:s filter:s encoding:s scale:f invert:b maxanisotropy:f " MAPPING
#define ROUGH "roughness:ft uroughness:ft vroughness:ft remaproughness:b"
#define BUMPS "displacement:ft normalmap:s"
#define LAYERS "thickness:ft g:ft albedo:at maxdepth:i nsamples:i"
#define COEFFICIENTS "sigma_a:c sigma_s:c scale:f g:f"
#define BOX "p0:p p1:p"
#define GRID "nx:i ny:i nz:i " BOX

constexpr std::array table{
    Kind{"Camera", "perspective", "fov:f " SCREEN},
    Kind{"Camera", "orthographic", SCREEN},
    Kind{"Camera", "spherical", "mapping:s " SCREEN},
    Kind{"Film", "rgb", FILM},
    Kind{"Film", "gbuffer", "coordinatesystem:s " FILM},
    Kind{"Film", "spectral", "nbuckets:i lambdamin:f lambdamax:f " FILM},
    Kind{"PixelFilter", "box", "xradius:f yradius:f"},
    Kind{"PixelFilter", "triangle", "xradius:f yradius:f"},
    Kind{"PixelFilter", "gaussian", "xradius:f yradius:f sigma:f"},
    Kind{"PixelFilter", "mitchell", "xradius:f yradius:f B:f C:f"},
    Kind{"PixelFilter", "sinc", "xradius:f yradius:f tau:f"},
    Kind{"Sampler", "zsobol", "pixelsamples:i seed:i randomization:s"},
    Kind{"Integrator", "path", "maxdepth:i lightsampler:s regularize:b"},
    Kind{"Integrator", "volpath", "maxdepth:i lightsampler:s regularize:b"},

    Kind{"MakeNamedMedium", "homogeneous", "preset:s Le:c Lescale:f " COEFFICIENTS},
    Kind{"MakeNamedMedium", "uniformgrid",
         "density:f* temperature:f* Le:c Lescale:f* temperaturescale:f temperatureoffset:f "
         "temperaturecutoff:f " GRID " " COEFFICIENTS},
    Kind{"MakeNamedMedium", "rgbgrid", "sigma_a:g* sigma_s:g* Le:g* Lescale:f scale:f g:f " GRID},
    Kind{"MakeNamedMedium", "cloud", "density:f wispiness:f frequency:f sigma_a:c sigma_s:c g:f " BOX},
    Kind{"MakeNamedMedium", "nanovdb",
         "filename:s Lescale:f temperaturescale:f temperatureoffset:f temperaturecutoff:f " COEFFICIENTS},

    Kind{"float Texture", "constant", "value:f"},
    Kind{"float Texture", "scale", "tex:ft scale:ft"},
    Kind{"float Texture", "mix", "tex1:ft tex2:ft amount:ft"},
    Kind{"float Texture", "directionmix", "tex1:ft tex2:ft dir:v"},
    Kind{"float Texture", "bilerp", "v00:f v01:f v10:f v11:f " MAPPING},
    Kind{"float Texture", "imagemap", IMAGE},
    Kind{"float Texture", "checkerboard", "tex1:ft tex2:ft dimension:i " MAPPING},
    Kind{"float Texture", "dots", "inside:ft outside:ft " MAPPING},
    Kind{"float Texture", "fbm", "octaves:i roughness:f"},
    Kind{"float Texture", "wrinkled", "octaves:i roughness:f"},
    Kind{"float Texture", "windy", ""},
    Kind{"float Texture", "ptex", "filename:s encoding:s scale:f"},
    // Every texture of colours is made as an albedo too.
    Kind{"spectrum Texture", "constant", "value:a"},
    Kind{"spectrum Texture", "scale", "tex:at scale:ft"},
    Kind{"spectrum Texture", "mix", "tex1:at tex2:at amount:ft"},
    Kind{"spectrum Texture", "directionmix", "tex1:at tex2:at dir:v"},
    Kind{"spectrum Texture", "bilerp", "v00:a v01:a v10:a v11:a " MAPPING},
    Kind{"spectrum Texture", "imagemap", IMAGE},
    Kind{"spectrum Texture", "checkerboard", "tex1:at tex2:at dimension:i " MAPPING},
    Kind{"spectrum Texture", "dots", "inside:at outside:at " MAPPING},
    Kind{"spectrum Texture", "marble", "octaves:i roughness:f scale:f variation:f"},
    Kind{"spectrum Texture", "ptex", "filename:s encoding:s scale:f"},

    Kind{"Material", "diffuse", "reflectance:at " BUMPS},
    Kind{"Material", "dielectric", "eta:c|f " ROUGH " " BUMPS},
    Kind{"Material", "thindielectric", "eta:c|f " BUMPS},
    Kind{"Material", "conductor", "eta:ct k:ct reflectance:at " ROUGH " " BUMPS},
    Kind{"Material", "coateddiffuse", "reflectance:at eta:c|f " LAYERS " " ROUGH " " BUMPS},
    Kind{"Material", "coatedconductor",
         "interface.roughness:ft interface.uroughness:ft interface.vroughness:ft interface.eta:c|f "
         "conductor.roughness:ft conductor.uroughness:ft conductor.vroughness:ft conductor.eta:ct "
         "conductor.k:ct reflectance:at remaproughness:b " LAYERS " " BUMPS},
    Kind{"Material", "diffusetransmission", "reflectance:at transmittance:at scale:f " BUMPS},
    Kind{"Material", "subsurface",
         "name:s sigma_a:ct sigma_s:ct reflectance:at mfp:ct scale:f g:f eta:f " ROUGH " " BUMPS},
    Kind{"Material", "hair",
         "sigma_a:ct reflectance:at eumelanin:ft pheomelanin:ft eta:ft beta_m:ft beta_n:ft alpha:ft"},
    Kind{"Material", "measured", "filename:s " BUMPS},
    Kind{"Material", "interface", ""},
    Kind{"Material", "mix", "materials:s2 amount:ft"},

    Kind{"LightSource", "point", "I:c scale:f power:f from:p"},
    Kind{"LightSource", "spot", "I:c scale:f power:f from:p to:p coneangle:f conedeltaangle:f"},
    Kind{"LightSource", "projection", "filename:s scale:f power:f fov:f"},
    Kind{"LightSource", "goniometric", "I:c filename:s scale:f power:f"},
    Kind{"LightSource", "distant", "L:c scale:f illuminance:f from:p to:p"},
    Kind{"LightSource", "infinite", "L:c filename:s scale:f illuminance:f portal:p4"},
    Kind{"AreaLightSource", "diffuse", "L:c filename:s scale:f power:f twosided:b"},

    Kind{"Shape", "trianglemesh", "indices:i* P:p* N:n* S:v* uv:u* faceIndices:i* alpha:ft"},
    Kind{"Shape", "plymesh", "filename:s displacement:ft edgelength:f alpha:ft"},
    Kind{"Shape", "sphere", "radius:f zmin:f zmax:f phimax:f alpha:ft"},
    Kind{"Shape", "disk", "height:f radius:f innerradius:f phimax:f alpha:ft"},
    Kind{"Shape", "cylinder", "radius:f zmin:f zmax:f phimax:f alpha:ft"},
    Kind{"Shape", "curve",
         "P:p* type:s basis:s degree:i width:f width0:f width1:f N:n* splitdepth:i alpha:ft"},
};

constexpr std::array spectra{
    "glass-BK7",    "glass-BAF10",    "glass-FK51A",  "glass-LASF9",    "glass-F5",     "glass-F10",
    "glass-F11",    "metal-Ag-eta",   "metal-Ag-k",   "metal-Al-eta",   "metal-Al-k",   "metal-Au-eta",
    "metal-Au-k",   "metal-Cu-eta",   "metal-Cu-k",   "metal-CuZn-eta", "metal-CuZn-k", "metal-MgO-eta",
    "metal-MgO-k",  "metal-TiO2-eta", "metal-TiO2-k", "illum-acesD60",  "stdillum-A",   "stdillum-D50",
    "stdillum-D65", "stdillum-F1",    "stdillum-F2",  "stdillum-F3",    "stdillum-F4",  "stdillum-F5",
    "stdillum-F6",  "stdillum-F7",    "stdillum-F8",  "stdillum-F9",    "stdillum-F10", "stdillum-F11",
    "stdillum-F12"};

}  // namespace

std::span<const Kind> kinds() { return table; }

bool is_named_spectrum(std::string_view name) {
  return std::find(spectra.begin(), spectra.end(), name) != spectra.end();
}

}  // namespace vitrail::test::pbrt
