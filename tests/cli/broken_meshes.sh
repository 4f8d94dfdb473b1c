# broken_meshes.sh - the audit finds what was broken by hand, in every format that can hold it
. "$(dirname "$0")/lib.sh"
"$PYTHON" "$here/broken_meshes.py" "$MESHGEN"
