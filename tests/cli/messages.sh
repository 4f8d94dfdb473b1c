# messages.sh - every message of the command line, the readers and writers, the mesher and the audit is provoked by a test
. "$(dirname "$0")/lib.sh"
"$PYTHON" "$here/messages.py" "$MESHGEN" "$ROOT"
