// A backward-facing step: three transfinite blocks, graded towards the walls and towards the edge of the step, where the flow
// separates. Quadrangles of matching sizes across the block boundaries.
//   meshgen -2 geo/backward_step.geo -o backward_step.msh
h = 1;     // height of the step
H = 2;     // height of the channel above it
l = 5;     // length before the step
L = 20;    // length behind it
nx1 = 30;  nx2 = 80;  ny1 = 24;  ny2 = 30;
px1 = 1.08; px2 = 1.035; // growth away from the step
b = 0.15;                // end elements against middle ones, between walls

//   4 -------- 5 ----------------- 6
//   |    1     |        2          |
//   1 -------- 2 ----------------- 3     the step is at x = 0, its edge at point 2
//              |        3          |
//              7 ----------------- 8
Point(1) = {-l, 0, 0};  Point(2) = {0, 0, 0};   Point(3) = {L, 0, 0};
Point(4) = {-l, H, 0};  Point(5) = {0, H, 0};   Point(6) = {L, H, 0};
Point(7) = {0, -h, 0};  Point(8) = {L, -h, 0};

Line(1) = {1, 2};  Line(2) = {2, 5};  Line(3) = {5, 4};  Line(4) = {4, 1};
Line(5) = {2, 3};  Line(6) = {3, 6};  Line(7) = {6, 5};
Line(8) = {7, 8};  Line(9) = {8, 3};  Line(10) = {2, 7};

Curve Loop(1) = {1, 2, 3, 4};    Plane Surface(1) = {1};
Curve Loop(2) = {5, 6, 7, -2};   Plane Surface(2) = {2};
Curve Loop(3) = {10, 8, 9, -5};  Plane Surface(3) = {3};

Transfinite Curve{-1, 3} = nx1 + 1 Using Progression px1;
Transfinite Curve{5, 8, -7} = nx2 + 1 Using Progression px2;
Transfinite Curve{2, 4, 6} = ny2 + 1 Using Bump b;
Transfinite Curve{9, 10} = ny1 + 1 Using Bump b;
Transfinite Surface{1:3};
Recombine Surface{1:3};

Physical Curve("inflow") = {4};
Physical Curve("outflow") = {6, 9};
Physical Curve("wall") = {1, 10, 8, 3, 7};
Physical Surface("fluid") = {1:3};
