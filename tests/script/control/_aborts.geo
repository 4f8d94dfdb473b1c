Printf("in the aborted file");
Abort;
Printf("never");
