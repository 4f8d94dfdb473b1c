// All kinds of curves, by all their names.
Point(1) = {0,0,0}; Point(2) = {1,0,0}; Point(3) = {0,1,0}; Point(4) = {-1,0,0}; Point(5) = {2,1,0}; Point(6) = {0,2,0};
Line(1) = {1, 2};                                // expect note: made here
Curve(2) = {2, 3};
Circle(3) = {2, 1, 3};
Circle(4) = {2, 1, 4} Plane {0, 0, 1};
Ellipse(5) = {2, 1, 2, 6};
Ellipsis(6) = {2, 1, 2, 6} Plane {0, 0, -1};
Spline(7) = {1, 2, 5, 3};
CatmullRom(8) = {1, 2, 5, 3};
BSpline(9) = {1, 2, 5, 3};
Bezier(10) = {1, 2, 5, 3};
Nurbs(11) = {1, 2, 5, 3} Knots {0, 0, 0, 0, 1, 1, 1, 1} Order 3;
Line(12) = {1, 2, 3};
Compound Spline(13) = {1, 2} Using 5;
Compound BSpline(14) = {1, 2} Using 3;
l[] = {1, 2}; Line(20) = l[];
Line(21) = {1:3};
Line(22) = 1;                                    // expect error: needs
Line(1) = {1, 3};                                // expect error: curve 1 exists already
Line(23) = {1, 98};                              // expect error: 98
Line(24) = {1, missing};                         // expect error: unknown variable 'missing'
Curve Loop(99) = {24, 1};
Nurbs(25) = {1, 2};                              // expect error: Nurbs needs 'Knots {..} Order n'
Compound Line(26) = {1, 2};                      // expect error: Compound geometry was removed from the language
Compound Circle(27) = {1, 2};                    // expect error: expected Curve, Surface, Spline or BSpline
Circle(28) = {2, 1, 3} Plane {0, 1};             // expect error: a vector needs 3 components {x, y, z}; 2 given
Point(1000) = {0, 0, 0};
Printf("%g %g", newl, newc);                     // expect: 100 100
Curve(newc) = {1, 4};
Printf("%g", newl);                              // expect: 101
Wire(1) = {1, 2};                                // expect error: Wire needs SetFactory("OpenCASCADE"); first
// An arc that is none is told where it is written, also when it is deleted later.
Point(901) = {0,0,0}; Point(902) = {1,0,0}; Point(903) = {0,2,0};
Circle(901) = {902, 901, 903};                   // expect error: the ends of circle arc 901 are not on one circle
Delete { Curve{901}; }
