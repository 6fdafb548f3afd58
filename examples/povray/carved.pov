// SPDX-License-Identifier: Apache-2.0
// Sets of solids, and a surface that is a formula. For POV-Ray 3.7 and for Vitrail.
#version 3.7;
global_settings { assumed_gamma 1.0 }

camera { location <-0.1, 3.2, -7.6> look_at <-0.1, 0.7, 0> right x*4/3 angle 42 }
light_source { <-5, 8, -6> color rgb 1 }
light_source { <6, 4, -5> color rgb <0.3, 0.32, 0.4> shadowless }
background { color rgb <0.35, 0.45, 0.6> }
plane { y, 0 pigment { color rgb <0.6, 0.58, 0.5> } finish { ambient 0.1 diffuse 0.6 } }

#default { finish { ambient 0.12 diffuse 0.7 } }

// A die: a cube with its corners off, without its spots.
#macro Spots(N, Turn)
  union {
    #if (mod(N, 2) = 1) sphere { <0, 0, -0.75>, 0.16 } #end
    #if (N > 1) sphere { <-0.4, 0.4, -0.75>, 0.16 } sphere { <0.4, -0.4, -0.75>, 0.16 } #end
    #if (N > 3) sphere { <0.4, 0.4, -0.75>, 0.16 } sphere { <-0.4, -0.4, -0.75>, 0.16 } #end
    #if (N = 6) sphere { <-0.4, 0, -0.75>, 0.16 } sphere { <0.4, 0, -0.75>, 0.16 } #end
    rotate Turn
  }
#end
difference {
  intersection { box { -0.75, 0.75 } sphere { 0, 1.05 } }
  Spots(1, 0)
  Spots(6, 180*y)
  Spots(2, 90*x)
  Spots(5, -90*x)
  Spots(3, 90*y)
  Spots(4, -90*y)
  pigment { color rgb <0.8, 0.12, 0.1> }
  rotate <0, 30, 0>
  translate <-2, 0.75, 0>
}

// A gyroid, cut by a ball.
#declare Gyroid = function(x, y, z) { sin(x)*cos(y) + sin(y)*cos(z) + sin(z)*cos(x) }
isosurface {
  function { abs(Gyroid(7*x, 7*y, 7*z)) - 0.45 }
  contained_by { sphere { 0, 0.95 } }
  max_gradient 16
  open
  pigment { color rgb <0.85, 0.65, 0.2> }
  translate 0.95*y
}

// Two rings through each other, and the ball that both lie in, clipped.
merge {
  torus { 0.6, 0.14 }
  torus { 0.6, 0.14 rotate 90*x translate 0.6*x }
  pigment { color rgb <0.25, 0.55, 0.35> }
  rotate <-20, 20, 0>
  translate <1.7, 0.95, 0>
}
