// Texts and the functions on them.
s = "abc"; t = StrCat(s, "def", '-');
Printf(t);                                       // expect: abcdef-
Printf(Sprintf("%g and %03g", 1.5, 7));          // expect: 1.5 and 007
Printf(StrPrefix("dir.d/file.geo"));             // expect: dir.d/file
Printf(StrPrefix("dir.d/file"));                 // expect: dir.d/file
Printf(StrRelative("a/b/file.geo"));             // expect: file.geo
Printf(StrReplace("a-b-c", "-", "+"));           // expect: a+b+c
Printf(StrSub("abcdef", 2));                     // expect: cdef
Printf(StrSub("abcdef", 1, 3));                  // expect: bcd
Printf(StrChoice(1 < 2, "yes", "no"));           // expect: yes
Printf(StrCat(UpperCase("aBc"), LowerCase("aBc"), LowerCaseIn("ABC"))); // expect: ABCabcAbc
Printf("%g %g", StrLen("four"), StrFind("haystack", "st")); // expect: 4 1
Printf("%g %g %g", StrCmp("a", "b"), StrCmp("a", "a"), StrCmp("b", "a")); // expect: -1 0 1
l[] = Str("one", "two"); l[] += Str("three");
Printf("%g", #l[]);                              // expect: 3
Printf(l[1]);                                    // expect: two
Printf(StrCat(l[]));                             // expect: onetwothree
l[1] = "2"; Printf(l(1));                        // expect: 2
Printf(l[7]);                                    // expect error: 'l[7]' does not exist: the list has 3 members
copy = s; Printf(copy);                          // expect: abc
x = s + 1;                                       // expect error: 's' is a text, a number is needed here
y = 3; Printf(y);                                // expect error: 'y' is a number, a text is needed here
Printf(StrCat("a", 3));                          // expect error: a text is needed here, not a number
z = "a" + 1;                                     // expect error: a number is needed here, not a text
z = Sin("a");                                    // expect error: a number is needed here, not a text
y = "now a text"; Printf(y);                     // expect: now a text
y = 5; Printf("%g", y);                          // expect: 5
Printf(CurrentFileName);                         // expect: strings.geo
Printf(StrRelative(StrSub(CurrentDir, 0, StrLen(CurrentDir) - 1))); // expect: string
Printf(DirName("a/b.c"));                        // expect: a/
Printf("%g", StrLen(Today) > 10);                // expect: 1
Printf(OnelabAction);                            // expect: compute
Printf(StrCat("[", GetEnv("NO_SUCH_VARIABLE_HERE"), "]")); // expect: []
Printf(GetString("Some/Name", "default"));       // expect: default
Printf(GetStringValue("a question?", "answer")); // expect: answer
Printf(GetForcedStr(s));                         // expect: abc
Printf(GetForcedStr(unset, "other"));            // expect: other
Printf(StrRelative(FixRelativePath("x.msh")));   // expect: x.msh
Printf("%g", StrLen(AbsolutePath("strings.geo")) > 11); // expect: 1
Printf("%g", StrLen(GmshExecutableName) > 0);    // expect: 1
Printf("%g %g", FileExists("strings.geo"), FileExists("nothing.geo")); // expect: 1 0
Printf("%g", TextAttributes("Align", "Center")); // expect: 0
s += "def"; Printf(s);                           // expect: abcdef
s -= "def";                                      // expect error: a text knows = and += only
both = 3; both = "three"; Printf(both); Printf("%g", both); // expect: three
// expect: 3
name = "Mesh.Algorithm"; Printf("%g", StrFind(name, "Algo")); // expect: 1
