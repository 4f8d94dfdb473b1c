// Delete forgets a variable, Delete Variables all of them.
a = 1; b = 2; s = "text";
Delete a;
Printf("%g %g", Exists(a), Exists(b));           // expect: 0 1
Delete a;                                        // expect error: unknown variable 'a'
Delete s;
Printf("%g", Exists(s));                         // expect: 0
Delete Variables;
Printf("%g", Exists(b));                         // expect: 0
