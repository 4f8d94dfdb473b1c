// Loops and surfaces.
Point(1) = {0,0,0}; Point(2) = {3,0,0}; Point(3) = {3,3,0}; Point(4) = {0,3,0};
Point(5) = {1,1,0}; Point(6) = {2,1,0}; Point(7) = {2,2,0}; Point(8) = {1,2,0};
For i In {1:4} Line(i) = {i, i % 4 + 1}; Line(i + 4) = {i + 4, i % 4 + 5}; EndFor
Curve Loop(1) = {1, 2, 3, 4};
Line Loop(2) = {5, 6, 7, 8};
Line Anything(3) = {5, 6, 7, 8};
Plane Surface(1) = {1, 2};                       // expect note: made here
Plane Surface(2) = {-3};
Surface(3) = {3};
Ruled Surface(4) = {3};
Surface(5) = {3} In Sphere {1};                  // expect warning: 'In Sphere' is not supported
Surface(6) = {1, 2};
Plane Surface(1) = {1};                          // expect error: surface 1 exists already
Surface Loop(1) = {1, 2};
Volume(1) = {1};
Printf("%g %g %g %g %g %g %g", newll, news, newsl, newv, newreg, newcl, newp); // expect: 9 9 9 9 9 9 9
Geometry.OldNewReg = 0;
Printf("%g %g %g %g %g %g", newl, newll, news, newsl, newv, newreg); // expect: 9 4 7 2 2 9
BSpline Surface(9) = {1};                        // expect error: BSpline Surface is not supported
Parametric Surface(9) = "u" "v" "0";             // expect error: Parametric Surface is not supported
PolarSphere(1) = {1, 99};                        // expect error: PolarSphere 1 uses point 99, which does not exist
PolarSphere(1) = {1, 1};                         // expect error: PolarSphere 1 has no radius: points 1 and 1 coincide
PolarSphere(1) = {1};                            // expect error: PolarSphere needs two points {centre, pole}; 1 given
Sphere(1) = {1, 2};                              // expect error: Sphere is not supported
Euclidean Coordinates;                           // expect error: Euclidean is not supported
s[] = Surface{:}; Printf("%g", #s[]);            // expect: 6
// expect model: points 8, curves 8, loops 3, faces 6, volumes 1
