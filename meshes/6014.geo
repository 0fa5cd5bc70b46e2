// A recipe for gmsh: the section of a 6014 deep-groove bearing in its housing, coarse. Lengths in metres, x along the axis, y the radius.
// rotordrop takes it as it is (thermal.fe.mesh = "6014.geo"), or what gmsh makes of it: gmsh -2 6014.geo -o 6014.msh
// Change the numbers; keep the names of the groups.
W = 20e-3;               // width of the rings
L = 25e-3;               // length of the housing
bore = 35e-3;  shoulder_in = 41.45e-3;  shoulder_out = 48.6e-3;  fit = 55e-3;  outside = 65e-3;   // radii
d = 11.906e-3;  pitch = 45e-3;  R = 0.52 * d;                      // ball diameter, pitch radius, groove radius
a = 0.4e-3;              // half width of the strip along the arc
centre_in = pitch + R - d/2;  centre_out = pitch - R + d/2;        // of the grooves
e_in = Acos((centre_in - shoulder_in)/R);  e_out = Acos((shoulder_out - centre_out)/R);   // angle of the groove's edge
s = a/R;

// Columns: face, groove edge, strip, strip, groove edge, face.
xi[] = {-W/2, -R*Sin(e_in), -R*Sin(s), R*Sin(s), R*Sin(e_in), W/2};
ri[] = {shoulder_in, shoulder_in, centre_in - R*Cos(s), centre_in - R*Cos(s), shoulder_in, shoulder_in};
xo[] = {-W/2, -R*Sin(e_out), -R*Sin(s), R*Sin(s), R*Sin(e_out), W/2};
ro[] = {shoulder_out, shoulder_out, centre_out + R*Cos(s), centre_out + R*Cos(s), shoulder_out, shoulder_out};
n[] = {4, 5, 2, 5, 4};           // cells along each column
grow[] = {0.8, 0.75, 1, 1/0.75, 1/0.8};

Point(1) = {0, centre_in, 0};
Point(2) = {0, centre_out, 0};
For i In {0:5}
  Point(10 + i) = {xi[i], bore, 0};   Point(20 + i) = {xi[i], ri[i], 0};      // inner ring
  Point(30 + i) = {xo[i], ro[i], 0};  Point(40 + i) = {xo[i], fit, 0};        // outer ring
  Point(50 + i) = {xo[i], fit, 0};    Point(60 + i) = {xo[i], outside, 0};    // housing, with points of its own
  Line(110 + i) = {10 + i, 20 + i};   Transfinite Curve {110 + i} = 15 Using Bump 0.06;
  Line(130 + i) = {30 + i, 40 + i};   Transfinite Curve {130 + i} = 10 Using Progression 1.5;
  Line(150 + i) = {50 + i, 60 + i};   Transfinite Curve {150 + i} = 6;
EndFor
For i In {0:4}
  Line(210 + i) = {10 + i, 11 + i};
  Line(240 + i) = {40 + i, 41 + i};
  Line(250 + i) = {50 + i, 51 + i};
  Line(260 + i) = {60 + i, 61 + i};
  If (i == 0 || i == 4)
    Line(220 + i) = {20 + i, 21 + i};
    Line(230 + i) = {30 + i, 31 + i};
  Else
    Circle(220 + i) = {20 + i, 1, 21 + i};
    Circle(230 + i) = {30 + i, 2, 31 + i};
  EndIf
  Transfinite Curve {210 + i, 220 + i, 230 + i, 240 + i, 250 + i, 260 + i} = n[i] + 1 Using Progression grow[i];
  Curve Loop(310 + i) = {210 + i, 111 + i, -(220 + i), -(110 + i)};  Plane Surface(310 + i) = {310 + i};
  Curve Loop(330 + i) = {230 + i, 131 + i, -(240 + i), -(130 + i)};  Plane Surface(330 + i) = {330 + i};
  Curve Loop(350 + i) = {250 + i, 151 + i, -(260 + i), -(150 + i)};  Plane Surface(350 + i) = {350 + i};
EndFor
// The housing beyond the ring.
Point(70) = {-L/2, fit, 0};  Point(71) = {-L/2, outside, 0};  Point(72) = {L/2, fit, 0};  Point(73) = {L/2, outside, 0};
Line(170) = {70, 71};  Line(171) = {72, 73};  Transfinite Curve {170, 171} = 6;
Line(270) = {70, 50};  Line(271) = {71, 60};  Line(272) = {55, 72};  Line(273) = {65, 73};  Transfinite Curve {270:273} = 3;
Curve Loop(370) = {270, 150, -271, -170};  Plane Surface(370) = {370};
Curve Loop(371) = {272, 171, -273, -155};  Plane Surface(371) = {371};

Transfinite Surface {310:314, 330:334, 350:354, 370, 371};
Recombine Surface {310:314, 330:334, 350:354, 370, 371};

Physical Surface("inner_ring") = {310:314};
Physical Surface("outer_ring") = {330:334};
Physical Surface("housing") = {350:354, 370, 371};
Physical Curve("inner_ring.inner") = {210:214};
Physical Curve("inner_ring.outer") = {220, 224};
Physical Curve("inner_ring.raceway_1") = {221, 223};
Physical Curve("inner_ring.strip_1") = {222};
Physical Curve("inner_ring.left") = {110};
Physical Curve("inner_ring.right") = {115};
Physical Curve("outer_ring.inner") = {230, 234};
Physical Curve("outer_ring.raceway_1") = {231, 233};
Physical Curve("outer_ring.strip_1") = {232};
Physical Curve("outer_ring.outer") = {240:244};
Physical Curve("outer_ring.left") = {130};
Physical Curve("outer_ring.right") = {135};
Physical Curve("housing.inner") = {250:254, 270, 272};
Physical Curve("housing.outer") = {260:264, 271, 273};
Physical Curve("housing.left") = {170};
Physical Curve("housing.right") = {171};
