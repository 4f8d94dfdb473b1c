// A negative size is none.
Point(1) = {0,0,0,-1};                                   // expect warning: the mesh size -1 is negative: the point has none
Point(2) = {1,0,0};
MeshSize{1,2} = -2;                                      // expect warning: the mesh size -2 is negative: the points have none
