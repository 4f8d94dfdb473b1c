// name~{i} builds name_i; StringToName makes a name of a text.
For i In {1:3}
  p~{i} = 10*i;
EndFor
Printf("%g %g %g", p_1, p~{2}, p_3);             // expect: 10 20 30
a~{1}~{2} = 5; Printf("%g", a_1_2);              // expect: 5
q~{2.7} = 6; Printf("%g", q_2);                  // expect: 6
l~{1}[] = {1,2,3}; Printf("%g", l_1[2]);         // expect: 3
S2N["dynamic"] = 8; Printf("%g", dynamic);       // expect: 8
Printf("%g", StringToName["dynamic"] + 1);       // expect: 9
Printf(NameToString(dynamic));                   // expect: dynamic
Printf(N2S(p~{2}));                              // expect: p_2
Printf("%g %g", Exists(p_1), Exists(p_9));       // expect: 1 0
Printf("%g %g", Exists(p~{2}), Exists(p~{9}));   // expect: 1 0
Printf("%g", Exists(l_1[]));                     // expect: 1
Printf("%g %g", GetForced(p_1), GetForced(none, 4)); // expect: 10 4
x = p~{7};                                       // expect error: unknown variable 'p_7'
