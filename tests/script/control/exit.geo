Printf("before");                                // expect: before
Exit 3;                                          // expect: [exit 3]
Printf("never");
