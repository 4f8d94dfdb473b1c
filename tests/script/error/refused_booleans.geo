// What Boolean operations refuse.
BooleanUnion{ Surface{1}; }{ Surface{2}; }               // expect error: BooleanUnion needs SetFactory("OpenCASCADE"); first
Rectangle(1) = {0,0,0, 1,1};                             // expect error: Rectangle needs SetFactory("OpenCASCADE"); first
SetFactory("Open");                                      // expect error: unknown kernel "Open": "Built-in" and, for plane shapes, "OpenCASCADE" are known
SetFactory("OpenCASCADE");
Rectangle(1) = {0,0,0, 1,1};
Point(11) = {-1,.5,0}; Point(12) = {.5,.7,0}; Point(13) = {2,.5,0}; Spline(11) = {11,12,13};
BooleanUnion{ }{ }                                       // expect error: BooleanUnion needs surfaces
Point(31) = {9,9,0}; BooleanFragments{ Point{31}; }{ }   // expect error: BooleanFragments needs surfaces or curves
Point(32) = {9,10,1}; Point(33) = {10,9,0}; Point(34) = {10,10,0}; Line(31) = {31,32}; Line(32) = {33,34};
BooleanFragments{ Curve{31,32}; }{ }                     // expect error: BooleanFragments: curve 31 is not in the plane of the others; all must be in one plane
Point(21) = {5,5,0}; Point(22) = {6,5,0}; Point(23) = {6,6,1}; Point(24) = {5,6,0};
Line(21) = {21,22}; Line(22) = {22,23}; Line(23) = {23,24}; Line(24) = {24,21}; Curve Loop(21) = {21:24}; Plane Surface(21) = {21}; // expect warning: surface 21 is not plane: its boundary is up to 0.204124 off its mean plane
BooleanUnion{ Surface{21}; }{ Surface{1}; }              // expect error: BooleanUnion: surface 21 is not plane
