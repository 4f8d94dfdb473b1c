#!/bin/bash
# quads.sh MESHGEN BENCH_QUADS [N [LEMON]] - quadrangles side by side: the matching on uniform frontal meshes up to N triangles
# against LEMON (up to LEMON triangles), the recombination of the same triangles against gmsh's, and the meshes of both.
# Times are processor seconds of one thread. Without gmsh its lines are left out.
set -u
meshgen=$1 bench=$2 most=${3:-300000} lemon=${4:-35000}
root=$(cd "$(dirname "$0")/../.." && pwd)
tmp=$(mktemp -d) && trap 'rm -rf "$tmp"' EXIT
cat >"$tmp/square.geo" <<'G'
DefineConstant[ h = {0.007} ];
Point(1) = {0, 0, 0, h}; Point(2) = {1, 0, 0, h}; Point(3) = {1, 1, 0, h}; Point(4) = {0, 1, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};
G
echo "== matching alone, dual graphs of frontal meshes of the square and of lattices"
files=()
for n in 10000 31623 48000 100000 316228 1000000; do
  [ "$n" -le "$most" ] || break
  h=$(awk "BEGIN { printf \"%.6f\", sqrt(2.31 / $n) }")
  "$meshgen" -2 "$tmp/square.geo" -setnumber h "$h" -algo front2d -nt 1 -v 1 -no_report -format msh2 -o "$tmp/square_$n.msh" && files+=("$tmp/square_$n.msh")
done
"$bench" "$most" "$lemon" "${files[@]}"

seconds() { # seconds COMMAND...: user seconds of it, in $took
  local TIMEFORMAT=%U
  took=$( { time timeout 300 "$@" >"$tmp/log" 2>&1; } 2>&1)
}
one() { # one TITLE FILE SIZE OPTIONS...
  local file=$2 size=$3
  echo "== $1"
  shift 3
  seconds "$meshgen" -2 "$file" "$@" -nt 1 -format msh2 -o "$tmp/m.msh"
  printf '%8.2f s  ' "$took" && "$bench" measure meshgen "$tmp/m.msh" "$size"
  grep -E 'indices|matching' "$tmp/log"
  command -v gmsh >/dev/null || return
  rm -f "$tmp/g.msh"
  seconds gmsh -2 "$file" "$@" -nt 1 -format msh22 -o "$tmp/g.msh"
  if [ -s "$tmp/g.msh" ]; then printf '%8.2f s  ' "$took" && "$bench" measure gmsh "$tmp/g.msh" "$size"; else echo "gmsh: no mesh"; fi
}
if command -v gmsh >/dev/null; then
  echo "== recombination of 48,000 triangles: with less without it, seconds"
  for tool in "$meshgen" gmsh; do
    seconds "$tool" -2 "$tmp/square.geo" -setnumber h 0.00694 -algo front2d -nt 1 -format msh2 -o "$tmp/x.msh" && plain=$took
    seconds "$tool" -2 "$tmp/square.geo" -setnumber h 0.00694 -algo front2d -nt 1 -format msh2 -o "$tmp/x.msh" \
      -setnumber Mesh.RecombineAll 1 && both=$took
    echo "$(basename "$tool") $(awk "BEGIN { printf \"%.2f\", $both - $plain }")"
  done
fi
for method in 0 1 2 3 4; do
  one "the book's rectangle, method $method" "$root/geo/seed_rectangle.geo" rectangle -setnumber Mesh.RecombineAll 1 -setnumber Mesh.RecombinationAlgorithm $method
done
one "the book's rectangle, algorithm 8" "$root/geo/seed_rectangle.geo" rectangle -algo delquad -setnumber Mesh.RecombineAll 1
for algorithm in front2d delquad; do
  one "square, h = 0.007, $algorithm" "$tmp/square.geo" 0.007 -algo $algorithm -setnumber Mesh.RecombineAll 1
done
