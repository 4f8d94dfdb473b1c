// The numbers of faces, curves and points after Boolean operations are OpenCASCADE's, as measured.
SetFactory("OpenCASCADE");
Macro List_all
  f() = Surface{:};
  For i In {0:#f()-1}
    b() = Abs(Boundary{ Surface{f(i)}; }); Printf(Sprintf("f%g", f(i)), b());
  EndFor
  c() = Curve{:};
  For i In {0:#c()-1}
    x() = BoundingBox Curve{c(i)};
    Printf("c%g %g,%g %g,%g", c(i), Round(100*x(0)), Round(100*x(1)), Round(100*x(3)), Round(100*x(4)));
  EndFor
  p() = Point{:}; Printf("p", p());
  Delete All;
  SetFactory("OpenCASCADE");
Return
// a hole: its curve keeps its number, as it goes last
Rectangle(1) = {0,0,0, 2,1}; Disk(2) = {.5,.5,0, .2};
BooleanDifference{ Surface{1}; Delete; }{ Surface{2}; Delete; }
Call List_all;
// nothing keeps its number when a number is asked for
Rectangle(1) = {0,0,0, 2,1}; Disk(2) = {.5,.5,0, .2};
BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
Call List_all;
// two that overlap
Rectangle(1) = {0,0,0, 2,2}; Rectangle(2) = {1,1,0, 2,2};
BooleanFragments{ Surface{1}; Delete; }{ Surface{2}; Delete; }
Call List_all;
// neighbours, and one that nothing touches
Rectangle(1) = {0,0,0, 1,1}; Rectangle(2) = {1,0,0, 1,1}; Rectangle(3) = {9,0,0, 1,1};
BooleanFragments{ Surface{1}; Delete; }{ Surface{2,3}; Delete; }
Call List_all;
// new faces first, then what has a number already
Rectangle(1) = {0,0,0, 2,2}; Rectangle(2) = {0,0,0, 1,1};
BooleanFragments{ Surface{1}; Delete; }{ Surface{2}; Delete; }
Call List_all;
// holes that overlap, and one by itself
Rectangle(1) = {0,0,0, 4,4}; Disk(2) = {1,1,0, .5}; Disk(3) = {3,3,0, .5}; Disk(4) = {1.5,1,0, .5};
BooleanFragments{ Surface{1}; Delete; }{ Surface{2:4}; Delete; }
Call List_all;
// a line that cuts through, and one inside
Rectangle(1) = {0,0,0, 2,2}; Point(9) = {-1,1,0}; Point(10) = {3,1,0}; Line(9) = {9,10};
BooleanFragments{ Surface{1}; Delete; }{ Curve{9}; Delete; }
Call List_all;
Rectangle(1) = {0,0,0, 2,2}; Point(9) = {.5,1,0}; Point(10) = {1.5,1,0}; Line(9) = {9,10};
BooleanFragments{ Surface{1}; Delete; }{ Curve{9}; Delete; }
Call List_all;
// one upon the other
Rectangle(5) = {0,0,0, 2,2}; Rectangle(7) = {1,1,0, 2,2};
BooleanIntersection{ Surface{5}; Delete; }{ Surface{7}; Delete; }
Call List_all;
Rectangle(5) = {0,0,0, 2,2}; Rectangle(7) = {1,1,0, 2,2};
BooleanUnion{ Surface{5}; Delete; }{ Surface{7}; Delete; }
Call List_all;
Rectangle(5) = {0,0,0, 2,2}; Disk(7) = {1,1,0, .3};
BooleanIntersection{ Surface{5}; Delete; }{ Surface{7}; Delete; }
Call List_all;
// twice: the second works on what the first made
Rectangle(1) = {0,0,0, 3,1}; Rectangle(2) = {1,-1,0, 1,3};
BooleanFragments{ Surface{1}; Delete; }{ Surface{2}; Delete; }
Disk(50) = {1.5,.5,0, .3};
BooleanDifference{ Surface{:}; Delete; }{ Surface{50}; Delete; }
Call List_all;
// curves alone: one that comes out whole keeps its number
Point(1) = {0,0,0}; Point(2) = {1,0,0}; Point(3) = {.5,-1,0}; Point(4) = {.5,1,0}; Point(5) = {1,0,0}; Point(6) = {2,2,0};
Line(1) = {1,2}; Line(2) = {3,4}; Line(3) = {5,6};
BooleanFragments{ Curve{1}; Delete; }{ Curve{2,3}; Delete; }
Call List_all;
Circle(1) = {.2,.2,0, .05, -Pi, Pi};
Point(2) = {.2,.21,0}; Point(3) = {.6,.21,0}; Point(4) = {.6,.19,0}; Point(5) = {.2,.19,0}; Line(2) = {2,3}; Line(3) = {3,4}; Line(4) = {4,5};
BooleanFragments{ Curve{1}; Delete; }{ Curve{2}; Curve{4}; Delete; }
Call List_all;
// a curve that only touches keeps its number, too
Rectangle(1) = {0,0,0, 1,1}; Point(21) = {1,1,0}; Point(22) = {3,1,0}; Line(20) = {21,22};
BooleanFragments{ Surface{1}; Delete; }{ Curve{20}; Delete; }
Call List_all;
// points among the shapes that are ends of curves
Rectangle(1) = {0,0,0, 2,2}; Rectangle(2) = {1,1,0, 2,2};
v() = BooleanFragments{ Surface{:}; Point{:}; Delete; }{ }; Printf("%g shapes", #v());
Delete All; SetFactory("OpenCASCADE");
// Coherence: the same with all faces, or all curves
Rectangle(1) = {0,0,0, 1,1}; Rectangle(2) = {.5,.5,0, 1,1}; Disk(3) = {2,2,0, 1}; Line(20) = {1,3};
Coherence;
Call List_all;
Point(1) = {0,0,0}; Point(2) = {2,0,0}; Point(3) = {1,-1,0}; Point(4) = {1,1,0}; Line(1) = {1,2}; Line(2) = {3,4};
Coherence;
Call List_all;
// holes of a face that is split: by where they are
Disk(1) = {0,0,0, 2}; Disk(2) = {.5,.5,0, .25,.15}; Disk(3) = {-.5,-.5,0, .35,.25}; Disk(4) = {-.5,.5,0, .2,.1}; Rectangle(5) = {.4,-.6,0, .3,.2};
BooleanFragments{ Surface{1}; Delete; }{ Surface{2:5}; Delete; }
Call List_all;
// arcs that miss their ends a little, as points of few digits do: what meets them there meets them in their ends
Point(1) = {0,0,0}; Point(2) = {40e-3,0,0}; Point(3) = {38.637e-3,10.3528e-3,0}; Point(4) = {34.641e-3,20e-3,0}; Point(5) = {0.05,0.01,0};
Circle(1) = {2,1,3}; Circle(2) = {3,1,4}; Line(3) = {4,5}; Line(4) = {5,2}; Line(5) = {3,5}; Line(6) = {1,2}; Line(7) = {1,3};
Coherence;
c() = Curve{:}; Printf("curves", c());
Curve Loop(1) = {1,2,3,4}; Plane Surface(1) = {1}; Curve Loop(2) = {6,1,-7}; Plane Surface(2) = {2};
BooleanFragments{ Surface{1,2}; Delete; }{ Curve{5}; Delete; }
f() = Surface{:}; Printf("faces", f()); Delete All; SetFactory("OpenCASCADE");
// moves of shapes that share curves, and copies of what Boolean operations made
Rectangle(1) = {0,0,0, 2,2}; Rectangle(2) = {.5,.5,0, 1,1};
BooleanDifference{ Surface{1}; Delete; }{ Surface{2}; Delete; }
Curve Loop(1) = {5,6,7,8}; Plane Surface(2) = {1};
Rotate {{0,0,1}, {0,0,0}, Pi/2} { Surface{2}; Surface{1}; }
Translate {9,0,0} { Duplicata{ Surface{1}; } }
Call List_all;
Rectangle(1) = {0,0,0, 2,2}; Rectangle(2) = {2,0,0, 1,2};
Coherence;
Rotate {{0,0,1}, {0,0,0}, Pi/2} { Surface{1}; Surface{2}; }
Call List_all;
// a union of neighbours has the number of the first (here 4.8.4 differs)
Rectangle(1) = {0,0,0, 1,1}; Rectangle(2) = {1,0,0, 1,1}; Rectangle(3) = {9,9,0, 1,1};
BooleanUnion{ Surface{1}; Delete; }{ Surface{2}; Delete; }
f() = Surface{:}; Printf("left", f()); Delete All; SetFactory("OpenCASCADE");
// expect: f1 [0]6 [1]8 [2]9 [3]7 [4]5
// expect: c5 30,30 70,70
// expect: c6 0,0 200,0
// expect: c7 0,0 0,100
// expect: c8 200,0 200,100
// expect: c9 0,100 200,100
// expect: p [0]5 [1]6 [2]7 [3]8 [4]9
// expect: [delete 0]
// expect: f3 [0]1 [1]3 [2]4 [3]2 [4]5
// expect: c1 0,0 200,0
// expect: c2 0,0 0,100
// expect: c3 200,0 200,100
// expect: c4 0,100 200,100
// expect: c5 30,30 70,70
// expect: p [0]1 [1]2 [2]3 [3]4 [4]5
// expect: [delete 0]
// expect: f1 [0]1 [1]6 [2]5 [3]4 [4]3 [5]2
// expect: f2 [0]4 [1]8 [2]7 [3]3
// expect: f3 [0]8 [1]7 [2]9 [3]10 [4]11 [5]12
// expect: c1 0,0 0,200
// expect: c2 0,200 100,200
// expect: c3 100,100 100,200
// expect: c4 100,100 200,100
// expect: c5 200,0 200,100
// expect: c6 0,0 200,0
// expect: c7 100,200 200,200
// expect: c8 200,100 200,200
// expect: c9 100,200 100,300
// expect: c10 100,300 300,300
// expect: c11 300,100 300,300
// expect: c12 200,100 300,100
// expect: p [0]1 [1]2 [2]3 [3]4 [4]5 [5]6 [6]7 [7]8 [8]9 [9]10
// expect: [delete 0]
// expect: f1 [0]13 [1]14 [2]15 [3]16
// expect: f2 [0]17 [1]18 [2]19 [3]14
// expect: f3 [0]9 [1]10 [2]11 [3]12
// expect: c9 900,0 1000,0
// expect: c10 1000,0 1000,100
// expect: c11 900,100 1000,100
// expect: c12 900,0 900,100
// expect: c13 0,0 100,0
// expect: c14 100,0 100,100
// expect: c15 0,100 100,100
// expect: c16 0,0 0,100
// expect: c17 100,0 200,0
// expect: c18 200,0 200,100
// expect: c19 100,100 200,100
// expect: p [0]9 [1]10 [2]11 [3]12 [4]13 [5]14 [6]15 [7]16 [8]17 [9]18
// expect: [delete 0]
// expect: f2 [0]7 [1]8 [2]1 [3]2
// expect: f3 [0]1 [1]2 [2]3 [3]4 [4]5 [5]6
// expect: c1 100,0 100,100
// expect: c2 0,100 100,100
// expect: c3 0,100 0,200
// expect: c4 0,200 200,200
// expect: c5 200,0 200,200
// expect: c6 100,0 200,0
// expect: c7 0,0 0,100
// expect: c8 0,0 100,0
// expect: p [0]1 [1]2 [2]3 [3]4 [4]5 [5]6 [6]7
// expect: [delete 0]
// expect: f3 [0]8
// expect: f4 [0]1 [1]3 [2]4 [3]2 [4]5 [5]6 [6]7 [7]8
// expect: f5 [0]9 [1]11 [2]10
// expect: f6 [0]11 [1]7 [2]6 [3]9
// expect: f7 [0]10 [1]5
// expect: c1 0,0 400,0
// expect: c2 0,0 0,400
// expect: c3 400,0 400,400
// expect: c4 0,400 400,400
// expect: c5 50,50 125,150
// expect: c6 125,50 200,100
// expect: c7 125,100 200,150
// expect: c8 250,250 350,350
// expect: c9 125,57 150,100
// expect: c10 100,57 125,143
// expect: c11 125,100 150,143
// expect: p [0]1 [1]2 [2]3 [3]4 [4]5 [5]6 [6]7 [7]8 [8]9
// expect: [delete 0]
// expect: f1 [0]1 [1]4 [2]3 [3]2
// expect: f2 [0]5 [1]2 [2]7 [3]6
// expect: c1 0,0 0,100
// expect: c2 0,100 200,100
// expect: c3 200,0 200,100
// expect: c4 0,0 200,0
// expect: c5 0,100 0,200
// expect: c6 0,200 200,200
// expect: c7 200,100 200,200
// expect: c8 -100,100 0,100
// expect: c9 200,100 300,100
// expect: p [0]1 [1]2 [2]3 [3]4 [4]5 [5]6 [6]7 [7]8
// expect: [delete 0]
// expect: f1 [0]10 [1]12 [2]13 [3]11
// expect: c9 50,100 150,100
// expect: c10 0,0 200,0
// expect: c11 0,0 0,200
// expect: c12 200,0 200,200
// expect: c13 0,200 200,200
// expect: p [0]9 [1]10 [2]11 [3]12 [4]13 [5]14
// expect: [delete 0]
// expect: f5 [0]1 [1]4 [2]3 [3]2
// expect: c1 100,100 200,100
// expect: c2 100,100 100,200
// expect: c3 100,200 200,200
// expect: c4 200,100 200,200
// expect: p [0]1 [1]2 [2]3 [3]4
// expect: [delete 0]
// expect: f1 [0]1 [1]2 [2]3 [3]4 [4]5 [5]6 [6]7 [7]8
// expect: c1 0,0 0,200
// expect: c2 0,0 200,0
// expect: c3 200,0 200,100
// expect: c4 200,100 300,100
// expect: c5 300,100 300,300
// expect: c6 100,300 300,300
// expect: c7 100,200 100,300
// expect: c8 0,200 100,200
// expect: p [0]1 [1]2 [2]3 [3]4 [4]5 [5]6 [6]7 [7]8
// expect: [delete 0]
// expect: f7 [0]5
// expect: c5 70,70 130,130
// expect: p [0]5
// expect: [delete 0]
// expect: f1 [0]1 [1]4 [2]3 [3]2
// expect: f2 [0]3 [1]7 [2]6 [3]5 [4]17
// expect: f3 [0]6 [1]8 [2]9 [3]10
// expect: f4 [0]11 [1]13 [2]12 [3]7
// expect: f5 [0]14 [1]5 [2]16 [3]15
// expect: c1 0,0 0,100
// expect: c2 0,100 100,100
// expect: c3 100,0 100,100
// expect: c4 0,0 100,0
// expect: c5 100,100 200,100
// expect: c6 200,0 200,100
// expect: c7 100,0 200,0
// expect: c8 200,100 300,100
// expect: c9 300,0 300,100
// expect: c10 200,0 300,0
// expect: c11 100,-100 100,0
// expect: c12 200,-100 200,0
// expect: c13 100,-100 200,-100
// expect: c14 100,100 100,200
// expect: c15 100,200 200,200
// expect: c16 200,100 200,200
// expect: c17 120,20 180,80
// expect: p [0]1 [1]2 [2]3 [3]4 [4]5 [5]6 [6]7 [7]8 [8]9 [9]10 [10]11 [11]12 [12]13
// expect: [delete 0]
// expect: c3 100,0 200,200
// expect: c4 0,0 50,0
// expect: c5 50,0 100,0
// expect: c6 50,-100 50,0
// expect: c7 50,0 50,100
// expect: p [0]1 [1]2 [2]3 [3]4 [4]5 [5]6
// expect: [delete 0]
// expect: c3 60,19 60,21
// expect: c4 15,20 25,25
// expect: c5 25,19 25,21
// expect: c6 15,15 25,20
// expect: c7 20,21 25,21
// expect: c8 25,21 60,21
// expect: c9 25,19 60,19
// expect: c10 20,19 25,19
// expect: p [0]3 [1]4 [2]5 [3]6 [4]7 [5]8 [6]9
// expect: [delete 0]
// expect: f1 [0]21 [1]22 [2]23 [3]24
// expect: c20 100,100 300,100
// expect: c21 0,0 100,0
// expect: c22 100,0 100,100
// expect: c23 0,100 100,100
// expect: c24 0,0 0,100
// expect: p [0]1 [1]2 [2]3 [3]4 [4]5
// expect: [delete 0]
// expect: 11 shapes
// expect: [delete 0]
// expect: f1 [0]21 [1]26 [2]25 [3]24 [4]23 [5]22
// expect: f2 [0]24 [1]28 [2]27 [3]23
// expect: f3 [0]28 [1]27 [2]29 [3]30 [4]31 [5]32 [6]33
// expect: f4 [0]31 [1]35 [2]34
// expect: f5 [0]36 [1]37 [2]34 [3]35
// expect: c20 0,0 100,100
// expect: c21 0,0 0,100
// expect: c22 0,100 50,100
// expect: c23 50,50 50,100
// expect: c24 50,50 100,50
// expect: c25 100,0 100,50
// expect: c26 0,0 100,0
// expect: c27 50,100 100,100
// expect: c28 100,50 100,100
// expect: c29 50,100 50,150
// expect: c30 50,150 113,150
// expect: c31 113,113 150,150
// expect: c32 150,50 150,113
// expect: c33 100,50 150,50
// expect: c34 113,150 150,150
// expect: c35 150,113 150,150
// expect: c36 150,100 300,200
// expect: c37 100,150 300,300
// expect: p [0]1 [1]3 [2]4 [3]5 [4]6 [5]7 [6]8 [7]9 [8]10 [9]11 [10]12 [11]13 [12]14
// expect: [delete 0]
// expect: c1 0,0 100,0
// expect: c2 100,0 200,0
// expect: c3 100,-100 100,0
// expect: c4 100,0 100,100
// expect: p [0]1 [1]2 [2]3 [3]4 [4]5
// expect: [delete 0]
// expect: f2 [0]8
// expect: f3 [0]2
// expect: f4 [0]7
// expect: f5 [0]3 [1]4 [2]5 [3]6
// expect: f6 [0]1 [1]2 [2]3 [3]4 [4]5 [5]6 [6]7 [7]8
// expect: c1 -200,-200 200,200
// expect: c2 -85,-75 -15,-25
// expect: c3 40,-60 70,-60
// expect: c4 70,-60 70,-40
// expect: c5 40,-40 70,-40
// expect: c6 40,-60 40,-40
// expect: c7 -70,40 -30,60
// expect: c8 25,35 75,65
// expect: p [0]1 [1]2 [2]3 [3]4 [4]5 [5]6 [6]7 [7]8
// expect: [delete 0]
// expect: curves [0]1 [1]2 [2]3 [3]4 [4]5 [5]6 [6]7
// expect: faces [0]2 [1]3 [2]4
// expect: [delete 0]
// expect: f1 [0]17 [1]19 [2]20 [3]18 [4]13 [5]14 [6]15 [7]16
// expect: f2 [0]13 [1]14 [2]15 [3]16
// expect: f3 [0]21 [1]23 [2]24 [3]22 [4]25 [5]26 [6]27 [7]28
// expect: c13 -50,50 -50,150
// expect: c14 -150,150 -50,150
// expect: c15 -150,50 -150,150
// expect: c16 -150,50 -50,50
// expect: c17 0,0 0,200
// expect: c18 -200,0 0,0
// expect: c19 -200,200 0,200
// expect: c20 -200,0 -200,200
// expect: c21 900,0 900,200
// expect: c22 700,0 900,0
// expect: c23 700,200 900,200
// expect: c24 700,0 700,200
// expect: c25 850,50 850,150
// expect: c26 750,150 850,150
// expect: c27 750,50 750,150
// expect: c28 750,50 850,50
// expect: p [0]13 [1]14 [2]15 [3]16 [4]17 [5]18 [6]19 [7]20 [8]21 [9]22 [10]23 [11]24 [12]25 [13]26 [14]27 [15]28
// expect: [delete 0]
// expect: f1 [0]8 [1]9 [2]10 [3]11
// expect: f2 [0]12 [1]13 [2]14 [3]9
// expect: c8 0,0 0,200
// expect: c9 -200,200 0,200
// expect: c10 -200,0 -200,200
// expect: c11 -200,0 0,0
// expect: c12 0,200 0,300
// expect: c13 -200,300 0,300
// expect: c14 -200,200 -200,300
// expect: p [0]7 [1]8 [2]9 [3]10 [4]11 [5]12
// expect: [delete 0]
// expect: left [0]1 [1]3
// expect: [delete 0]
