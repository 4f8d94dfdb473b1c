#!/bin/bash
# limits.sh - scripts that would not end or would take all memory: a clear error, within 1 GB and a few seconds of processor time
. "$(dirname "$0")/lib.sh"
"$PYTHON" "$ROOT/tests/cli/limits.py" >cases.txt
ulimit -v 1048576 # KB
ulimit -t 10      # seconds; most take hundredths, the longest one or two
while IFS=$'\t' read -r name status text; do
  exits "$status" "$name" "$MESHGEN" -2 "$name.geo" -o a.msh -no_report
  case $err in
  *"$text"*) [ "${#err}" -lt 100000 ] && ok "$name: it is said, in few words" || not_ok "$name" "${#err} bytes of messages" ;;
  *) not_ok "$name" "want: $text" "got: ${err:0:300}" ;;
  esac
done <cases.txt
ok "all ran"
