// conge.geo - two plane faces that share an interface: 25 points, 20 curves (7 of them circle arcs)
// The running example of the textbook (Figures 4.1, 4.4, 4.8, 4.9). Try: meshgen -2 geo/conge.geo -clscale 0.3
// About 11,000 triangles as it stands; the cover (face 22) is a hole of the body (face 24) filled again.

u = 1;          // unit of length
e1 = 4.5 * u;   // half width of the foot beyond the legs
e2 = 3 * u;     // half distance of the legs
e3 = 2.5 * u;   // half width of the tower
h1 = 5 * u;     // height of the foot
h2 = 10 * u;    // height of the tower
h3 = 5 * u;     // foot of the slot above the foot
h4 = 2 * u;     // height of the slot's straight part
h5 = 4.5 * u;   // height of the arch's centre
R1 = 1 * u;     // radius of the arch
R2 = 1.5 * u;   // radius of the slot
r = 1 * u;      // radius of the fillets

// The legs touch the arch tangentially: angle of the tangent points seen from the arch's centre.
c = (-h5 * R1 + e2 * Sqrt(h5^2 + e2^2 - R1^2)) / (h5^2 + e2^2);
s = Sqrt(1 - c^2);

Lc1 = 0.3 * u;  // mesh size far away
Lc2 = 0.1 * u;  // mesh size at the arcs

Point(1) = {-e1 - e2, 0, 0, Lc1};
Point(2) = {-e1 - e2, h1, 0, Lc1};
Point(3) = {-e3 - r, h1, 0, Lc2};
Point(4) = {-e3 - r, h1 + r, 0, Lc2};
Point(5) = {-e3, h1 + r, 0, Lc2};
Point(6) = {-e3, h1 + h2, 0, Lc1};
Point(7) = {e3, h1 + h2, 0, Lc1};
Point(8) = {e3, h1 + r, 0, Lc2};
Point(9) = {e3 + r, h1 + r, 0, Lc2};
Point(10) = {e3 + r, h1, 0, Lc2};
Point(11) = {e1 + e2, h1, 0, Lc1};
Point(12) = {e1 + e2, 0, 0, Lc1};
Point(13) = {e2, 0, 0, Lc1};
Point(14) = {R1 / s, h5 + R1 * c, 0, Lc2};
Point(15) = {0, h5, 0, Lc2};
Point(16) = {-R1 / s, h5 + R1 * c, 0, Lc2};
Point(17) = {-e2, 0, 0, Lc1};
Point(18) = {-R2, h1 + h3, 0, Lc2};
Point(19) = {-R2, h1 + h3 + h4, 0, Lc2};
Point(20) = {0, h1 + h3 + h4, 0, Lc2};
Point(21) = {R2, h1 + h3 + h4, 0, Lc2};
Point(22) = {R2, h1 + h3, 0, Lc2};
Point(23) = {0, h1 + h3, 0, Lc2};
Point(24) = {0, h1 + h3 + h4 + R2, 0, Lc2};
Point(25) = {0, h1 + h3 - R2, 0, Lc2};

// Outer boundary of the body
Line(1) = {1, 17};
Line(2) = {17, 16};
Circle(3) = {14, 15, 16};
Line(4) = {14, 13};
Line(5) = {13, 12};
Line(6) = {12, 11};
Line(7) = {11, 10};
Circle(8) = {8, 9, 10};
Line(9) = {8, 7};
Line(10) = {7, 6};
Line(11) = {6, 5};
Circle(12) = {3, 4, 5};
Line(13) = {3, 2};
Line(14) = {2, 1};

// Interface between body and cover: a slot with round ends
Line(15) = {18, 19};
Circle(16) = {21, 20, 24};
Circle(17) = {24, 20, 19};
Circle(18) = {18, 23, 25};
Circle(19) = {25, 23, 22};
Line(20) = {21, 22};

Curve Loop(21) = {17, -15, 18, 19, -20, 16};
Plane Surface(22) = {21};
Curve Loop(23) = {11, -12, 13, 14, 1, 2, -3, 4, 5, 6, 7, -8, 9, 10};
Plane Surface(24) = {23, 21};

Physical Surface("cover", 1) = {22};
Physical Surface("body", 2) = {24};
Physical Curve("foot", 3) = {1, 5};
Physical Curve("arch", 4) = {2, 3, 4};
Physical Curve("interface", 5) = {15:20};
Physical Curve("free", 6) = {6:14};
