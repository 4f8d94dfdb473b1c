// Lists: literals, ranges, splicing, elements.
l[] = {1, 2, 3};
Printf("l", l[]);                                // expect: l [0]1 [1]2 [2]3
Printf("%g %g", l[0], l(2));                     // expect: 1 3
Printf("%g %g", #l[], #l());                     // expect: 3 3
m() = {l[], 7, l(), 1:3};
Printf("m", m[]);                                // expect: m [0]1 [1]2 [2]3 [3]7 [4]1 [5]2 [6]3 [7]1 [8]2 [9]3
Printf("r", 3:1);                                // expect: r [0]3 [1]2 [2]1
r[] = {1:2:0.5}; Printf("r", r[]);               // expect: r [0]1 [1]1.5 [2]2
r[] = {5:1:-2}; Printf("r", r[]);                // expect: r [0]5 [1]3 [2]1
r[] = {1:3:-1}; Printf("%g", #r[]);              // expect: 0
r[] = 4:6; Printf("r", r[]);                     // expect: r [0]4 [1]5 [2]6
r[] = {1:2:0};                                   // expect error: the step of a range cannot be 0
e[] = {}; Printf("%g", #e[]);                    // expect: 0
Printf("sub", m[{0, 3}]);                        // expect: sub [0]1 [1]7
Printf("neg", -l[]);                             // expect: neg [0]-1 [1]-2 [2]-3
Printf("scale", 2*l[]);                          // expect: scale [0]2 [1]4 [2]6
n[] = 3*{1,2}; Printf("n", n[]);                 // expect: n [0]3 [1]6
n[] = -{1,2}; Printf("n", n[]);                  // expect: n [0]-1 [1]-2
x = {1,2,3}; Printf("%g %g", x, #x[]);           // expect: 1 3
x = {4}; Printf("%g %g", x, #x[]);               // expect: 4 1
x = l[]; Printf("%g", #x[]);                     // expect: 3
y = l[]*2;                                       // expect error: a list can only be negated, or scaled
y[] = {{1,2},3};                                 // expect error: a list cannot hold a list in braces
y[] = {1,2,};                                    // expect error: a list must not end with a comma
y = l[9];                                        // expect error: 'l[9]' does not exist: the list has 3 members
y = l[-1];                                       // expect error: 'l[-1]' does not exist
y[] = l[{0, 5}];                                 // expect error: 'l[5]' does not exist
y[] = none[];                                    // expect error: unknown variable 'none'
y = #nope[];                                     // expect error: unknown variable 'nope'
y[] = {1 2};                                     // expect error: expected ',' or '}' in this list, found '2'
y = 1 + l[1.9]; Printf("%g", y);                 // expect: 3
