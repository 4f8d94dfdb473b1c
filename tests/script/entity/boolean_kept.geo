// Inputs without Delete stay as they are, to the last point, as in Gmsh. Where they touch, the result has points and curves of its own.
SetFactory("OpenCASCADE");
Rectangle(1) = {0,0,0,1,1}; Rectangle(2) = {1,0,0,1,2};
f() = BooleanUnion{ Surface{1}; }{ Surface{2}; };
c() = Boundary{ Surface{f()}; }; Printf("union", c());      // expect: union [0]9 [1]10 [2]7 [3]11 [4]3 [5]12
p() = PointsOf{ Surface{f()}; }; Printf("points", p());     // expect: points [0]3 [1]4 [2]7 [3]8 [4]9 [5]10
d() = Boundary{ Surface{2}; }; Printf("second", d());       // expect: second [0]5 [1]6 [2]7 [3]8
q() = PointsOf{ Surface{2}; }; Printf("its points", q());   // expect: its points [0]5 [1]6 [2]7 [3]8
Delete All; // expect: [delete 0]
SetFactory("OpenCASCADE");
Rectangle(1) = {0,0,0,2,2}; Rectangle(2) = {2,0,0,1,1};
f() = BooleanFragments{ Surface{1}; }{ Surface{2}; Delete; };
c() = Boundary{ Surface{f()}; }; Printf("fragments", c());  // expect: fragments [0]8 [1]9 [2]10 [3]6 [4]5 [5]6 [6]7 [7]3 [8]4
d() = Boundary{ Surface{1}; }; Printf("first", d());        // expect: first [0]1 [1]2 [2]3 [3]4
Delete All; // expect: [delete 0]
SetFactory("OpenCASCADE");
Rectangle(1) = {4,1,0,1,1}; Rectangle(2) = {3,0,0,4,4}; // what is left of the first is no longer it, if the second stays
f() = BooleanIntersection{ Surface{1}; Delete; }{ Surface{2}; };
c() = Boundary{ Surface{f()}; }; Printf("left", f(), c());  // expect: left [0]1 [1]9 [2]10 [3]11 [4]12
Delete All; // expect: [delete 0]
SetFactory("OpenCASCADE");
Point(1)={0,0,0,1}; Point(2)={0,3,0,1}; Point(3)={4,3,0,1}; Point(4)={4,0,0,1};
Line(11)={1,2}; Line(12)={2,3}; Line(13)={3,4}; Line(14)={1,4}; Circle(9)={2,1.5,0,.5,0,2*Pi};
Curve Loop(3)={11,12,13,-14}; Curve Loop(4)={9}; Plane Surface(1)={3}; Plane Surface(2)={4};
f() = BooleanDifference{ Surface{1}; Delete;}{ Surface{2}; Delete;}; // and faces are extruded in the order of their curves' numbers
e() = Extrude {0, 0, 1} { Surface{f()}; }; Printf("extruded", e());  // expect: extruded [0]7 [1]1 [2]2 [3]3 [4]4 [5]5 [6]6
c() = Boundary{ Surface{3}; }; Printf("side", c()); // expect: side [0]11 [1]17 [2]18 [3]14
Delete All; // expect: [delete 0]
SetFactory("OpenCASCADE");
Rectangle(1)={0,1,0,2,2}; Disk(2)={3.2,2.14,0,1.3}; Disk(3)={0,1,0,1.3};
f() = BooleanIntersection{ Surface{1}; Delete; }{ Surface{2:3}; Delete; }; Printf("parts", f()); // expect: parts [0]2 [1]3
