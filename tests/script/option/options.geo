// Options: set, changed, read back; deprecated names; display options are accepted.
Mesh.Algorithm = 5; Printf("%g", Mesh.Algorithm); // expect: 5
Mesh.CharacteristicLengthMax = 0.5; Printf("%g", Mesh.MeshSizeMax); // expect: 0.5
Mesh.MeshSizeMax *= 2; Printf("%g", Mesh.CharacteristicLengthMax); // expect: 1
Mesh.MeshSizeMax += 1; Mesh.MeshSizeMax -= 0.5; Mesh.MeshSizeMax /= 2; Printf("%g", Mesh.MeshSizeMax); // expect: 0.75
Mesh.ElementOrder++; Printf("%g", Mesh.ElementOrder); // expect: 2
Mesh.ElementOrder--; Printf("%g", Mesh.ElementOrder); // expect: 1
Mesh.Algoritm = 6;                               // expect error: unknown option 'Mesh.Algoritm'; did you mean 'Mesh.Algorithm'?
Mesch.Algorithm = 6;                             // expect error: unknown option category 'Mesch' in 'Mesch.Algorithm'; did you mean 'Mesh'?
Mesh.Algorithm = 77;                             // expect error: Mesh.Algorithm
Mesh.MeshSizeMax /= 0;                           // expect error: division by zero
Mesh.Algorithm = "six";                          // expect error: the option 'Mesh.Algorithm' needs a number, not a text
Mesh.Algorithm = {1, 2};                         // expect error: the option 'Mesh.Algorithm' needs a number, not a list
Mesh.Reparam = 3;                                // expect warning: unknown option 'Mesh.Reparam' is left out
x = Mesh.Nonsense;                               // expect error: unknown option 'Mesh.Nonsense'
x = a.b.c;                                       // expect error: unknown option category 'a'
Printf("%g", Mesh.NbNodes);                      // expect: 42
Mesh.NbNodes = 3;                                // expect warning: 'Mesh.NbNodes' can only be read
Mesh.Color.Lines = {255, 0, 0}; General.Color.Text = Black; Geometry.Color.Points = Red;
View[0].Visible = 0; View[0].ColorTable = {{1,2,3},{4,5,6}}; PostProcessing.Link = 2; Print.Text = 1;
General.RotationX = 30; General.Trackball = 0; Geometry.PointNumbers = 1; Mesh.Points = 1;
Printf(StrRelative(General.FileName));           // expect: options.geo
Point(1) = {-1, 2, 0}; Point(2) = {3, 4, 0};
Printf("%g %g", General.MinX, General.MaxY);     // expect: -1 4
i = Mesh.ElementOrder++; Printf("%g %g", i, Mesh.ElementOrder); // expect: 1 2
Mesh.SecondOrderLinear = 1; Mesh.Optimize = 1; Mesh.Format = 1; Mesh.MshFileVersion = 2.2;
Printf("%g", Mesh.MshFileVersion);               // expect: 2.2
Mesh.5 = 3;                                      // expect error: expected
General.DefaultFileName = 3;                     // expect error: the option 'General.DefaultFileName' needs a text
