// Coordinates whose products overflow.
// prepare for meshing
Point(1) = {0, 0, 0};
Point(2) = {1e61, 0, 0}; // expect error: point 2 is at (1e+61, 0, 0): coordinates beyond 1e+60 cannot be computed with
Line(1) = {1, 2};
