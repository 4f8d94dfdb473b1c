// Macros have no parameters; all variables are global.
Macro square                                     // expect note: it was defined here
  result = x*x;
Return
x = 3; Call square; Printf("%g", result);        // expect: 9
Function old
  Printf("Function is Macro");                   // expect: Function is Macro
Return
Call old;
Macro "by text" Printf("named by a text"); Return
Call "by text";                                  // expect: named by a text
Macro factorial
  If (n > 1)
    f *= n; n -= 1;
    Call factorial;
  EndIf
Return
n = 5; f = 1; Call factorial; Printf("%g", f);   // expect: 120
Macro early
  Printf("before");                              // expect: before
  If (1)
    Return
  EndIf
  Printf("not reached");
Return
Call early;
Call nowhere;                                    // expect error: unknown macro 'nowhere'
Call squares;                                    // expect error: unknown macro 'squares'; did you mean 'square'?
Macro square Return                              // expect error: the macro 'square' exists already

Macro fails
  y = undefined_thing;                           // expect error: unknown variable 'undefined_thing'
Return
Call fails;
For i In {1:2} Call old; EndFor                  // expect: Function is Macro
// expect: Function is Macro
name = "square"; x = 4; Call name; Printf("%g", result); // expect: 16
