// NACA 0012 in a C-shaped domain with a C-shaped boundary layer: it goes along the lower side, round the nose, along the upper side and
// on both sides of the wake to the outflow. First height 1e-4 chord, growth 1.2.
//   meshgen -2 geo/naca0012.geo -o naca0012.msh
R = 10;    // from the aerofoil to the far field
n = 40;    // points of each side of the aerofoil
far = 1.5; // element size there

// The profile with closed trailing edge, by abscissae that crowd at both ends.
Macro thickness
  y = 0.6*(0.2969*Sqrt(x) - 0.1260*x - 0.3516*x^2 + 0.2843*x^3 - 0.1036*x^4);
Return

Point(1) = {1, 0, 0, 0.01};     // trailing edge
Point(1001) = {0, 0, 0, 0.003}; // nose
upper[] = {1001};
lower[] = {1};
For k In {1:n - 1}
  x = 0.5*(1 - Cos(Pi*k/n));
  Call thickness;
  Point(1001 + k) = {x, y, 0};
  upper[] += 1001 + k;
  x = 0.5*(1 + Cos(Pi*k/n));
  Call thickness;
  Point(1 + k) = {x, -y, 0};
  lower[] += 1 + k;
EndFor
upper[] += 1;
lower[] += 1001;
Spline(1) = {lower[]}; // from the trailing edge to the nose
Spline(2) = {upper[]}; // and back

Point(2001) = {1 + R, 0, 0, 0.3};
Point(2002) = {1 + R, R, 0, far};
Point(2003) = {0.5, R, 0, far};
Point(2004) = {0.5 - R, 0, 0, far};
Point(2005) = {0.5, -R, 0, far};
Point(2006) = {1 + R, -R, 0, far};
Point(2007) = {0.5, 0, 0};
Line(3) = {1, 2001}; // the wake
Line(4) = {2001, 2002};
Line(5) = {2002, 2003};
Circle(6) = {2003, 2007, 2004};
Circle(7) = {2004, 2007, 2005};
Line(8) = {2005, 2006};
Line(9) = {2006, 2001};

// The wake belongs to the loop twice: the face lies on both sides of it.
Curve Loop(1) = {4, 5, 6, 7, 8, 9, -3, 1, 2, 3};
Plane Surface(1) = {1};

Field[1] = BoundaryLayer;
Field[1].CurvesList = {1, 2, 3};
Field[1].Size = 1e-4;
Field[1].Ratio = 1.2;
Field[1].Thickness = 0.02;
Field[1].Quads = 1;
BoundaryLayer Field = 1;

Physical Curve("aerofoil") = {1, 2};
Physical Curve("far") = {5:8};
Physical Curve("outflow") = {4, 9};
Physical Surface("air") = {1};
