// A range includes its end; a negative step counts down; the variable ends beyond.
For i In {1:3}
  Printf("%g", i);                               // expect: 1
EndFor                                           // expect: 2
Printf("after %g", i);                           // expect: 3
// expect: after 4
For i In {2:1:-1} Printf("down %g", i); EndFor   // expect: down 2
// expect: down 1
For i In {1:2:0.5} Printf("%g", i); EndFor       // expect: 1
// expect: 1.5
// expect: 2
For i In {3:1} Printf("never"); EndFor
Printf("%g", i);                                 // expect: 3
For (1:2) Printf("anonymous"); EndFor            // expect: anonymous
// expect: anonymous
For i In {1:10}
  Printf("jump %g", i);                          // expect: jump 1
  i += 5;                                        // expect: jump 7
EndFor
n = 0;
For i In {0:2} For j In {0:i} n += 1; EndFor EndFor
Printf("%g", n);                                 // expect: 6
For i In {1:3:0} EndFor                          // expect error: the step of a loop cannot be 0
For i In {1:2}; Printf("x%g", i); EndFor;        // expect warning: this ';' is superfluous // expect warning: this ';' is superfluous
// expect: x1
// expect: x2
For k~{1} In {1:2} Printf("%g", k_1); EndFor     // expect: 1
// expect: 2
For i In {1,2} EndFor                            // expect error: expected ':' between the bounds of the loop
For i {1:2} EndFor                               // expect error: expected 'In'
