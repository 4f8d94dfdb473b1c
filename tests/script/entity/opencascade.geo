// Rectangle and Disk are made of lines and arcs; solids and booleans are refused by name.
Rectangle(1) = {0, 0, 0, 2, 1};                  // expect error: Rectangle needs SetFactory("OpenCASCADE"); first
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 2, 1};
Disk(2) = {5, 0, 0, 1};
Disk(3) = {9, 0, 0, 2, 1};
Rectangle(4) = {0, 5, 0, 2, 1, 0.2};
Rectangle(5) = {0, 0, 0, 0, 1};                  // expect error: this Rectangle has no area
Rectangle(5) = {0, 0, 0, 1, 1, 0.5};             // expect error: the corners of this Rectangle are larger than its sides
Rectangle(5) = {0, 0, 0};                        // expect error: a Rectangle needs {x, y, z, dx, dy}
Disk(5) = {0, 0};                                // expect error: a Disk needs {x, y, z, rx}
Disk(5) = {0, 0, 0, -1};                         // expect error: the radius of a Disk must be positive
Circle(50) = {0, 0, 0, 1};                       // expect error: Circle by centre and radius needs the OpenCASCADE kernel
Box(1) = {0,0,0, 1,1,1};                         // expect error: Box needs the OpenCASCADE kernel
Cylinder(1) = {0,0,0, 1,1,1, 2};                 // expect error: Cylinder needs the OpenCASCADE kernel
BooleanUnion{ Surface{1}; Delete; }{ Surface{2}; Delete; } // expect error: BooleanUnion needs the OpenCASCADE kernel
x[] = BooleanDifference{ Surface{1}; }{ Surface{2}; }; // expect error: BooleanDifference needs the OpenCASCADE kernel
BooleanFragments{ Surface{1}; Delete; }{ Surface{2}; Delete; } // expect error: BooleanFragments needs
BooleanIntersection{ Surface{1}; }{ Surface{2}; } // expect error: BooleanIntersection needs
Fillet{1}{1}{0.1}                                // expect error: Fillet needs the OpenCASCADE kernel
ThruSections(1) = {1,2};                         // expect error: ThruSections needs
SetFactory("Parasolid");                         // expect error: unknown kernel "Parasolid"
SetFactory("Built-in");
Printf("%g", 1);                                 // expect: 1
// expect model: faces 4
