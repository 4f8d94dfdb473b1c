// l[] += appends, l[] -= removes the first occurrence of each value, l[i] = v extends with zeros.
l[] = {}; l[] += 1; l[] += {2, 3, 2};
Printf("l", l[]);                                // expect: l [0]1 [1]2 [2]3 [3]2
l[] -= {2};
Printf("l", l[]);                                // expect: l [0]1 [1]3 [2]2
l[] -= 9; Printf("%g", #l[]);                    // expect: 3
l[4] = 8; Printf("l", l[]);                      // expect: l [0]1 [1]3 [2]2 [3]0 [4]8
l[0] += 10; l[1] *= 2; l[2] -= 1; l[4] /= 4;
Printf("l", l[]);                                // expect: l [0]11 [1]6 [2]1 [3]0 [4]2
l[0]++; l(1)--;
Printf("l", l[]);                                // expect: l [0]12 [1]5 [2]1 [3]0 [4]2
y = l[0]++; Printf("%g %g", y, l[0]);            // expect: 12 13
l[{0, 1}] = {5, 6}; Printf("l", l[]);            // expect: l [0]5 [1]6 [2]1 [3]0 [4]2
l[{0, 1}] = {5};                                 // expect error: 2 indices, but 1 values
fresh[2] = 4; Printf("f", fresh[]);              // expect: f [0]0 [1]0 [2]4
s = 3;
s[1] = 4;                                        // expect error: 's' is not a list; make it one first
s += {1, 2};                                     // expect error: 's' is a number: one value is needed, not 2
l[] *= 2;                                        // expect error: a list knows =, += (append) and -= (remove) only
l++;                                             // expect error: 'l' is a list and cannot be counted up or down
grown[] += {7}; Printf("g", grown[]);            // expect: g [0]7
l += 5; Printf("%g", l[5]);                      // expect: 5
l[-2] = 1;                                       // expect error: the index -2 is out of range
s += {4}; Printf("%g", s);                       // expect: 7
none[{0}] += {1};                                // expect error: unknown variable 'none'
l[0] = {1, 2};                                   // expect error: one element of a list can only be assigned a number
t[] = Str("a"); t[1e9] = "b";                    // expect error: the index 1e+09 is out of range
