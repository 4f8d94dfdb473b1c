// Points given in the plane of a stereographic projection are on the sphere.
Point(1) = {0, 0, 0}; Point(2) = {0, 0, 2};
PolarSphere(1) = {1, 2};
Point(3) = {1, 0, 0}; Point(4) = {0, 0, 0}; Point(5) = {0, -0.5, 7};
p[] = Point{3}; Printf("%g %g %g", p[0], p[1], p[2]); // expect: -2 0 0
p[] = Point{4}; Printf("%g %g %g", p[0], p[1], p[2]); // expect: 0 0 2
p[] = Point{5}; Printf("%g %g %g", p[0], p[1], p[2]); // expect: 0 1.6 1.2
Line(1) = {3, 4}; Line(2) = {4, 5}; BSpline(3) = {5, 3};
Curve Loop(1) = {1, 2, 3}; Ruled Surface(1) = {1} In Sphere {1};
// expect model: points 5, curves 3, loops 1, faces 1, volumes 0, groups 0
