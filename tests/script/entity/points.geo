// Points: 3 coordinates or 4 numbers with the mesh size; braces or parentheses; sums of vectors.
Point(1) = {0, 0, 0};
Point(2) = {1, 0, 0, 0.1};                       // expect note: made here
Point(3) = (1, 1, 0);
Point(4) = {0, 0, 0} + {0, 1, 0};
Point(newp) = {5, 5, 0} - {1, 1, 0, 0};          // expect error: lists of 3 and 4 members cannot be added
Point(6) = -{1, 2, 3};
Printf("%g %g %g", Point{6});                    // expect: -1 -2 -3
p[] = Point{2}; Printf("p", p[]);                // expect: p [0]1 [1]0 [2]0
Point(7) = {1, 2};                               // expect error: a point needs 3 coordinates {x, y, z}, or 4 numbers with the mesh size; 2 given
Point(8) = {0, 0, 0, 1, 2, 3};                   // expect error: 6 given
Point(2) = {7, 7, 7};                            // expect error: point 2 exists already
Point(-3) = {0, 0, 0};                           // expect error: a tag must be positive, not -3
Point("x") = {0, 0, 0};                          // expect error: a number is needed here, not a text
Point(1e300) = {0, 0, 0};                        // expect error: is too large here
Printf("%g", newp);                              // expect: 8
Point(newp) = {p[0], p[1], 1};
Printf("%g", newp);                              // expect: 9
x[] = Point{99};                                 // expect error: there is no point 99
Point(20) = {0, 0, nothing};                     // expect error: unknown variable 'nothing'
Printf("%g %g %g", Point{20});                   // expect: 0 0 0
all[] = Point{:}; Printf("all", all[]);          // expect: all [0]1 [1]2 [2]3 [3]4 [4]5 [5]6 [6]7 [7]8 [8]20
all[] = Point "*"; Printf("%g", #all[]);         // expect: 9
Geometry.ScalingFactor = 10;
Point(30) = {1, 2, 3};
Printf("%g %g %g", Point{30});                   // expect: 10 20 30
Point 31 = {0, 0, 0};                            // expect error: expected 'In' (to embed) or '(tag) =' (to define), found '='
Point(32) {0, 0, 0};                             // expect error: expected '=', found '{'
