For i In {1:2}
  Point(newp) = {0, 0, 0}; i = 1;                // expect error: the script does not come to an end
EndFor
