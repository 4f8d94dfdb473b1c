// Lists with attributes: their members in braces of their own or not, variables among them, attributes of any kind after them.
b[] = {10, 2, 3}; w = 4;
DefineConstant[
  l1[] = {b[], Name "P/1"}
  l2[] = {w, b[0], 2*w, Name "P/2", Visible (w == 4)}
  l3() = {w, w, Min -1, Name "P/3"},
  l4[] = {{w, 5}, Name "P/4"}
  l5[] = {w}
  l6[] = {}
  l7 = {w, 7}
  s1 = {w, Visible (w > 3), Name "P/5"}
  s2 = {w, Min -w}
  s3 = {Min(w, 3), Max 5}
  s4 = {Mesh.Algorithm, AutoCheck 0, Name "P/6"}
  s5 = {Pi, Name "P/7"}
  l8[] = {1:3, Name StrCat("P/", "8")}
];
Printf("l1", l1[]);                                     // expect: l1 [0]10 [1]2 [2]3
Printf("l2", l2[]);                                     // expect: l2 [0]4 [1]10 [2]8
Printf("l3", l3[]);                                     // expect: l3 [0]4 [1]4
Printf("l4", l4[]);                                     // expect: l4 [0]4 [1]5
Printf("%g %g %g %g", #l5[], #l6[], #l7[], l7[1]);      // expect: 1 0 2 7
Printf("%g %g %g %g %g", s1, s2, s3, s4, s5);           // expect: 4 4 3 6 3.14159
Printf("l8 %g", GetNumber("P/5"), l8[]);                // expect error: too many
