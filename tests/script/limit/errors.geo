// After 20 errors the run ends; one place in a loop is told three times at most.
For i In {1:100}
  x~{i} = unknown~{i};                           // expect error: 'unknown_1' // expect error: 'unknown_2' // expect error: 'unknown_3'
EndFor
y = one_more_0; // expect error: one_more_0
y = one_more_1; // expect error: one_more_1
y = one_more_2; // expect error: one_more_2
y = one_more_3; // expect error: one_more_3
y = one_more_4; // expect error: one_more_4
y = one_more_5; // expect error: one_more_5
y = one_more_6; // expect error: one_more_6
y = one_more_7; // expect error: one_more_7
y = one_more_8; // expect error: one_more_8
y = one_more_9; // expect error: one_more_9
y = one_more_10; // expect error: one_more_10
y = one_more_11; // expect error: one_more_11
y = one_more_12; // expect error: one_more_12
y = one_more_13; // expect error: one_more_13
y = one_more_14; // expect error: one_more_14
y = one_more_15; // expect error: one_more_15
y = one_more_16; // expect error: one_more_16
Printf("never");
