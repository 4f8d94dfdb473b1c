Macro f
  Call f;                                        // expect error: macros call one another too deeply
Return
Call f;
