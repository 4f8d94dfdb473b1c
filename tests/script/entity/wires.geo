// The boundaries of OpenCASCADE's shapes have numbers, too, which Plane Surface takes like those of curve loops.
SetFactory("OpenCASCADE");
Macro List_all
  f() = Surface{:};
  For i In {0:#f()-1}
    b() = Abs(Boundary{ Surface{f(i)}; }); Printf(Sprintf("f%g", f(i)), b());
  EndFor
Return
Rectangle(3) = {0,0,0, 2,1}; Disk(7) = {1,.5,0, .2}; Plane Surface(9) = {1,2};
Call List_all;
Delete All; SetFactory("OpenCASCADE");
// from the largest number on
Rectangle(1) = {0,0,0, 2,1}; Curve Loop(5) = {1:4}; Plane Surface(10) = {1}; Circle(20) = {5,5,0, 1}; Curve Loop(6) = {20};
Rectangle(30) = {10,0,0, 1,1}; Plane Surface(13) = {7};
Call List_all;
Delete All; SetFactory("OpenCASCADE");
// copies and swept faces; they go along with moves, and stay without their faces, but not without their curves
Rectangle(1) = {0,0,0, 2,1}; Translate {5,0,0} { Duplicata { Surface{1}; } } Extrude {0,2,0} { Curve{1}; }
Translate {0,9,0} { Surface{2}; } Delete { Surface{1}; }
Plane Surface(10) = {1}; Plane Surface(11) = {4}; Plane Surface(20) = {3};
Call List_all;
Delete All; SetFactory("OpenCASCADE");
Rectangle(1) = {0,0,0, 2,1}; Recursive Delete { Surface{1}; } Rectangle(1) = {0,0,0, 2,1}; Plane Surface(10) = {1};
Plane Surface(11) = {2}; // expect error: surface 11 uses curve loop 2, but there is no curve loop yet
// expect: f3 [0]1 [1]2 [2]3 [3]4
// expect: f7 [0]5
// expect: f9 [0]1 [1]2 [2]3 [3]4 [4]5
// expect: [delete 0]
// expect: f1 [0]1 [1]2 [2]3 [3]4
// expect: f10 [0]1 [1]2 [2]3 [3]4
// expect: f13 [0]21 [1]22 [2]23 [3]24
// expect: f30 [0]21 [1]22 [2]23 [3]24
// expect: [delete 0]
// expect: f2 [0]12 [1]13 [2]14 [3]15
// expect: f3 [0]1 [1]10 [2]11 [3]9
// expect: f10 [0]1 [1]2 [2]3 [3]4
// expect: f11 [0]12 [1]13 [2]14 [3]15
// expect: f20 [0]1 [1]10 [2]11 [3]9
// expect: [delete 0]
