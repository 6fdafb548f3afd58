// SPDX-License-Identifier: Apache-2.0
// Patterns without noise, each on a ball: they show the same colours in POV-Ray and in Vitrail.
// For POV-Ray 3.7 and for Vitrail.
#version 3.7;
global_settings { assumed_gamma 1.0 }

camera { orthographic location <0, 0, -10> look_at 0 right 8*x up 6*y }
light_source { <-20, 30, -40> color rgb 1 }
background { color rgb 0.2 }
#default { finish { ambient 0.15 diffuse 0.75 } }

#declare Warm = color_map { [0 color rgb <0.15, 0.05, 0.25>] [0.5 color rgb <0.9, 0.45, 0.1>] [1 color rgb <1, 0.95, 0.7>] }
#declare Cool = color_map { [0 color rgb <0.02, 0.1, 0.2>] [0.6 color rgb <0.2, 0.6, 0.7>] [0.6 color rgb <0.9, 0.9, 0.9>] [1 color rgb <0.3, 0.3, 0.5>] }

#declare Pigments = array[12] {
  pigment { checker color rgb <0.9, 0.9, 0.85>, color rgb <0.1, 0.2, 0.4> scale 0.4 }
  pigment { brick color rgb 0.8, color rgb <0.6, 0.15, 0.1> scale 0.1 }
  pigment { hexagon color rgb <0.9, 0.2, 0.2>, color rgb <0.2, 0.8, 0.3>, color rgb <0.2, 0.3, 0.9> rotate 90*x scale 0.25 }
  pigment { gradient x color_map { Warm } scale 0.5 }
  pigment { wood color_map { Warm } scale 0.35 rotate 25*y }
  pigment { onion color_map { Cool } scale 0.3 translate <0.3, 0.2, -0.6> }
  pigment { leopard color_map { Cool } scale 0.12 }
  pigment { radial color_map { Warm } frequency 6 rotate 90*x }
  pigment { spiral1 3 color_map { Cool } scale 0.6 }
  pigment { marble color_map { Warm } scale 0.4 rotate 45*z triangle_wave }
  pigment { boxed color_map { Cool } scale 0.9 frequency 3 }
  pigment { cylindrical color_map { Warm } rotate 90*x scale 0.8 frequency 2 }
}

#for (I, 0, 11)
  sphere {
    0, 0.85
    pigment { Pigments[I] }
    translate <(mod(I, 4) - 1.5)*1.95, (1 - div(I, 4))*1.95, 0>
  }
#end
