after = before + 1;
If (!Exists(loaded))
  Macro from_include
    Printf("macro of the included file");
    Printf(inner);
  Return
EndIf
loaded = 1; inner = CurrentFileName;
