// Texts, lists and numbers where another kind is needed.
s = "text"; l[] = {1, 2}; n = 3; e[] = {}; t[] = Str("a", "b");
x = 1 + s;                                       // expect error: 's' is a text, a number is needed here
x = e;                                           // expect error: the list 'e' is empty
y = s[0]; Printf(y);                             // expect: text
x = 1 + s[0];                                    // expect error: 's' is a text, a number is needed here
x = n[0] + n[];                                  // expect error: a list can only be negated, or scaled
m[] = {n[]}; Printf("%g", #m[]);                 // expect: 1
m[] = {t[]}; Printf(m[1]);                       // expect: b
m[] = {1, t[]};                                  // expect error: 't' holds texts, numbers are needed here
m[] = none[{0}];                                 // expect error: unknown variable 'none'
m[] = {:};                                       // expect error: {:} stands for all entities and has no meaning here
m[] = Abs({-1, -2}); Printf("m", m[]);           // expect: m [0]1 [1]2
x = StrCat("a") + 1;                             // expect error: StrCat gives a text, a number is needed here
m[] = 2 * Str("a");                              // expect error: Str gives texts, numbers are needed here
Line(1e10) = {1, 2};                             // expect error: is too large here
Point(1) = {0,0,0}; Line(1) = {1, 1e10};         // expect error: 1e+10 cannot be a tag
c = n > 2 ? 1 : 0; d = n < 2 || n == 3; Printf("%g %g", c, d); // expect: 1 1
a = n; b = Atan2(a, a) > 0 ? Max(a, 7) : Hypot(a, a); Printf("%g", b); // expect: 7
u = n > 2 ? "yes" : "no"; Printf(u);             // expect: yes
r[] = l[] ? 1 : 2;                               // expect error: a number is needed here, not a list
q = n ? l[] : 1;                                 // expect error: '? :' chooses between numbers, not lists
q[] = {l[]:3};                                   // expect error: the bounds of a range are numbers, not lists
Printf(unset_text);                              // expect error: unknown variable 'unset_text'
j = Str("one", "two"); Printf("%g", StrLen(j));  // expect: 7
v = Sign(-3) + Sign(2) + Sign(0); Printf("%g", v); // expect: 0
w = Asinh(0) + Acosh(1) + Atanh(0); Printf("%g", w); // expect: 0
y = 7 | ; z = 1;                                 // expect error: expected a value, found ';'
y = @3;                                          // expect error: placeholder of a template
y = Max(1, 2, 3);                                // expect error: Max takes 2 arguments, not 3
y = StrSub("abc");                               // expect error: StrSub takes 2 to 3 arguments, not 1
