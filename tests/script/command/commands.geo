// Commands that the program around the script carries out.
Mesh 2;                                          // expect: [generate 2]
n = 1; Mesh n;                                   // expect: [generate 1]
RefineMesh;                                      // expect: [refine 0]
RecombineMesh;                                   // expect: [recombine 0]
SetOrder 2;                                      // expect: [order 2]
OptimizeMesh "Laplace2D";                        // expect: [optimize 0Laplace2D]
RenumberMeshNodes;                               // expect: [renumber nodes 0]
RenumberMeshElements;                            // expect: [renumber elements 0]
PartitionMesh 4;                                 // expect: [partition 4]
BarycentricRefineMesh;                           // expect: [barycentric 0]
Save "out.msh";                                  // expect: [save out.msh]
Save StrCat("out", ".vtk");                      // expect: [save out.vtk]
Print "out.png";                                 // expect: [save out.png]
Delete Meshes;                                   // expect: [delete 0]
Save;                                            // expect error: Save needs the name of a file
SystemCall "echo hello";                         // expect error: SystemCall is not allowed
System "echo hello";                             // expect error: System is not allowed
Draw; Sleep 1; SyncModel; BoundingBox; SetName "x"; SetChanged;
BoundingBox {0,1,0,1,0,1};
NewModel;
Printf("x") > "/etc/meshgen-must-not-write";     // expect error: is not allowed: it lies outside the working folder
Printf("x") > "../../../../meshgen-must-not-write"; // expect error: is not allowed
Combine ElementsByViewName;                      // expect error: Combine is post-processing
ClassifySurfaces {1, 2};                         // expect error: ClassifySurfaces is not supported
CreateGeometry;                                  // expect error: CreateGeometry is not supported
OnelabRun("x", "y");                             // expect error: OnelabRun is not supported
