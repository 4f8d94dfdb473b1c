// Functions that give lists.
l[] = {3, -1, 3, 2};
Printf("u", Unique(l[]));                        // expect: u [0]-1 [1]2 [2]3
Printf("a", Abs(l[]));                           // expect: a [0]3 [1]1 [2]3 [3]2
Printf("n", LinSpace[0, 1, 3]);                  // expect: n [0]0 [1]0.5 [2]1
Printf("n", LogSpace[0, 2, 3]);                  // expect: n [0]1 [1]10 [2]100
Printf("%g %g", Find(l[], {3}), Find({1,2}, {5})); // expect: 2 0
Printf("n", List[{1,2}]);                        // expect: n [0]1 [1]2
Printf("f", ListFromFile["_numbers.txt"]);       // expect: f [0]1 [1]2.5 [2]-3
x[] = ListFromFile["none.txt"];                  // expect error: cannot read
x[] = LinSpace[0, 1, 1e12];                      // expect error: LinSpace of 1e+12 members
Printf("c", Catenary[0, 2, 1, 1, 0.5, 3]);       // expect: c [0]0.618468 [1]0.5 [2]0.618468
Printf("c", Catenary[0, 2, 1, 1.5, 0.7, 1]);     // expect: c [0]0.724136
Printf("c", Catenary[2, 0, 1, 1.5, 0.7, 5]);     // expect: c [0]0.79458 [1]0.705646 [2]0.724136 [3]0.851933 [4]1.10206
x[] = Catenary[0, 1, 0, 1, 0.5, 3];              // expect error: there is no chain from (0, 0) to (1, 1) whose lowest point is at 0.5
x[] = Catenary[0, 1, 0, 1, 0, 1e9];              // expect error: Catenary of 1e+09 members
v[] = {1,2,3} + {10,20,30}; Printf("v", v[]);    // expect: v [0]11 [1]22 [2]33
v[] = {1,2} + {1,2,3};                           // expect error: lists of 2 and 3 members cannot be added
