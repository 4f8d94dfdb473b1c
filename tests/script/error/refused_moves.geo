// What is said of extrusions, transforms, splits and embedding that cannot be done.
Point(1) = {0,0,0}; Point(2) = {1,0,0}; Point(3) = {1,1,0}; Point(4) = {0,1,0}; Point(5) = {0,0,1};
Line(1) = {1,2}; Line(2) = {1,5}; Spline(3) = {1,2,3}; Circle(4) = {2,1,4};
Extrude { Line{2}; Layers{3, 0.1}; }                     // expect error: Extrude along the normals: curve 2 is not in a plane of constant z
Extrude { Line{1}; }                                     // expect error: Extrude without a vector (along the normals) needs Layers
Extrude {{0,0,0}, {0,0,0}, 1} { Point{1}; }              // expect error: the axis of this rotation has length 0
Extrude {{0,0,1}, {0,0,0}, 4} { Point{2}; }              // expect error: cannot extrude by an angle of 4: an arc turns by pi at most; extrude in two steps
Extrude {0,0,1} { Line{1}; Layers{{0}, {1}}; }
Extrude {0,0,1} { Line{1}; Layers{{1,1}, {1, 0.5}}; }    // expect error: Layers: heights must increase, but 1 is followed by 0.5
Extrude {1e300*1e300,0,0} { Line{1}; }                   // expect error: this extrusion is not finite
Extrude {0,0,1} { Volume{1}; }                           // expect error: cannot extrude a volume
Extrude {0,0,1} { Line{77}; }                            // expect warning: Extrude: there is no curve 77
Translate {1,0,0} { Line{77}; }                          // expect error: cannot transform curve 77: it does not exist
Translate {1e300*1e300,0,0} { Line{1}; }                 // expect error: this transformation has no finite coefficients (an axis or a normal of length 0?)
Split Curve {3} Point {4};                               // expect warning: cannot split curve 3 at point 4, which is none of its control points
Split Curve {77} Point {2};                              // expect error: cannot split curve 77: it does not exist
Split Curve {4} Point {2};                               // expect error: cannot split curve 4: only lines, splines and B-splines can be split
Periodic Curve {1} = {1};                                // expect warning: curve 1 cannot be periodic with itself
Point{1} In Surface{9};                                  // expect error: cannot embed in surface 9: it does not exist
Line Loop(1) = {1}; 
Point(11) = {5,5,0}; Point(12) = {6,5,0}; Point(13) = {6,6,0}; Line(11) = {11,12}; Line(12) = {12,13}; Line(13) = {13,11}; Line Loop(2) = {11:13}; Plane Surface(2) = {2};
Line{77} In Surface{2};                                  // expect error: cannot embed curve 77 in surface 2: it does not exist
Transfinite Surface{2} = {11, 12};                       // expect error: Transfinite Surface needs 3 or 4 corner points, not 2
