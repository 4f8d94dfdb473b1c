// A stretch of sea between an irregular coast and the open boundary, with islands: sizes grow with the distance from land.
//   meshgen -2 geo/coastline.geo -o coastline.msh
n = 60;         // points of the coast
near = 0.4;     // element size at the coast, km
far = 4;        // and offshore
pts[] = {};
For k In {0:n}
  x = 100*k/n;
  y = 6*Sin(0.11*x) + 3*Sin(0.31*x + 1) + 1.5*Sin(0.83*x + 2) + 0.8*Sin(2.1*x);
  Point(100 + k) = {x, y, 0, near};
  pts[] += 100 + k;
EndFor
Spline(1) = {pts[]};
Point(1) = {100, 60, 0, far};
Point(2) = {0, 60, 0, far};
Line(2) = {100 + n, 1};
Line(3) = {1, 2};
Line(4) = {2, 100};
Curve Loop(1) = {1:4};

// Islands: closed B-splines through wobbling circles.
cx[] = {22, 47, 55, 76, 84};
cy[] = {28, 22, 41, 30, 19};
cr[] = {5, 2, 6, 3.5, 1.5};
loops[] = {1};
land[] = {1};
For i In {0:4}
  isle[] = {};
  For k In {0:15}
    t = 2*Pi*k/16;
    d = cr[i]*(1 + 0.25*Sin(3*t + i) + 0.12*Cos(5*t + 2*i));
    Point(1000 + 100*i + k) = {cx[i] + d*Cos(t), cy[i] + d*Sin(t), 0, near};
    isle[] += 1000 + 100*i + k;
  EndFor
  isle[] += 1000 + 100*i;
  BSpline(10 + i) = {isle[]};
  Curve Loop(10 + i) = {10 + i};
  loops[] += 10 + i;
  land[] += 10 + i;
EndFor
Plane Surface(1) = {loops[]};

Field[1] = Distance;
Field[1].CurvesList = {land[]};
Field[2] = Threshold;
Field[2].InField = 1;
Field[2].DistMin = 1;
Field[2].DistMax = 20;
Field[2].SizeMin = near;
Field[2].SizeMax = far;
Background Field = 2;
Mesh.MeshSizeExtendFromBoundary = 0;

Physical Curve("coast") = {1};
Physical Curve("islands") = {10:14};
Physical Curve("open") = {2:4};
Physical Surface("sea") = {1};
