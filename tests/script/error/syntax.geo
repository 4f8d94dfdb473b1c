// Each error is told where it is, and the next statement is run.
Pont(1) = {0,0,0};                               // expect error: unknown statement 'Pont'; did you mean 'Point'?
Circel(1) = {1,2,3};                             // expect error: unknown statement 'Circel'; did you mean 'Circle'?
Phisical Line(1) = {1};                          // expect error: unknown statement 'Phisical'; did you mean 'Physical'?
foo bar;                                         // expect error: unknown statement 'foo'
foo "bar";                                       // expect error: unknown statement 'foo'
Line(1 = {1, 2};                                 // expect error: expected ')', found '='
Line(1) = {1, 2;                                 // expect error: expected ',' or '}' in this list, found ';'
Line(1) = [1, 2];                                // expect error: a list stands in braces
a = (1 + 2;                                      // expect error: expected ')', found ';'
a = Sin(1;                                       // expect error: expected ')' or ']', found ';'
a = 1 +;                                         // expect error: expected a value, found ';'
a = 1 2;                                         // expect error: expected ';', found '2'
b = 3                                            // expect error: expected ';' at the end of this statement
c = 4;
Printf("%g %g", b, c);                           // expect: 3 4
Transfinite;                                     // expect error: expected Curve, Surface or Volume
Attractor Point{1} = {1,2,3};                    // expect error: the short form 'Attractor Point{..} = {..}' was removed
Function Field(1) = "x";                         // expect error: 'Function Field(..)' was removed long ago
Printf("still here");                            // expect: still here
