EndFor                                           // expect error: this EndFor has no For
EndIf                                            // expect error: this EndIf has no If
Else                                             // expect error: this Else has no If
ElseIf (1)                                       // expect error: this ElseIf has no If
Return                                           // expect error: this Return belongs to no Macro
For i In {1:1}                                   // expect error: this For has no EndFor
  Else
EndFor                                           // expect error: this EndFor has no For
If (1)                                           // expect error: this If has no EndIf
  Printf("taken");                               // expect: taken
