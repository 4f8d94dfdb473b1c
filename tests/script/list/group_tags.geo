// All groups of a dimension; a copy of each with its name and tag made from the old ones.
Point(1) = {0,0,0}; Point(2) = {1,0,0}; Point(3) = {0,1,0};
Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,1};
Physical Line("base", 7) = {1};
Physical Line("rest", 3) = {2,3};
Physical Point(9) = {1};
g[] = Physical Line "*";
Printf("g", g[]);                                       // expect: g [0]3 [1]7
Printf("p", Physical Point{:});                         // expect: p [0]9
Printf("s %g", #g[] + #g[]);                            // expect: s 4
none() = Physical Surface{:};
Printf("%g", #none());                                  // expect: 0
For k In {0:#g[]-1}
  Physical Line(Str(StrCat(Physical Line{g[k]}, " again")), g[k] + 100) = { Translate {0,0,1} { Duplicata { Line{Physical Line{g[k]}}; } } };
EndFor
Printf(Physical Line{103});                             // expect: rest again
Printf("m", Physical Line{103}, Physical Line{107});    // expect: m [0]10 [1]11 [2]104
