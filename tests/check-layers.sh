#!/bin/sh
# check-layers.sh - the include law: which folder of src/ may include headers of which
set -eu
cd "$(dirname "$0")/.."
grep -rn '^#include "' src --include='*.c' --include='*.h' --include='*.cc' | awk -F: '
BEGIN {
  may["base"] = " base "
  may["geom"] = " base geom "
  may["opt"] = " base opt "
  may["tri"] = " base geom tri "
  may["quad"] = " base geom quad "
  may["model"] = " base geom model "
  may["size"] = " base geom model opt size "
  may["script"] = " base geom model size opt script "
  may["mesh"] = " base geom tri quad model size opt mesh "
  may["out"] = " base geom mesh model out "
  may["cli"] = " base geom opt tri quad model size script mesh out cli "
}
{
  split($1, path, "/"); from = path[2]
  line = $3; sub(/^#include "/, "", line); sub(/".*/, "", line)
  if (line ~ /\.def$/) next
  split(line, target, "/"); to = target[1]
  if (line !~ /\//) { print $1 ":" $2 ": include by folder/file.h: " line; bad++ }
  else if (index(may[from], " " to " ") == 0) { print $1 ":" $2 ": " from " may not include " line; bad++ }
  else if (line ~ /_int\.h$/ && from != to) { print $1 ":" $2 ": private header " line; bad++ }
}
END { if (bad) { print bad " violations"; exit 1 } print "layers respected" }'
