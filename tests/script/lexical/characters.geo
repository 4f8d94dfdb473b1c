// What is no token is reported where it stands, and the rest of the statement is skipped.
a = ${size};                                     // expect error: placeholder of a template
b = 3 \ 2;                                       // expect error: a backslash means nothing here
c = `x`;                                         // expect error: a backquote means nothing here
d = 3 " + 4; e = 2; "; Printf("%g", 1);          // expect error: expected ';', found a string
// expect: 1
é = 3;                                           // expect error: letters beyond ASCII
f = 3;
Printf("%g", f);                                 // expect: 3
