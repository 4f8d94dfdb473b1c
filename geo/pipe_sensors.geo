// Cross-section of an insulated pipe with temperature sensors: eight points in the insulation and one thin wire become
// nodes and edges of the mesh, so that values there are read off without interpolation.
//   meshgen -2 geo/pipe_sensors.geo -o pipe_sensors.msh
r = 0.05; w = 0.006; t = 0.03; // inner radius, wall, insulation
h = 0.004;

Point(1) = {0, 0, 0, h};
rad[] = {r, r + w, r + w + t};
siz[] = {h, h/2, 1.5*h};
loops[] = {};
For k In {0:2}
  For q In {0:3}
    Point(10*(k + 1) + q) = {rad[k]*Cos(q*Pi/2), rad[k]*Sin(q*Pi/2), 0, siz[k]};
  EndFor
  For q In {0:3}
    Circle(10*(k + 1) + q) = {10*(k + 1) + q, 1, 10*(k + 1) + (q + 1) % 4};
  EndFor
  Curve Loop(k + 1) = {10*(k + 1):10*(k + 1) + 3};
EndFor
Plane Surface(1) = {1};    // water
Plane Surface(2) = {2, 1}; // wall
Plane Surface(3) = {3, 2}; // insulation

// Sensors half way through the insulation, with small elements around each.
For q In {0:7}
  a = Pi/8 + q*Pi/4; s = r + w + t/2;
  Point(100 + q) = {s*Cos(a), s*Sin(a), 0, h/6};
EndFor
Point{100:107} In Surface{3};

// A wire from the centre of the pipe half way to the wall.
Point(200) = {-r/4, -r/4, 0, h/4};
Point(201) = {r/4, r/3, 0, h/4};
Line(200) = {200, 201};
Curve{200} In Surface{1};

Physical Point("sensors") = {100:107};
Physical Curve("wire") = {200};
Physical Curve("outside") = {30:33};
Physical Surface("water") = {1};
Physical Surface("wall") = {2};
Physical Surface("insulation") = {3};
