a = 1;
Printf("%g", a); // expect: 1
If (a == 1)
  Printf("crlf"); // expect: crlf
EndIf
b = "x"; Printf(b); // expect: x
