// Boolean operations on plane faces. The tags of faces are those that OpenCASCADE gives.
BooleanUnion{ Surface{1}; }{ Surface{2}; }       // expect error: BooleanUnion needs SetFactory("OpenCASCADE"); first
SetFactory("OpenCASCADE");
Rectangle(1) = {0,0,0, 2,1}; Disk(2) = {.5,.5,0, .2};
o() = BooleanDifference{ Surface{1}; Delete; }{ Surface{2}; Delete; }; Printf("o", o()); // expect: o [0]1
b() = Boundary{ Surface{1}; }; Printf("%g", #b()); // expect: 5
Delete All;                                      // expect: [delete 0]
// neighbours share their border, whole curves keep their tags
Rectangle(1) = {0,0,0, 1,1}; Rectangle(2) = {1,0,0, 1,1};
o() = BooleanFragments{ Surface{1}; Delete; }{ Surface{2}; Delete; }; Printf("o", o()); // expect: o [0]1 [1]2
b() = Boundary{ Surface{2}; }; Printf("b", b()); // expect: b [0]5 [1]6 [2]7 [3]2
c() = Curve{:}; p() = Point{:}; Printf("%g %g", #c(), #p()); // expect: 7 6
Delete All;                                      // expect: [delete 0]
// overlapping: what is of the first alone, what is common, what is of the second alone
Rectangle(1) = {0,0,0, 2,2}; Rectangle(2) = {1,1,0, 2,2};
o() = BooleanFragments{ Surface{1}; Delete; }{ Surface{2}; Delete; };
Printf("o", o()); // expect: o [0]1 [1]2 [2]3
b() = BoundingBox Surface{2}; Printf("%g %g %g %g", b(0), b(1), b(3), b(4)); // expect: 1 1 2 2
p() = Point{:}; Printf("%g", #p());              // expect: 10
Delete All;                                      // expect: [delete 0]
Rectangle(1) = {0,0,0, 2,2}; Disk(2) = {1,1,0, .5}; Disk(3) = {1,1,0, .25};
o() = BooleanFragments{ Surface{1}; Delete; }{ Surface{2, 3}; Delete; }; Printf("o", o()); // expect: o [0]3 [1]4 [2]5
Delete All;                                      // expect: [delete 0]
// without Delete the shapes stay; a tag may be asked for
Rectangle(1) = {0,0,0, 2,2}; Rectangle(2) = {1,1,0, 2,2};
BooleanIntersection(7) = { Surface{1}; }{ Surface{2}; };
s() = Surface{:}; Printf("s", s());              // expect: s [0]1 [1]2 [2]7
// cut in two
Rectangle(11) = {10,0,0, 2,2}; Rectangle(12) = {10.5,-1,0, .5,4};
o() = BooleanDifference{ Surface{11}; Delete; }{ Surface{12}; Delete; }; Printf("%g", #o()); // expect: 2
Delete All;                                      // expect: [delete 0]
// a union of rectangles in line has no corners but its own
Rectangle(1) = {0,0,0, 1,1}; Rectangle(2) = {1,0,0, 1,1};
o() = BooleanUnion{ Surface{1}; Delete; }{ Surface{2}; Delete; };
Printf("o", o()); // expect: o [0]1
b() = Boundary{ Surface{1}; }; Printf("%g", #b()); // expect: 4
// curves cut faces and are cut
Point(50) = {-1, .5, 0}; Point(51) = {1, .5, 0}; Line(50) = {50, 51};
o() = BooleanFragments{ Surface{1}; Delete; }{ Curve{50}; Delete; }; Printf("%g", #o()); // expect: 3
BooleanUnion{ Surface{1}; }{ Surface{99}; }      // expect error: BooleanUnion of surface 99, which does not exist
BooleanUnion{ Surface{1}; }{ Curve{1}; }         // expect error: works on plane surfaces here (BooleanFragments on curves and points too), not on curve 1
BooleanFragments{ Curve{50}; }{ }                // expect error: curve 50, which does not exist
Rectangle(60) = {0,0,5, 1,1};
BooleanUnion{ Surface{1}; }{ Surface{60}; }      // expect error: all must be in one plane
Delete All;                                      // expect: [delete 0]
// the loop of a face that an operation took is free again
Point(1) = {0,0,0}; Point(2) = {2,0,0}; Point(3) = {0,2,0}; Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,1};
Curve Loop(7) = {1:3}; Plane Surface(1) = {7}; Disk(2) = {.5,.5,0, .2};
o() = BooleanDifference{ Surface{1}; Delete; }{ Surface{2}; Delete; };
Curve Loop(7) = {4};                             // expect note: curve loop 7 was made here
Plane Surface(4) = {7}; Plane Surface(5) = {7};
Recursive Delete { Surface{4}; }
Curve Loop(7) = {4};                             // expect error: curve loop 7 exists already
