Macro f                                          // expect error: this Macro has no Return
  x = 1;
