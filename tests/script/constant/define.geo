// DefineConstant defines what does not exist yet; a named one asks the parameters.
// given number forced 7
// given number plain 8
// given number Parameters/B 3
// given string Parameters/S set
// given list L 4 5
DefineConstant[ a = 1, b = {2, Name "Parameters/B", Min 0, Max 5, Step 1, Choices{1="one", 2}, Visible 0, Highlight "Red"} ];
Printf("%g %g", a, b);                           // expect: 1 3
DefineConstant[ forced = 1 ]; Printf("%g", forced); // expect: 7
plain = 1; Printf("%g", plain);                  // expect: 1
DefineConstant[ a = 5 ]; Printf("%g", a);        // expect: 1
DefineConstant[ s = {"x", Name "Parameters/S"}, t = "plain" ];
Printf(s); Printf(t);                            // expect: set
// expect: plain
DefineConstant[ l[] = {{1,2,3}, Name "Parameters/L"}, m[] = {4,5} ];
Printf("%g %g", #l[], #m[]);                     // expect: 3 2
DefineConstant[ c ]; Printf("%g", c);            // expect: 0
DefineConstant[ d = 1
                e = 2 ];
Printf("%g %g", d, e);                           // expect: 1 2
DefineConstant[ r = {6, Name "Parameters/B", ReadOnly 1} ];
Printf("%g", r);                                 // expect: 6
DefineConstant[ braced = {9} ]; Printf("%g", braced); // expect: 9
DefineConstant[ L[] = {1} ]; Printf("%g %g", #L[], L[1]); // expect: 2 5
v = DefineNumber[ 10, Name "Parameters/B" ]; Printf("%g", v); // expect: 6
v = DefineNumber[ 11, Name "Parameters/New", Min 1 ]; Printf("%g", v); // expect: 11
v = DefineNumber[ 12, Name "Parameters/New" ]; Printf("%g", v); // expect: 11
u = DefineString[ "abc", Name "Parameters/T" ]; Printf(u); // expect: abc
Printf("%g %g", GetNumber("Parameters/New"), GetNumber("Parameters/None", -1)); // expect: 11 -1
SetNumber("Parameters/New", 13); Printf("%g", GetNumber("Parameters/New")); // expect: 13
SetString("Parameters/T", "new"); Printf(GetString("Parameters/T")); // expect: new
Printf("%g", GetValue("a question?", 5));        // expect: 5
UndefineConstant["Parameters/New"];
DefineConstant[ w = {1, Name} ];                 // expect error: expected a value
DefineConstant[ x = 1                            // comment
];
Printf("%g", x);                                 // expect: 1
SetNumber("only a name");                        // expect error: SetNumber needs a name and a value
DefineConstant( y = 2 ); Printf("%g", y);        // expect: 2
