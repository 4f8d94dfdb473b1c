For i In {1:5}
  If (i == 2) Exit; EndIf
  Printf("%g", i);                               // expect: 1
EndFor                                           // expect: [exit -1]
