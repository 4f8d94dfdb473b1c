s = "0123456789";
For i In {1:18}
  s = StrCat(s, s);                              // expect error: this text would have 1310720 bytes
EndFor
Printf("%g", StrLen(s));                         // expect: 0
For i In {1:1e6}
  v~{i} = "0123456789";
  For j In {1:100} w[] = {1:1000}; EndFor        // expect error: the script does not come to an end
EndFor
