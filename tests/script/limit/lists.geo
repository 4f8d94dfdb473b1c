// Lists and texts have a length that is enough for all.
l[] = {1:1e9};                                   // expect error: this range has 1000000000 members
l[] = {1:1:1e-300}; Printf("%g", #l[]);          // expect: 1
l[1e9] = 3;                                      // expect error: the index 1e+09 is out of range
m[] = {1:1000};
For i In {1:15}
  m[] += m[];                                    // expect error: this list would have 16384000 members // expect error: this list would
EndFor
