#!/bin/bash
# run.sh [quick|all] - run the built tests and count. Every test program or script prints TAP; the last line is
# "N passed, N failed", before it those that could not be tried here and why. CONFIG (default release) chooses the build; KEEP=1 keeps the scratch folder.
#   quick: unit tests and script tests;  all: also tests/cli/*.sh, which run the program as a user would
set -u
cd "$(dirname "$0")/.." || exit 3
tier=${1:-all}
build=build/${CONFIG:-release}
export MESHGEN=$PWD/$build/meshgen ROOT=$PWD CONFIG=${CONFIG:-release} PYTHONDONTWRITEBYTECODE=1
scratch=$(mktemp -d "${TMPDIR:-/tmp}/meshgen-tests.XXXXXX")
export SCRATCH=$scratch
# Memory that fontconfig (of cairo) keeps for the life of the process is no leak of ours.
export LSAN_OPTIONS=suppressions=$PWD/tests/lsan.supp:print_suppressions=0
passed=0 failed=0
: >"$scratch/skipped"

# run_tap NAME COMMAND... : run one TAP producer; a crash, a non-zero exit without "not ok", or no test at all is a failure
run_tap() {
  local name=$1 out=$scratch/tap.out status ok bad
  shift
  "$@" >"$out" 2>"$scratch/tap.err"
  status=$?
  ok=$(grep '^ok ' "$out" | grep -vc '# SKIP')
  grep '^ok .*# SKIP' "$out" | sed "s|^ok [0-9]* - |skipped: [$name] |" >>"$scratch/skipped"
  bad=$(grep -c '^not ok ' "$out")
  if [ "$bad" -eq 0 ] && { [ $status -ne 0 ] || [ "$ok" -eq 0 ]; }; then
    bad=1
    echo "not ok - $name: exit status $status after $ok tests"
    tail -n 20 "$scratch/tap.err"
  fi
  grep -A 12 '^not ok ' "$out" | sed "s|^not ok|not ok [$name]|"
  [ "$bad" -gt 0 ] && tail -n 20 "$scratch/tap.err"
  passed=$((passed + ok)) failed=$((failed + bad))
  printf '%-40s %4d passed, %d failed\n' "$name" "$ok" "$bad"
}

for t in $build/unit/test_*; do
  case $t in *.d | *.o) continue ;; esac
  [ -x "$t" ] && run_tap "$(basename "$t")" "$t"
done
for s in tests/script/run_*.sh; do [ -e "$s" ] && run_tap "$(basename "$s" .sh)" bash "$s"; done
if [ "$tier" = all ]; then
  for s in tests/cli/*.sh; do [ -e "$s" ] && [ "$s" != tests/cli/lib.sh ] && run_tap "$(basename "$s" .sh)" bash "$s"; done
fi
cat "$scratch/skipped"
[ "${KEEP:-0}" = 1 ] || rm -rf "$scratch"
echo "$passed passed, $failed failed"
[ "$failed" -eq 0 ] && [ "$passed" -gt 0 ]
