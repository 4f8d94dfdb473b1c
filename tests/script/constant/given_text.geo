// -string is run before the file; options stay, variables go.
// given text Mesh.Algorithm = 5; lost = 3;
Printf("%g %g", Mesh.Algorithm, Exists(lost));   // expect: 5 0
