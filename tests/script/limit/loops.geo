// Loops that do not end, or nearly so.
For i In {1:1e12} x = i; EndFor                  // expect error: this loop would run 1000000000000 times
For i In {1:1e9} EndFor                          // expect error: this loop would run 1000000000 times
For i In {0:1:1e-300} EndFor                     // expect error: this loop would run
For i In {1:2} i = 1; EndFor                     // expect error: the script does not come to an end
