// Boundary and its kin, boxes, deletion, splitting, coherence.
Point(1) = {0,0,0}; Point(2) = {1,0,0}; Point(3) = {1,1,0}; Point(4) = {0,1,0};
Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,4}; Line(4) = {4,1};
Curve Loop(1) = {1,2,3,4}; Plane Surface(1) = {1};
b[] = Boundary{ Surface{1}; }; Printf("b", b[]); // expect: b [0]1 [1]2 [2]3 [3]4
b[] = CombinedBoundary{ Surface{:}; }; Printf("%g", #b[]); // expect: 4
b[] = Boundary{ Line{2}; }; Printf("b", b[]);    // expect: b [0]2 [1]3
b[] = PointsOf{ Surface{1}; }; Printf("%g", #Unique_b[]); // expect error: unknown variable 'Unique_b'
b[] = Unique(PointsOf{ Surface{1}; }); Printf("b", b[]); // expect: b [0]1 [1]2 [2]3 [3]4
b[] = Abs(OrientedBoundary{ Surface{1}; }); Printf("%g", #b[]); // expect: 4
b[] = Point In BoundingBox {-0.1, -0.1, -1, 0.1, 2, 1}; Printf("b", b[]); // expect: b [0]1 [1]4
b[] = Curve In BoundingBox {-1, -1, -1, 2, 0.5, 1}; Printf("b", b[]); // expect: b [0]1
b[] = Curve In BoundingBox {0, 0, 1};            // expect error: a bounding box needs 6 numbers
b[] = BoundingBox Surface{1}; Printf("b", b[]);  // expect: b [0]0 [1]0 [2]0 [3]1 [4]1 [5]0
b[] = Surface{1};                                // expect error: only Point{n} has coordinates
Point(9) = {7, 7, 0};
Delete { Point{9}; }
Printf("%g", newp);                              // expect: 9
Delete { Surface{1}; }
Recursive Delete { Line{1}; }
Delete Everything;                               // expect error: unknown variable 'Everything'
Delete;                                          // expect error: expected shapes in braces, or what to delete
Recursive Points;                                // expect error: expected Delete, Show, Hide or Color after 'Recursive'
Coherence; Coherence Mesh; Coherence Geometry;
Coherence Point {1, 77};                         // expect error: point 77 does not exist
Coherence 5;                                     // expect error: expected ';'
Point(21) = {8, 8, 0}; Point(22) = {9, 8, 0}; Point(23) = {9, 9, 0}; Line(21) = {21, 22}; Line(22) = {23, 21};
Coherence Point {23, 22};
b[] = Boundary{ Line{21}; }; Printf("b", b[]);   // expect: b [0]21 [1]22
b[] = Point{22}; Printf("b", b[]);               // expect: b [0]9 [1]9 [2]0
Delete Model;                                    // expect: [delete 0]
Printf("%g", newp);                              // expect: 1
// numbers of what coherence merges come again, but with OldNewReg = 0
Geometry.OldNewReg = 0; Point(101) = {50,0,0}; Point(102) = {51,0,0}; Point(103) = {50,0,0}; Coherence;
Printf("%g", newp - 103);                        // expect: 1
Geometry.OldNewReg = 1;
Point(104) = {50,0,0}; Coherence;
Printf("%g", newp - 103);                        // expect: 0
