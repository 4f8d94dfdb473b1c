// Extrude returns the copy, the body swept, and the lateral ones.
Point(1) = {0,0,0}; Point(2) = {1,0,0}; Line(1) = {1, 2};
e[] = Extrude {0, 1, 0} { Line{1}; };
Printf("e", e[]);                                // expect: e [0]2 [1]5 [2]4 [3]-3
q[] = Extrude {0, 0, 1} { Point{1}; }; Printf("%g", #q[]); // expect: 2
Extrude {0, 1, 0} { Line{2}; Layers{5}; Recombine; }
Extrude {0, 1, 0} { Point{1}; Layers{{2, 3}, {0.5, 1}}; }
r[] = Extrude {{0, 1, 0}, {5, 0, 0}, Pi/4} { Point{2}; Layers{4}; }; Printf("%g", #r[]); // expect: 2
s[] = Extrude {{0, 0, 1}, {0, 1, 0}, {5, 0, 0}, Pi/4} { Point{2}; }; Printf("%g", #s[]); // expect: 2
Extrude Point {1, {0, 0, -1}};
Extrude Line {1, {0, 0, 1}, {-3, 0, 0}, Pi/6} { Layers{3}; Recombine; };
Extrude {0, 1, 0} { Line{1}; Layers{{1, 2}, {1}}; } // expect error: 2 numbers of layers, but 1 heights
Extrude {0, 1, 0} { Line{1}; Layers{-1}; }       // expect error: -1 layers are not possible
Extrude {{0, 0, 1}, {0, 0, 0}} { Line{1}; }      // expect error: Extrude by rotation needs an axis, a point and an angle
Extrude Line {1};                                // expect error: Extrude needs a translation
Extrude { Surface{5}; } Using Wire {1}           // expect error: Wire (extrusion along a curve) needs OpenCASCADE
// OpenCASCADE takes the numbers of sides before those of copies, and shares what shapes of one statement share
Delete All;                                      // expect: [delete 0]
SetFactory("OpenCASCADE");
Point(1) = {0,0,0}; Point(2) = {1,0,0}; Point(3) = {2,.5,0}; Line(1) = {1,2}; Line(2) = {2,3};
e[] = Extrude {0,1,0} { Curve{1,2}; Layers{3}; }; Printf("e", e[]); // expect: e [0]5 [1]1 [2]3 [3]4 [4]7 [5]2 [6]4 [7]6
e[] = Extrude {0,0,1} { Point{1}; }; Printf("e", e[]); // expect: e [0]7 [1]8
e[] = Extrude {{0,1,0}, {-1,0,0}, Pi/2} { Curve{1}; }; Printf("e", e[]); // expect: e [0]11 [1]3 [2]9 [3]10
e[] = Extrude {0,0,1} { Point{1}; Curve{1}; Point{2}; }; Printf("%g", #e[]); // expect: 8
Delete All;                                      // expect: [delete 0]
Rectangle(1) = {0,0,0, 1,2};
e[] = Extrude {0,0,1} { Surface{1}; }; Printf("e", e[]); // expect: e [0]6 [1]1 [2]2 [3]3 [4]4 [5]5
Delete All;                                      // expect: [delete 0]
Circle(1) = {0,0,0, 1};
e[] = Extrude {0,0,1} { Curve{1}; }; Printf("e", e[]); // expect: e [0]3 [1]1 [2]2 [3]2
Point(10) = {3,0,0}; Point(11) = {4,0,0}; Line(20) = {10,11};
e[] = Extrude {{0,0,1}, {0,0,0}, Pi/3} { Curve{20}; }; Printf("e", e[]); // expect: e [0]23 [1]2 [2]21 [3]22
e[] = Extrude {{0,0,1}, {0,0,0}, 2*Pi} { Point{10}; }; Printf("e", e[]); // expect: e [0]10 [1]24
e[] = Extrude {{0,0,1}, {0,0,0}, 2*Pi} { Curve{20}; }; Printf("e", e[]); // expect: e [0]20 [1]3 [2]25 [3]26
p[] = Point{12}; Printf("%.3f %.3f", p(0), p(1)); // expect: 1.500 2.598
Extrude {{0,0,1}, {0,0,0}, 7} { Curve{20}; }     // expect error: an arc turns by 2 pi at most
Point(16) = {3.5,.3,5}; Point(14) = {3,0,5}; Point(15) = {4,0,5}; Spline(30) = {14,16,15};
e[] = Extrude {0,2,0} { Curve{30}; }; Printf("%g %g", #e[], newp); // expect: 4 19
b() = BoundingBox Curve{e(0)}; Printf("%.2f %.2f %.2f", b(1), b(4), b(5)); // expect: 2.00 2.30 5.00
// OpenCASCADE numbers the boundaries of what it moves anew, and parts it from what stays
Delete All;                                      // expect: [delete 0]
Rectangle(1) = {0,0,0, 1,1}; Rectangle(2) = {5,0,0, 1,1}; Disk(3) = {9,0,0, 1};
Rotate {{0,0,1}, {0,0,0}, Pi/6} { Surface{1}; }
b() = Boundary{ Surface{1}; }; Printf("b", b()); // expect: b [0]10 [1]11 [2]12 [3]13
Translate {2,0,0} { Surface{2,3}; }
b() = Boundary{ Surface{2,3}; }; Printf("b", b()); // expect: b [0]14 [1]15 [2]16 [3]17 [4]18
Point(50) = {0,0,0}; Point(51) = {1,2,0}; Line(50) = {50,51}; Translate {2,0,0} { Curve{50}; }
p() = Boundary{ Curve{50}; }; Printf("p", p());  // expect: p [0]19 [1]20
p() = Point{20}; Printf("%g %g", p(0), p(1));    // expect: 3 2
Delete All;                                      // expect: [delete 0]
Rectangle(1) = {0,0,0, 1,1}; Rectangle(2) = {1,0,0, 1,1};
BooleanFragments{ Surface{1}; Delete; }{ Surface{2}; Delete; }
Translate {2,0,0} { Surface{2}; }
b() = Boundary{ Surface{1}; }; Printf("b", b()); // expect: b [0]1 [1]2 [2]3 [3]4
b() = Boundary{ Surface{2}; }; Printf("b", b()); // expect: b [0]5 [1]6 [2]7 [3]8
b() = BoundingBox Surface{1}; Printf("%g %g", b(0), b(3)); // expect: 0 1
b() = BoundingBox Surface{2}; Printf("%g %g", b(0), b(3)); // expect: 3 4
Translate {0,5,0} { Curve{2}; }                  // the face keeps its side, the curve its number
b() = Boundary{ Surface{1}; }; Printf("b", b()); // expect: b [0]1 [1]9 [2]3 [3]4
b() = BoundingBox Curve{2}; Printf("%g %g", b(1), b(4)); // expect: 5 6
Delete All;                                      // expect: [delete 0]
Rectangle(1) = {-1,-1,0, 2,2}; Disk(2) = {0,0,0, .5,.25};
BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; };
Rotate {{0,0,1}, {0,0,0}, Pi/2} { Surface{2}; }
b() = BoundingBox Surface{2}; Printf("%.3f %.3f", b(3), b(4)); // expect: 0.250 0.500
b() = BooleanFragments{ Surface{3}; Delete; }{ Surface{2}; Delete; }; Printf("%g", #b()); // expect: 4
