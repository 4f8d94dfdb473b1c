// Include runs a file; variables and macros are shared; paths are relative to the including file.
before = 1;
Include "_included.geo";
Printf("%g", after);                             // expect: 2
Call from_include;                               // expect: macro of the included file
// expect: _included.geo
Include "no_such_file.geo";                      // expect error: cannot read
Include "";                                      // expect error: the name of a file is missing
Include;                                         // expect error: Include needs the name of a file
Merge "_included.geo";
Merge "_mesh.msh";                               // expect: [merge _mesh.msh]
Merge "none.msh";                                // expect error: cannot read
