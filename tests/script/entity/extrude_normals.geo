// Layers along the normals of curves: Gmsh 4.8.4's numbers. Each curve leaves out as many numbers of points as it has control points.
Point(1) = {0, 0, 0}; Point(2) = {1, 0, 0}; Point(3) = {.3, .1, 0}; Point(4) = {.5, .5, 0}; Point(5) = {.5, 0, 0}; Point(6) = {2, 0, 0};
BSpline(1) = {1, 3, 4, 2}; Line(2) = {2, 6};
a() = Extrude { Curve{1, 2}; Layers{2, .1}; };
Printf("a", a());                       // expect: a [0]3 [1]6 [2]5 [3]-4 [4]7 [5]10 [6]9 [7]-5
p() = PointsOf{ Curve{3, 7}; }; Printf("p", p()); // expect: p [0]11 [1]12 [2]12 [3]16
Printf("%g %g", newp, newc);            // expect: 17 11
Point(30) = {9, 0, 0}; Point(31) = {8, 0, 0}; Point(32) = {8, 1, 0}; Circle(20) = {30, 31, 32};
b() = Extrude { Curve{-20}; Layers{2, .1}; };
p() = PointsOf{ Curve{b(0)}; }; Printf("p", p()); // expect: p [0]36 [1]37
