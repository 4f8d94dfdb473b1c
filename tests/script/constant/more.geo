// Rarer forms of DefineConstant.
// given number Mesh.ElementOrder 2
// given number View[0].Visible 0
// given string General.DefaultFileName abc
// given list P/list 7 8
DefineConstant[ l[] = {{1}, Name "P/list"}, m = {1, 2, 3}, t[] = Str("a", "b"), u = {"x", Name "P/text"} ];
Printf("%g %g %g", #l[], l[1], #m[]);            // expect: 2 8 3
Printf(t[1]); Printf(u);                         // expect: b
// expect: x
DefineConstant[ v = {"y", Name "P/text"}, w = {1, Name "P/w", ReadOnly 1, Choices {0="no", 1="yes"}} ];
Printf(v);                                       // expect: x
Printf("%g", Mesh.ElementOrder);                 // expect: 2
Printf(General.DefaultFileName);                 // expect: abc
x = General.DefaultFileName + 1;                 // expect error: the option 'General.DefaultFileName' is a text
