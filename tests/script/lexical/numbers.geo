// All numbers are doubles; a point needs digits on one side only.
Printf("%g %g %g %g", 12, 12., .5, 1e3);         // expect: 12 12 0.5 1000
Printf("%.17g", 0.1);                            // expect: 0.10000000000000001
Printf("%.17g", 1.5E-3);                         // expect: 0.0015
Printf("%g %g", 1.e2, 1e+2);                     // expect: 100 100
Printf("%.17g", 123456789012345678);             // expect: 1.2345678901234568e+17
Printf("%.17g", 0.30000000000000004);            // expect: 0.30000000000000004
Printf("%.17g", 4.9e-324);                       // expect: 4.9406564584124654e-324
Printf("%g", 1e400);                             // expect: inf
x = 0.25.;                                       // expect error: this is not a number
x = 3m;                                          // expect error: this is not a number
Printf("%g", {1...3}[0]);                        // expect error: expected ',' or ')'
l[] = {1 ... 3};
Printf("l", l[]);                                // expect: l [0]1 [1]2 [2]3
