// prepare for meshing: 0 is a number like others, but has no sign
Point(0) = {0,0,0}; Point(1) = {1,0,0}; Point(2) = {1,1,0}; Point(3) = {0,1,0};
Line(0) = {1,2}; Line(1) = {2,3}; Line(2) = {3,0}; Line(3) = {0,1}; Line(4) = {0,2};
Curve Loop(1) = {0,1,2,3}; Plane Surface(1) = {1};
Curve Loop(2) = {3,0,-4}; Plane Surface(2) = {2};
Point(10) = {-9,-9,0}; Point(11) = {9,-9,0}; Point(12) = {0,9,0}; Line(10) = {10,11}; Line(11) = {11,12}; Line(12) = {12,10};
Curve Loop(4) = {10:12}; Plane Surface(4) = {4,1};   // expect error: surface 4: its boundary runs along curve 0 backwards, and 0 has no sign; give the curve another number
SetFactory("OpenCASCADE");
Coherence; // expect warning: Coherence merges only what is equal here, it cuts nothing: surface 4: its boundary runs along curve 0 backwards, and 0 has no sign; give the curve another number
