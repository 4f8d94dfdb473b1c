// seed_rectangle.geo - a 1 x 3 rectangle whose mesh size varies as h = s (0.1 + 0.08 sin 3x cos 6y)
// The textbook's example for quadrangles (Figures 5.5-5.8). Try: -setnumber s 0.1, -setnumber Mesh.RecombineAll 1
// About 1,900 triangles as it stands.
DefineConstant[ s = {1, Name "Scale of the mesh size"} ];

Point(1) = {0, 0, 0};
Point(2) = {1, 0, 0};
Point(3) = {1, 3, 0};
Point(4) = {0, 3, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};

Field[1] = MathEval;
Field[1].F = Sprintf("%g * (0.1 + 0.08 * sin(3 * x) * cos(6 * y))", s);
Background Field = 1;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;

Physical Surface("plate", 1) = {1};
Physical Curve("boundary", 2) = {1:4};
