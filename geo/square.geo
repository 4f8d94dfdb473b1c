// square.geo - the unit square, uniform mesh size h
// The yardstick of the benchmarks: -setnumber h 0.0048 gives 100,000 triangles.
DefineConstant[ h = {0.1, Name "Mesh size"} ];

Point(1) = {0, 0, 0, h};
Point(2) = {1, 0, 0, h};
Point(3) = {1, 1, 0, h};
Point(4) = {0, 1, 0, h};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};
Physical Surface("square", 1) = {1};
Physical Curve("sides", 2) = {1:4};
