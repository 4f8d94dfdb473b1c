// Rectangle, Disk and arcs by centre take OpenCASCADE's tags; solids and booleans are refused by name.
Rectangle(1) = {0, 0, 0, 2, 1};                  // expect error: Rectangle needs SetFactory("OpenCASCADE"); first
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 2, 1};
Disk(2) = {5, 0, 0, 1};
Disk(3) = {9, 0, 0, 2, 1};
Rectangle(4) = {0, 5, 0, 2, 1, 0.2};
Rectangle(5) = {0, 0, 0, 0, 1};                  // expect error: Rectangle 5 has no area
Rectangle(5) = {0, 0, 0, 1, 1, 0.5};             // expect error: do not fit its sides
Rectangle(5) = {0, 0, 0};                        // expect error: a Rectangle needs {x, y, z, dx, dy}
Disk(5) = {0, 0};                                // expect error: a Disk needs {x, y, z, rx}
Disk(5) = {0, 0, 0, -1};                         // expect error: needs positive radii
Circle(50) = {0, 9, 0, 1};
Circle(51) = {0, 13, 0, 1, Pi/4, 3*Pi/2};
Ellipse(52) = {0, 19, 0, 2, 1};
Circle(53) = {0, 13, 0, 1, 0, 7};                // expect error: more than once round
Circle(53) = {0, 13, 0, 1, 0};                   // expect error: Circle needs {x, y, z, r} and perhaps two angles
Printf("%g %g %g", newp, newl, news);            // expect: 19 53 53
Curve Loop(60) = {50};
Plane Surface(6) = {60};
a[] = Translate {0, 0, 5} { Duplicata { Surface{1}; } };
Printf("%g %g %g", a[0], newp, newl);            // expect: 7 23 61
Box(1) = {0,0,0, 1,1,1};                         // expect error: Box needs the OpenCASCADE kernel
Cylinder(1) = {0,0,0, 1,1,1, 2};                 // expect error: Cylinder needs the OpenCASCADE kernel
BooleanUnion{ Volume{1}; Delete; }{ Volume{2}; Delete; } // expect error: BooleanUnion of volume 1, which does not exist
Fillet{1}{1}{0.1}                                // expect error: Fillet needs the OpenCASCADE kernel
ThruSections(1) = {1,2};                         // expect error: ThruSections needs
Circle(154) = {20, 0, 0, 1, 0, Pi/2}; p[] = Boundary { Curve{154}; };
q[] = Point{p[0]}; Printf("%g %g, %g", q[0], q[1], p[1] - p[0]); // expect: 20 1, 1
Ellipse(155) = {20, 0, 0, 2, 1, 0, Pi/2}; p[] = Boundary { Curve{155}; };
q[] = Point{p[0]}; Printf("%g %g, %g", q[0], q[1], p[1] - p[0]); // expect: 22 0, 1
SetFactory("Parasolid");                         // expect error: unknown kernel "Parasolid"
SetFactory("Built-in");
Printf("%g", 1);                                 // expect: 1
// expect model: faces 6
