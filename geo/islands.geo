// islands.geo - a round island in the bay of another, a hair apart: edges of the 1D mesh cross in the strait (Figure 4.3 of the
// textbook) and are split until none does. `meshgen -1 -v 4 geo/islands.geo` tells the rounds.
// Try narrower straits: -setnumber gap 0.001

DefineConstant[ gap = 0.02 ];  // width of the strait; the islands have size 1
lc = 0.8;                      // far too coarse for the strait
bay = 80 * Pi/180;             // half the opening angle of the bay
tilt = 0.35;                   // turns the round island, so that its nodes do not face those of the bay

// The round island
Point(10) = {0, 0, 0, lc};
For k In {1:4}
  Point(10 + k) = {Cos(tilt + k*Pi/2), Sin(tilt + k*Pi/2), 0, lc};
EndFor
For k In {1:4}
  Circle(10 + k) = {10 + k, 10, 11 + k%4};
EndFor
Curve Loop(1) = {11:14};
Plane Surface(1) = {1};

// The other one: a sickle between the radii r and R
r = 1 + gap;
R = 1.8;
Point(20) = {r*Cos(bay), -r*Sin(bay), 0, lc};
Point(21) = {r, 0, 0, lc};
Point(22) = {r*Cos(bay), r*Sin(bay), 0, lc};
Point(23) = {R*Cos(bay), R*Sin(bay), 0, lc};
Point(24) = {R, 0, 0, lc};
Point(25) = {R*Cos(bay), -R*Sin(bay), 0, lc};
Circle(20) = {20, 10, 21};
Circle(21) = {21, 10, 22};
Line(22) = {22, 23};
Circle(23) = {23, 10, 24};
Circle(24) = {24, 10, 25};
Line(25) = {25, 20};
Curve Loop(2) = {20:25};
Plane Surface(2) = {2};

// The pond around them
Point(1) = {-3, -3, 0, lc};
Point(2) = {4, -3, 0, lc};
Point(3) = {4, 3, 0, lc};
Point(4) = {-3, 3, 0, lc};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(3) = {1:4};
Plane Surface(3) = {3, 1, 2};

Physical Surface("islands", 1) = {1, 2};
Physical Surface("pond", 2) = {3};
