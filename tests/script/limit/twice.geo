// A macro that calls itself twice: stopped by depth, not by 2^200 calls.
Macro f
  Call f; Call f;                                // expect error: macros call one another too deeply
Return
Call f;
