// A branch that never ends; text in branches not taken is not parsed.
If (0)
  anything { goes ( here " If EndIf "
ElseIf (1 == 1)
  Printf("taken");                               // expect: taken
Else
  and ; here = = ;
EndIf
If (1 +)                                         // expect error: expected a value, found ')'
  Printf("a condition that fails is false");
EndIf
If (0)                                           // expect error: this If has no EndIf
  Printf("never");
