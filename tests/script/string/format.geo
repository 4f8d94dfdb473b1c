// Formats: C's for doubles; without % the list is shown.
l[] = {1, 2};
Printf("plain");                                 // expect: plain
Printf("100%% sure");                            // expect: 100% sure
Printf("%g%%", 5);                               // expect: 5%
Printf("[%5.2f] [%-6g] [%+g] [%e]", 1, 2, 3, 4); // expect: [ 1.00] [2     ] [+3] [4.000000e+00]
Printf("%d items of %x", 3.7, 255);              // expect: 3 items of ff
Printf("list:", l[]);                            // expect: list: [0]1 [1]2
Printf("%g-%g", l[]);                            // expect: 1-2
Printf("%g %g", 1);                              // expect error: too few numbers for this format: 1 given
Printf("%g", 1, 2);                              // expect error: too many numbers for this format: it uses 1 of 2
Printf("<%s>", 1);                               // expect warning: '%s' in this format is not for numbers, and stays as it is
// expect: <%s>
Printf("<%>", 1);                                // expect warning: in this format is not for numbers
// expect: <%>
Printf("%999999g", 1);                           // expect error: this format has a number wider than 500 characters
s = Sprintf("<%g>");                             // expect warning: no numbers for this format: '%g' stays as it is
Printf(s);                                       // expect warning: no numbers for this format // expect: <%g>
Printf("50% sure");                              // expect: 50% sure
Printf(3);                                       // expect error: a text is needed here
Printf("a" 3);                                   // expect error: expected ',' or ')', found '3'
Error("own error %g", 3);                        // expect error: own error 3
Warning("own warning %g", 4);                    // expect warning: own warning 4
Printf["brackets"];                              // expect: brackets
