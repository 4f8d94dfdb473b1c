// One pole (a sector of 45 degrees) of a permanent-magnet machine: shaft, rotor with a magnet, air gap, stator with three slots.
// The nodes on the right cut are those on the left cut turned by the pole angle, bit for bit: periodic or antiperiodic conditions
// need no interpolation. The .msh file lists the pairs ($Periodic).
//   meshgen -2 geo/machine_sector.geo -o machine_sector.msh
p = Pi/4;                       // pole angle
r1 = 0.010; r2 = 0.028; r3 = 0.032; // shaft, foot of the magnet, rotor
gap = 0.001;
r4 = r3 + gap; r5 = 0.036; r6 = 0.046; r7 = 0.055; // bore, slot opening, slot bottom, stator
fine = gap/2; mid = 0.002; coarse = 0.004;

// Along the two cuts: points on the radii, line by line; right cut at angle 0, left cut at angle p.
Point(1) = {0, 0, 0, mid};
rad[] = {r1, r2, r3, r4, r7};
size[] = {mid, mid, fine, fine, coarse};
For k In {0:4}
  Point(10 + k) = {rad[k], 0, 0, size[k]};
  Point(20 + k) = {rad[k]*Cos(p), rad[k]*Sin(p), 0, size[k]};
EndFor
Line(10) = {1, 10};
Line(20) = {1, 20};
For k In {0:3}
  Line(11 + k) = {10 + k, 11 + k};
  Line(21 + k) = {20 + k, 21 + k};
EndFor
Periodic Curve {20:24} = {10:14} Rotate {{0, 0, 1}, {0, 0, 0}, p};

// Arcs from cut to cut.
For k In {0:4}
  Circle(30 + k) = {10 + k, 1, 20 + k};
EndFor

// The magnet stands on radius r2 and ends just below the rotor's surface.
ma = 0.15*p; mb = 0.85*p; rm = r3 - 0.0008;
Point(40) = {(r2 + 0.0005)*Cos(ma), (r2 + 0.0005)*Sin(ma), 0, mid/2};
Point(41) = {rm*Cos(ma), rm*Sin(ma), 0, mid/2};
Point(42) = {rm*Cos(mb), rm*Sin(mb), 0, mid/2};
Point(43) = {(r2 + 0.0005)*Cos(mb), (r2 + 0.0005)*Sin(mb), 0, mid/2};
Line(40) = {40, 41};
Circle(41) = {41, 1, 42};
Line(42) = {42, 43};
Circle(43) = {43, 1, 40};
Curve Loop(44) = {40:43};
Plane Surface(44) = {44};

// Three slots, closed towards the gap.
slots[] = {};
For k In {0:2}
  a = p*(k + 0.25)/3; b = p*(k + 0.75)/3; s = 50 + 10*k;
  Point(s)     = {r5*Cos(a), r5*Sin(a), 0, mid};
  Point(s + 1) = {r6*Cos(a), r6*Sin(a), 0, mid};
  Point(s + 2) = {r6*Cos(b), r6*Sin(b), 0, mid};
  Point(s + 3) = {r5*Cos(b), r5*Sin(b), 0, mid};
  Line(s) = {s, s + 1};
  Circle(s + 1) = {s + 1, 1, s + 2};
  Line(s + 2) = {s + 2, s + 3};
  Circle(s + 3) = {s + 3, 1, s};
  Curve Loop(s) = {s:s + 3};
  Plane Surface(s) = {s};
  slots[] += s;
EndFor

Curve Loop(1) = {10, 30, -20};          Plane Surface(1) = {1};           // shaft
Curve Loop(2) = {11, 31, -21, -30};     Plane Surface(2) = {2};           // rotor yoke
Curve Loop(3) = {12, 32, -22, -31};     Plane Surface(3) = {3, 44};       // rotor around the magnet
Curve Loop(4) = {13, 33, -23, -32};     Plane Surface(4) = {4};           // air gap
Curve Loop(5) = {14, 34, -24, -33};     Plane Surface(5) = {5, slots[]};  // stator

Physical Surface("shaft") = {1};
Physical Surface("rotor") = {2, 3};
Physical Surface("magnet") = {44};
Physical Surface("gap") = {4};
Physical Surface("stator") = {5};
Physical Surface("coils") = {slots[]};
Physical Curve("right cut") = {10:14};
Physical Curve("left cut") = {20:24};
Physical Curve("rim") = {34};
