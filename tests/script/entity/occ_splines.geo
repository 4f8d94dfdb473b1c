// OpenCASCADE's splines: fixed when they are made; a closed BSpline begins at a point of its own.
SetFactory("OpenCASCADE");
Point(1) = {0, 0, 0}; Point(2) = {1, 1, 0}; Point(3) = {2, 0, 0}; Point(4) = {2, 0, 0};
Spline(1) = {1, 2, 3};                           // a parabola
b[] = BoundingBox Curve{1}; Printf("%g %g %g %g", b[0], b[1], b[3], b[4]); // expect: 0 0 2 1
Spline(2) = {1, 2, 3, 4, 1};                     // expect error: Spline 2 has two points in one place, 3 and 4, one after the other
BSpline(3) = {1, 2, 3, 1};
Printf("%g", newp);                              // expect: 6
p[] = Point{5}; Printf("%g %g", p[0], p[1]);     // expect: 0.5 0.5
Translate {0, 7, 0} { Point{2}; }
b[] = BoundingBox Curve{1}; Printf("%g", b[4]);  // expect: 1
Bezier(4) = {1, 2, 3};
b[] = BoundingBox Curve{4}; Printf("%g", b[4]);  // expect: 4
Wire(9) = {1, 4};
Plane Surface(9) = {9};
Printf("%g %g %g", newp, newl, news);            // expect: 6 10 10
Delete All;                                      // expect: [delete 0]
Point(1) = {0, 0, 0}; Point(2) = {1, 1, 0}; Point(3) = {2, 0, 0}; Point(4) = {3, 1, 0}; Spline(1) = {1:4};
o[] = Extrude {0, 0, 1} { Curve{1}; };           // the copy is a spline too
b[] = BoundingBox Curve{o[0]}; Printf("%g %g %g", b[0], b[2], b[3]); // expect: 0 1 3
// expect model: points 6, curves 4, loops 0, faces 1, volumes 0, groups 0
