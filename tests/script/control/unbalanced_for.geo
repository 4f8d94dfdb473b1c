a = 1;
For i In {1:2}                                   // expect error: this For has no EndFor
  Printf("%g", i);
