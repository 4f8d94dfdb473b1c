#!/bin/bash
# batch.sh MESHGEN - start to finish of one small model, and a thousand models in one call against calls of gmsh.
# gmsh is called GMSH_CALLS times (default 50) and its time is scaled to 1,000 calls.
set -eu
meshgen=$(readlink -f "$1") calls=${GMSH_CALLS:-50}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
for i in $(seq 1000); do
  cat >"m$i.geo" <<END
h = 0.15 + $i / 100000;
Point(1) = {0, 0, 0, h}; Point(2) = {1, 0, 0, h}; Point(3) = {1, 1, 0, h}; Point(4) = {0, 1, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Physical Curve("sides") = {1:4}; Physical Surface("square") = {1};
END
done
# best N COMMAND...: least wall time of N runs, in seconds
best() {
  local n=$1 least=1e9 a b
  shift
  for _ in $(seq "$n"); do
    a=$EPOCHREALTIME
    "$@" >/dev/null 2>&1
    b=$EPOCHREALTIME
    least=$(awk -v a="$a" -v b="$b" -v l="$least" 'BEGIN { t = b - a; print t < l ? t : l }')
  done
  echo "$least"
}
one=$(best 20 "$meshgen" -2 m1.geo)
echo "one model, $("$meshgen" m1.msh --json | sed -n 's/ *"triangles": \([0-9]*\),/\1/p') triangles, start to finish: $one s (least of 20)"
two=$(best 5 "$meshgen" -2 m*.geo -nt 0)
single=$(best 5 "$meshgen" -2 m*.geo -nt 1)
echo "1000 models in one call: $single s with one thread, $two s with one per processor (least of 5)"
a=$EPOCHREALTIME
for i in $(seq "$calls"); do gmsh -2 "m$i.geo" -o g.msh >/dev/null 2>&1; done
b=$EPOCHREALTIME
awk -v a="$a" -v b="$b" -v n="$calls" -v s="$single" -v t="$two" 'BEGIN {
  g = (b - a) / n * 1000
  printf "gmsh: %d calls took %.2f s; 1000 calls would take %.1f s: %.0f times as long (%.0f with threads)\n", n, b - a, g, g / s, g / t }'
