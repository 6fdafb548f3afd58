// SPDX-License-Identifier: Apache-2.0
// A room with a checkered floor, a lamp that is a ball, a glass of water and a mirror ball.
// Units are metres, y is up. For POV-Ray 3.7 and for Vitrail.
#version 3.7;
global_settings { assumed_gamma 1.0 max_trace_level 8 }

camera {
  location <0, 1.4, -3.4>
  look_at <0, 1.1, 0>
  right x*4/3
  angle 58
}

// The bulb is seen, and its light passes through it. Its light falls off with the square of the distance.
#declare Bulb = <0.1, 2.35, -0.3>;
light_source {
  Bulb
  color rgb <2.2, 2.0, 1.7>
  fade_distance 1.6
  fade_power 2
  looks_like {
    sphere { 0, 0.12 pigment { color rgb <1, 0.95, 0.8> } finish { ambient 0 diffuse 0 emission 1 } }
  }
}
// The cord of the lamp.
cylinder { <0.1, 2.47, -0.3>, <0.1, 3, -0.3>, 0.01 pigment { color rgb 0.05 } finish { ambient 0 diffuse 0.6 } }

// Floor, ceiling and walls: a box that is seen from inside.
box {
  <-2.5, 0, -5>, <2.5, 3, 2>
  inverse
  pigment { color rgb <0.75, 0.72, 0.66> }
  finish { ambient 0.06 diffuse 0.7 }
}
box {
  <-2.5, 0, -5>, <2.5, 0.001, 2>
  pigment { checker color rgb <0.85, 0.85, 0.8>, color rgb <0.12, 0.16, 0.25> scale 0.5 }
  finish { ambient 0.05 diffuse 0.75 }
}

// A table: a top and four legs, put where a loop says.
#macro Leg(X, Z) cylinder { <X, 0, Z>, <X, 0.7, Z>, 0.035 } #end
union {
  box { <-0.9, 0.7, -0.45>, <0.9, 0.75, 0.45> }
  #for (I, 0, 3)
    Leg((mod(I, 2) - 0.5)*1.6, (div(I, 2) - 0.5)*0.7)
  #end
  pigment { color rgb <0.45, 0.27, 0.14> }
  finish { ambient 0.04 diffuse 0.7 }
}

// A tumbler: what is outside without what is inside.
difference {
  cone { <-0.4, 0.751, -0.1>, 0.11, <-0.4, 1.1, -0.1>, 0.15 }
  cone { <-0.4, 0.78, -0.1>, 0.10, <-0.4, 1.11, -0.1>, 0.142 }
  pigment { color rgbf <0.97, 1, 0.98, 0.95> }
  finish { ambient 0 diffuse 0 reflection { 0, 1 fresnel } conserve_energy }
  interior { ior 1.5 }
}

// A ball of metal, and one that is painted.
sphere {
  <0.35, 0.95, 0.05>, 0.2
  pigment { color rgb <0.9, 0.9, 0.92> }
  finish { ambient 0 diffuse 0.05 reflection 0.85 }
}
sphere { <0.02, 0.83, -0.28>, 0.08 pigment { color rgb <0.7, 0.08, 0.06> } finish { ambient 0.05 diffuse 0.75 } }
