// Numbers: = += -= *= /= ++ --
x = 3; x += 2; Printf("%g", x);                  // expect: 5
x -= 1; Printf("%g", x);                         // expect: 4
x *= 3; Printf("%g", x);                         // expect: 12
x /= 8; Printf("%g", x);                         // expect: 1.5
x++; Printf("%g", x);                            // expect: 2.5
x--; Printf("%g", x);                            // expect: 1.5
y = x++; Printf("%g %g", y, x);                  // expect: 1.5 2.5
y = x-- + 10; Printf("%g %g", y, x);             // expect: 12.5 1.5
z = nowhere + 1;                                 // expect error: unknown variable 'nowhere'
Printf("%g", z);                                 // expect: 1
z = nowhere + 2;
Printf("%g", z);                                 // expect: 2
count = 3; w = cuont;                            // expect error: unknown variable 'cuont'; did you mean 'count'?
fresh += 1;                                      // expect error: unknown variable 'fresh'
fresher++;                                       // expect error: unknown variable 'fresher'
3 = x;                                           // expect error: expected a statement, found '3'
(x) = 3;                                         // expect error: expected a statement, found '('
x = ;                                            // expect error: expected a value, found ';'
x == 3;                                          // expect error: expected
newp = 3;                                        // expect error: 'newp' is a word of the language
a.5 = 3;                                         // expect error: unknown statement 'a'
