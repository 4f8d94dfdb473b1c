// Printf writes below the script's folder; reading what is not there.
Printf("line %g", 1) > "_written.txt";
Printf("%g %g", 2, 3) >> "_written.txt";
l[] = ListFromFile["_written.txt"]; Printf("l", l[]); // expect: l [0]1 [1]2 [2]3
Printf("x") > "no_such_folder/file.txt";         // expect error: is not allowed
Printf("x") > "";                                // expect error: is not allowed
Merge "no.pos";                                  // expect error: cannot read
Merge "no.geo";                                  // expect error: cannot read
Include StrCat("no", ".geo");                    // expect error: cannot read
