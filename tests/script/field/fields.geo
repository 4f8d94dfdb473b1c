// Fields and views.
Field[1] = Distance; Field[1].PointsList = {1, 2}; // expect note: made here
Field[1].Sampling = 50;
Field[2] = Threshold; Field[2].InField = 1; Field[2].SizeMin = 0.1;
Field[3] = MathEval; Field[3].F = "F2 + Sin(z)";
Field[4] = Attractor; Field[4].NodesList = {1:3}; Field[4].NNodesByEdge = 20;
l[] = {1, 2}; Field[5] = Min; Field[5].FieldsList = {l[]};
Field(6) = Box; Field(6).VIn = 1;
Field[newf] = Max; Printf("%g", newf);           // expect: 8
Field[1] = Distance;                             // expect error: 1
Field[20] = Distence;                            // expect error: Distance
Field[1].Samplings = 3;                          // expect error: Sampling
Field[30].VIn = 3;                               // expect error: 30
Background Field = 5;
BoundaryLayer Field = {1, 2}; BoundaryLayer Field = 1;
Background Field = {1, 2};                       // expect error: the background field is one field
Background Mesh View[0];
Background = 3; Printf("%g", Background);        // expect: 3
View "v" {
  ST(0,0,0, 1,0,0, 0,1,0){1, 2, 3};
  SP(0,0,0){1};
  T2(1, 2, 3){"text"};
  TIME{1, 2};
};
View "w" { ST(0,0,0){1}; };                      // expect error: ST
View "x" { S };                                  // expect error: expected '{'
Merge "_view.pos";
Delete Field[1];
Delete Field[1];                                 // expect error: 1
Delete View[0];
Plugin(Crack).Dimension = 1;
Plugin(Crack).Run;                               // expect error: Plugin(Crack) is not supported
Plugin(Isosurface).Run;                          // expect warning: Plugin(Isosurface) is left out
Field[2];                                        // expect error: expected '=' and a type, or '.' and an option
Printf("%g", Field[2].SizeMin);                  // expect: 0.1
