// A size below zero is none, and said to be.
Point(1) = {0, 0, 0, -0.5};                              // expect warning: the mesh size -0.5 is negative: the point has none
Point(2) = {1, 0, 0};
MeshSize{ 2 } = -1;                                      // expect warning: the mesh size -1 is negative: the points have none
