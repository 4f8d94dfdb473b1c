// Names are letters, digits and _, case-sensitive; words of the language cannot be names.
_a1 = 1; A = 2; a = 3;
Printf("%g %g %g", _a1, A, a);                   // expect: 1 2 3
Step = 3;                                        // expect error: 'Step' is a word of the language
Length = 3;                                      // expect error: 'Length' is a word of the language
Min = 1;                                         // expect error: 'Min' is a word of the language
For In In {1:2} EndFor;                          // expect error: 'In' is a word of the language
Left = 4; Mesh = 5; Save = 6; View = 7;
Printf("%g %g %g %g", Left, Mesh, Save, View);   // expect: 4 5 6 7
Point = 3;                                       // expect error: expected a value, found '='
n::x = 1;                                        // expect error: this cannot be assigned to
