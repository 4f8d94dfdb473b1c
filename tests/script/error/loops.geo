// prepare for meshing: loops that are not closed, or turned
Point(1) = {0,0,0}; Point(2) = {1,0,0}; Point(3) = {1,1,0}; Point(4) = {0,1,0}; Point(5) = {0,1,0}; Point(6) = {3,3,0}; // expect note: the two points coincide; 'Coherence;' makes them one
Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,4}; Line(4) = {5,1}; Line(5) = {4,1}; Line(6) = {3,6}; // expect warning: the master 7 of periodic curve 1 does not exist any more
Curve Loop(1) = {1,2,3,4}; Plane Surface(1) = {1};       // expect error: curve loop 1 is not closed: curve 3 ends at point 4 (0, 1, 0) and curve 4 at point 5 (0, 1, 0), 0 apart
Curve Loop(2) = {1,2,2,3,5}; Plane Surface(2) = {2};     // expect error: curve loop 2 is not closed: it lists curve 2 twice
Curve Loop(3) = {1,2,6}; Plane Surface(3) = {3};         // expect error: curve loop 3 is not closed: curve 1 ends at point 1 (0, 0, 0) and curve 6 at point 6 (3, 3, 0), 4.24264 apart
Curve Loop(4) = {1,2,3,-5}; Plane Surface(4) = {4};      // expect warning: curve loop 4: curve -5 runs the other way round; taken as 5
Curve Loop(5) = {1,-2,3,-5}; Plane Surface(5) = {5};     // expect warning: curve loop 5: 2 curves run the other way round (the first is -2); their signs are changed
Curve Loop(6) = {1,2,99};                                // expect error: curve loop 6 uses curve 99, which does not exist (there are 6, the largest is 6)
Plane Surface(6) = {6};                                  // expect note: surface 6 needs it
Curve Loop(7) = {1,2};                                   // expect warning: curve loop 7 is not closed: curve 1 ends at point 1 (0, 0, 0) and curve 2 at point 3 (1, 1, 0), 1.41421 apart (no surface uses it)
Curve Loop(8) = {1,2,3,5}; Plane Surface(8) = {8};       // expect warning: corner 6 of transfinite surface 8 is not on its boundary; the surface is meshed freely
Transfinite Surface{8} = {1,2,3,6};
Line(7) = {1,3};
Periodic Curve {1} = {7}; Delete { Curve{7}; }
Physical Curve(1) = {77};                                // expect warning: physical curve 1 names curve 77, which does not exist
Physical Surface(2) = {77, 78};                          // expect warning: physical surface 2 names surface 77, 78, which do not exist
