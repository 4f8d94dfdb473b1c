// prepare for meshing: what a compound cannot unite
Point(1) = {0,0,0}; Point(2) = {1,0,0}; Point(3) = {1,1,0}; Point(4) = {0,1,0}; Point(5) = {2,0,0}; Point(6) = {2,1,0};
Line(1) = {1,2};                                         // expect warning: curve 1 of a compound is meshed on its own: at its ends are other curves, points or groups that need them, or its nodes are prescribed
Line(2) = {2,3}; Line(3) = {3,4}; Line(4) = {4,1}; 
Line(5) = {2,5};                                         // expect warning: curve 5 of a compound is meshed on its own: at its ends are other curves, points or groups that need them, or its nodes are prescribed
Line(6) = {5,6}; Line(7) = {6,3};
Curve Loop(1) = {1:4}; Curve Loop(2) = {5,6,7,-2};
Plane Surface(1) = {1};                                  // expect warning: surface 1 of a compound is meshed on its own: it has no neighbour in its plane and its physical groups, or is structured
Plane Surface(2) = {2};                                  // expect warning: surface 2 of a compound is meshed on its own: it has no neighbour in its plane and its physical groups, or is structured
Physical Surface(1) = {1};
Compound Surface{1,2};
Physical Curve(2) = {1};
Compound Curve{1,5};
