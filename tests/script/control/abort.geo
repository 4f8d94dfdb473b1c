// Abort leaves the file, not the run.
Include "_aborts.geo";                           // expect: in the aborted file
Printf("after the included file");               // expect: after the included file
Abort;
Printf("never");
