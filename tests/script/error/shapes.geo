// prepare for meshing: what is said of the model as a whole
Point(1) = {0,0,0}; Point(2) = {1,0,0}; Point(3) = {1,1,0}; Point(4) = {0,1,0}; Point(5) = {-1,0,0}; Point(6) = {1.05,0,0};
Circle(1) = {2,1,2};                                     // expect error: circle arc 1 runs from point 2 to itself; an arc is shorter than a half turn: make a full turn of two or more
Circle(2) = {1,1,2};                                     // expect error: circle arc 2 has its start at its centre
Circle(3) = {2,1,5} Plane {0,0,0};                       // expect error: the plane of circle arc 3 has a normal of length 0
Circle(4) = {2,1,5} Plane {1,0,0};                       // expect error: circle arc 4 is a half circle, and the plane {1, 0, 0} does not contain it; write 'Plane {nx, ny, nz}' after it
Point(7) = {0,1.1,0}; Circle(5) = {2,1,7};               // expect warning: circle arc 5 misses its end point 7: it is 1.1 from the centre, the start 1
Ellipse(6) = {2,1,3,5};                                  // expect error: no ellipse with centre 1 and an axis towards point 3 passes through the ends 2 and 5 of arc 6
Point(11) = {5,0,0}; Point(12) = {6,0,0}; Point(13) = {7,0,0}; Line(11) = {11,12}; Line(12) = {12,13}; Line(13) = {13,11};
Curve Loop(11) = {11:13}; Plane Surface(11) = {11};      // expect error: the outer loop 11 of surface 11 lies on a line and encloses no area
Point(21) = {5,5,0}; Point(22) = {6,5,0}; Point(23) = {6,6,1}; Point(24) = {5,6,0};
Line(21) = {21,22}; Line(22) = {22,23}; Line(23) = {23,24}; Line(24) = {24,21}; Curve Loop(21) = {21:24}; Plane Surface(21) = {21}; // expect warning: surface 21 is not plane: its boundary is up to 0.204124 off its mean plane
Nurbs(8) = {1, 4} Knots {0, 1, 1, 2} Order 1;            // expect error: the knots of Nurbs 8 leave no span
