// From loosest: ?: || && == < + * | ! - ^
Printf("%g", -2^2);                              // expect: -4
Printf("%g", 2^3^2);                             // expect: 512
Printf("%g", 2^-1);                              // expect: 0.5
Printf("%g", 1+2*3);                             // expect: 7
Printf("%g", (1+2)*3);                           // expect: 9
Printf("%g", 7-2-1);                             // expect: 4
Printf("%g", 8/4/2);                             // expect: 1
Printf("%g", 2*3|4);                             // expect: 14
Printf("%g", 6&3);                               // expect: 2
Printf("%g", 1<2 == 1);                          // expect: 1
Printf("%g", 1 || 0 && 0);                       // expect: 1
Printf("%g", !0 + 1);                            // expect: 2
Printf("%g", !3);                                // expect: 0
Printf("%g", - -3);                              // expect: 3
Printf("%g", +3);                                // expect: 3
Printf("%g", 1 ? 2 : 3);                         // expect: 2
Printf("%g", 0 ? 2 : 0 ? 3 : 4);                 // expect: 4
Printf("%g", 5 > 3 ? 1 + 1 : 0);                 // expect: 2
Printf("%g %g", 1 << 4, 256 >> 4);               // expect: 16 16
Printf("%g %g", 7 % 3, -7 % 3);                  // expect: 1 -1
Printf("%g", 7.9 % 3.9);                         // expect: 1
Printf("%g %g %g", 1 <= 1, 2 >= 3, 1 != 2);      // expect: 1 0 1
Printf("%g %g", 2 && -1, 0 || 0);                // expect: 1 0
Printf("%g", 2 + 3 == 5);                        // expect: 1
a = 3; b = 4;
Printf("%g", -a^2 + b);                          // expect: -5
Printf("%g", a*-b);                              // expect: -12
Printf("%g", a & b | 8);                         // expect: 8
