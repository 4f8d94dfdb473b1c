// If, ElseIf, Else; a branch that is not taken may hold anything.
a = 2;
If (a == 1)
  Printf("one");
ElseIf (a == 2)
  Printf("two");                                 // expect: two
ElseIf (a == 2)
  Printf("two again");
Else
  Printf("other");
EndIf
If (a == 3) this is { not ( a statement; "EndIf" // EndIf
Else Printf("else"); EndIf                       // expect: else
If (a) If (0) Printf("no"); Else Printf("inner"); EndIf EndIf // expect: inner
If (a == 9) If (1) Printf("no"); Else Printf("no"); EndIf Else Printf("outer"); EndIf // expect: outer
If (a > 1 && a < 3) Printf("between"); EndIf     // expect: between
If (!a) Printf("no"); EndIf
If (a == 2) Printf("x"); EndIf;                  // expect warning: superfluous
// expect: x
If (missing) Printf("no"); Else Printf("unknown is 0"); EndIf // expect error: unknown variable 'missing'
// expect: unknown is 0
For i In {1:4}
  If (i == 1)
    Printf("first");                             // expect: first
  ElseIf (i == 2)
    Printf("second");                            // expect: second
  Else
    If (i == 3) Printf("third"); EndIf           // expect: third
    If (i == 9) nonsense nonsense; EndIf
  EndIf
EndFor
For i In {1:2}
  If (i == 1) broken here; EndIf                 // expect error: unknown statement 'broken'
EndFor
If 1 Printf("no parentheses"); EndIf             // expect: no parentheses
