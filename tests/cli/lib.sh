# lib.sh - sourced by the command-line tests: TAP, scratch folder, small assertions
# Uses MESHGEN (the program), ROOT (the tree), SCRATCH (a folder that is removed), all set by tests/run.sh.
here=$(cd "$(dirname "$0")" && pwd)
ROOT=${ROOT:-$(cd "$here/../.." && pwd)}
MESHGEN=${MESHGEN:-$ROOT/build/release/meshgen}
PYTHON=${PYTHON:-/usr/bin/python3}
work=$(mktemp -d "${SCRATCH:-/tmp}/cli.XXXXXX")
cd "$work" || exit 3
# A child that is killed before it becomes the program it was started for may still run this.
trap '[ "$BASHPID" != "$$" ] || rm -rf "$work"' EXIT
count=0

# ok NAME | not_ok NAME [DETAIL...]
ok() { count=$((count + 1)); echo "ok $count - $1"; }
not_ok() {
  count=$((count + 1))
  echo "not ok $count - $1"
  shift
  for line in "$@"; do printf '%s\n' "$line" | sed 's/^/# /' | head -n 15; done
}

# skip NAME REASON: it cannot be tried here; the run says so and does not count it as passed
skip() {
  count=$((count + 1))
  echo "ok $count - $1 # SKIP $2"
}

# check NAME COMMAND...: passes if the command succeeds
check() {
  local name=$1
  shift
  if out=$("$@" 2>&1); then ok "$name"; else not_ok "$name" "$*" "$out"; fi
}

# exits CODE NAME COMMAND...: passes if the exit status is CODE; output is left in $out (stdout) and $err (stderr)
exits() {
  local want=$1 name=$2 got
  shift 2
  "$@" >out.txt 2>err.txt </dev/null
  got=$?
  out=$(cat out.txt) err=$(cat err.txt)
  if [ "$got" = "$want" ]; then ok "$name"; else not_ok "$name" "exit status $got, want $want" "$err"; fi
}

# says TEXT NAME: passes if $err contains TEXT;  prints TEXT NAME: the same for $out
says() { case $err in *"$1"*) ok "$2" ;; *) not_ok "$2" "want: $1" "got: $err" ;; esac; }
prints() { case $out in *"$1"*) ok "$2" ;; *) not_ok "$2" "want: $1" "got: $out" ;; esac; }

# same NAME FILE FILE: equal bytes;  absent NAME FILE: no such file
same() { if cmp -s "$2" "$3"; then ok "$1"; else not_ok "$1" "$2 and $3 differ"; fi; }
absent() { if [ ! -e "$2" ]; then ok "$1"; else not_ok "$1" "$2 exists"; fi; }
