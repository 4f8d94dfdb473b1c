// A square plate with a circular hole, in four transfinite blocks around it (an O-grid): quadrangles only, graded towards the hole.
//   meshgen -2 geo/plate_hole.geo -o plate_hole.msh
a = 2;    // half the side of the plate
r = 0.5;  // radius of the hole
n = 12;   // elements along a quarter of the hole
m = 16;   // elements from the hole to the rim
q = 1.12; // growth of the elements outwards

Point(1) = {0, 0, 0};
For k In {0:3}
  t = Pi/4 + k*Pi/2;
  Point(10 + k) = {r*Cos(t), r*Sin(t), 0};
  Point(20 + k) = {a*Sqrt(2)*Cos(t), a*Sqrt(2)*Sin(t), 0};
  Line(30 + k) = {10 + k, 20 + k}; // spokes, outwards
EndFor
For k In {0:3}
  next = (k + 1) % 4;
  Circle(40 + k) = {10 + k, 1, 10 + next};
  Line(50 + k) = {20 + k, 20 + next};
  Curve Loop(60 + k) = {30 + k, 50 + k, -(30 + next), -(40 + k)};
  Plane Surface(70 + k) = {60 + k};
EndFor

Transfinite Curve{30:33} = m + 1 Using Progression q;
Transfinite Curve{40:43, 50:53} = n + 1;
Transfinite Surface{70:73};
Recombine Surface{70:73};

Physical Curve("hole") = {40:43};
Physical Curve("rim") = {50:53};
Physical Surface("plate") = {70:73};
