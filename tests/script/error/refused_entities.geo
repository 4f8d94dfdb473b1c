// What is said of definitions that cannot stand.
Point(1) = {0,0,0}; Point(2) = {1,0,0}; Point(3) = {1,1,0}; Point(4) = {0,1,0}; Point(5) = {2,2,0};
Line(2000000000) = {1, 2};                               // expect error: curve tag 2000000000 is not between 0 and 1073741823
Point(6) = {1e300*1e300, 0, 0};                          // expect error: coordinates of point 6 are not finite (inf, 0, 0)
Line(1) = {-1, 2};                                       // expect error: Line 1: a point has no sign, but -1 was given
Circle(1) = {1, 2};                                      // expect error: Circle 1 needs 3 points {start, centre, end}, not 2
Ellipse(1) = {1, 2};                                     // expect error: Ellipse 1 needs 4 points {start, centre, on the major axis, end}, not 2
Nurbs(1) = {1, 2, 3} Knots {0, 1} Order 2;               // expect error: Nurbs 1 has 3 points and 2 knots; there must be (points + degree + 1) knots, degree from 1 to points - 1
Nurbs(1) = {1, 2, 3} Knots {0, 0, 1, 0.5, 1} Order 1;    // expect error: knots of Nurbs 1 must not decrease, but 1 is followed by 0.5
Nurbs(1) = {1, 2, 3} Knots {0, 0, 0, 0, 0, 0} Order 2;   // expect error: knots of Nurbs 1 are all the same
Line(1) = {1, 1};                                        // expect warning: Line 1 begins and ends at the same point 1: it has no length
Compound Spline(2) = {} Using 5;                         // expect error: Compound Spline 2 names no curve
Line(11) = {1,2}; Line(12) = {2,3}; Line(13) = {3,4}; Line(14) = {4,1};
Curve Loop(1) = {};                                      // expect error: curve loop 1 names no curve
Plane Surface(1) = {7};                                  // expect error: surface 1 uses curve loop 7, but there is no curve loop yet
Curve Loop(2) = {11:14};
Plane Surface(1) = {2, 2};                               // expect error: surface 1 names curve loop 2 twice
Plane Surface(1) = {};                                   // expect error: Plane Surface 1 needs at least one curve loop
Point(21) = {.2,.2,0}; Point(22) = {.4,.2,0}; Point(23) = {.4,.4,0};
Line(21) = {21,22}; Line(22) = {22,23}; Line(23) = {23,21}; Curve Loop(3) = {21:23};
Surface(1) = {2, 3};
Physical Curve("abc") = {11};
Physical Curve("abd") += {12};                           // expect error: there is no physical curve "abd" to change with '+='; did you mean "abc"?
Physical Curve("zzzzzz") += {12};                        // expect error: there is no physical curve "zzzzzz" to change with '+='; the first statement needs '='
Nurbs(3) = {1, 2, 3} Knots {0, 1, 2} Order 2;            // expect error: Nurbs 3 has 3 points and 3 knots; there must be (points + degree + 1) knots, degree from 1 to points - 1
