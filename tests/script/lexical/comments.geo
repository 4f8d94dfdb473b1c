// Comments end at the line or at the first */; strings may hold anything.
a = 1; // b = 2;
/* a = 2;
   // */ c = 3; /* one line */ d = 4;
Printf("%g %g %g", a, c, d);                     // expect: 1 3 4
s = "no // comment /* here */";
Printf(s);                                       // expect: no // comment /* here */
t = 'single quotes "hold" double ones';
Printf(t);                                       // expect: single quotes "hold" double ones
Printf("no escapes: \n");                        // expect: no escapes: \n
Printf("%g", Exists(b));                         // expect: 0
x = 1 /* in the middle */ + /* of it */ 2;
Printf("%g", x);                                 // expect: 3
