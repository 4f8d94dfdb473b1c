// Functions take parentheses or brackets; angles are radians.
Printf("%.6f", Sin(1));                          // expect: 0.841471
Printf("%.6f", Cos[1]);                          // expect: 0.540302
Printf("%.6f", Tan(1));                          // expect: 1.557408
Printf("%.6f", Asin(0.5));                       // expect: 0.523599
Printf("%.6f", Acos(0.5));                       // expect: 1.047198
Printf("%.6f", ArcCos(0.5));                     // expect: 1.047198
Printf("%.6f", Atan(1));                         // expect: 0.785398
Printf("%.6f", Atan2(1, -1));                    // expect: 2.356194
Printf("%.6f", Sinh(1));                         // expect: 1.175201
Printf("%.6f", Cosh(1));                         // expect: 1.543081
Printf("%.6f", Tanh(1));                         // expect: 0.761594
Printf("%.6f", Exp(1));                          // expect: 2.718282
Printf("%.6f", Log(10));                         // expect: 2.302585
Printf("%.6f", Log10(1000));                     // expect: 3.000000
Printf("%.6f", Sqrt(2));                         // expect: 1.414214
Printf("%g %g", Fabs(-3), Abs(-4));              // expect: 3 4
Printf("%g %g", Floor(-1.5), Ceil(-1.5));        // expect: -2 -1
Printf("%g %g", Round(2.5), Round(-2.5));        // expect: 3 -2
Printf("%g %g", Fmod(7, 3), Modulo(7.5, 2));     // expect: 1 1.5
Printf("%g", Hypot(3, 4));                       // expect: 5
Printf("%g %g", Min(2, 3), Max(2, 3));           // expect: 2 3
Printf("%g %g", Step(-0.1), Step(0));            // expect: 0 1
Printf("%.12g %.12g %.12g", Rand(1), Rand(1), Rand(2)); // expect: 0.840187717155 0.394382926819 1.56619844752
For i In {1:1000} r = Rand(1); EndFor
Printf("%.12g", Rand(1));                        // expect: 0.460067454008
Printf("%.9f", Pi);                              // expect: 3.141592654
x = 2;
Printf("%g", Sqrt(x*x + 12));                    // expect: 4
y = Sin(1, 2);                                   // expect error: Sin takes 1 argument, not 2
y = Atan2(1);                                    // expect error: Atan2 takes 2 arguments, not 1
y = Sine(1);                                     // expect error: unknown variable 'Sine'; did you mean
y = Squareroot(1, 2);                            // expect error: unknown function 'Squareroot'
y = Hypott(1, 2);                                // expect error: unknown function 'Hypott'; did you mean 'Hypot'?
Printf("%g", GMSH_MAJOR_VERSION >= 4);           // expect: 1
Printf("%g %g %g", MPI_Size, MPI_Rank, TestLevel); // expect: 1 0 0
Printf("%g", GMSH_MINOR_VERSION + GMSH_PATCH_VERSION > 0); // expect: 1
Printf("%g %g %g", Cpu >= 0, Memory > 0, TotalMemory >= 0); // expect: 1 1 1
