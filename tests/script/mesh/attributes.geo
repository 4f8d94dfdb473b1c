// What a script says about meshing; nothing of it changes the geometry.
Point(1) = {0,0,0,1}; Point(2) = {1,0,0,1}; Point(3) = {1,1,0,1}; Point(4) = {0,1,0,1}; Point(5) = {0.5,0.5,0,1};
Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,4}; Line(4) = {4,1}; Line(5) = {1,5};
Curve Loop(1) = {1,2,3,4}; Plane Surface(1) = {1};
MeshSize{1, 2} = 0.1; MeshSize{:} = 0.2; Characteristic Length{1:3} = 0.3; MeshSize{ PointsOf{ Surface{1}; } } = 0.1;
Characteristic Length Field{1};                  // expect error: 'Characteristic Length Field' was removed long ago
MeshSize{1};                                     // expect error: expected '=' and the mesh size
Transfinite Line{1, -3} = 10;
Transfinite Curve{2} = 10 Using Progression 1.1; Transfinite Curve{4} = 10 Using Power 1.1;
Transfinite Curve{1} = 10 Using Bump 0.1; Transfinite Curve{1} = 5 Using Beta 1.1;
Transfinite Curve{:} = 8;
Transfinite Curve{2} = 10 Using Linear 3;        // expect error: unknown law 'Linear': Progression, Bump or Beta
Transfinite Curve{2} = 10 Using Bump_HWall 3;    // expect error: Using Bump_HWall is not supported
Transfinite Curve{2};                            // expect error: expected '=' and the number of nodes
Transfinite Curve{2} = 1e9;                      // expect error: 1000000000 nodes on a curve are too many
Transfinite Surface{1}; Transfinite Surface{1} = {1,2,3,4}; Transfinite Surface "*";
Transfinite Surface{1} = {1,2,3,4} Left; Transfinite Surface{1} Right; Transfinite Surface{:} Alternate;
Transfinite Surface{1} AlternateRight; Transfinite Surface{1} AlternateLeft; Transfinite Surface{1} Alternated;
Transfinite Surface{1} Sideways;                 // expect warning: unknown arrangement 'Sideways', taken as Alternate
Transfinite Surface{1} = {1,2,3,4,5};            // expect error: a transfinite surface has 3 or 4 corners, not 5
Transfinite Volume{1} = {1,2}; TransfQuadTri{1};
ReorientMesh Volume{1}; // expect warning: 'ReorientMesh' is left out
Transfinite Point{1};                            // expect error: expected Curve, Surface or Volume after 'Transfinite'
Recombine Surface{1}; Recombine Surface{1} = 30; Recombine Surface{:}; Recombine Volume{1};
Smoother Surface{1} = 4; MeshAlgorithm Surface{1} = 5; MeshSizeFromBoundary Surface{1} = 0;
Smoother Surface{1};                             // expect error: expected '=' and a number
ReverseMesh Curve{1}; Reverse Surface{1}; RelocateMesh Point{1}; Degenerated Curve{1};
Point{5} In Surface{1}; Curve{5} In Surface{1}; Point{5} In Volume{1};
Point{5} In Curve{1};                            // expect error: expected 'Surface' or 'Volume'
Surface{1} In Surface{1};                        // expect error: only points and curves can be embedded in a surface
Periodic Curve{1} = {-3}; Periodic Line{1} = {-3} Translate{0, -1, 0};
Periodic Curve{2} = {4} Rotate{{0,0,1}, {0,0,0}, Pi};
Periodic Curve{1, 2} = {3};                      // expect error: 2 periodic entities, but 1 masters
Compound Curve{1, 2};
Compound Surface{1};
Hide { Line{1}; } Show "*"; Hide {:} Color Red { Surface{1}; } Color {255, 0, 0} { Line{1}; } Recursive Hide { Surface{1}; }
Hide "*"; Show { Point{1}; };
Delete Embedded { Surface{1}; }
SetMaxTag Point(100); Printf("%g", newp);        // expect: 101
Levelset Plane(1) = {0,0,1,0};                   // expect error: Levelset is not supported
Homology{{1},{2}};                               // expect warning: Homology is left out: no chains are computed here
AdaptMesh {1};                                   // expect error: AdaptMesh is not supported
Periodic Surface {1} = {1} Translate {0, 0, 1}; Periodic Surface 1 {1} = 1 {3};
