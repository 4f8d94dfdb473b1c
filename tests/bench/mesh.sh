#!/bin/bash
# mesh.sh BENCH_REFINE MESHGEN - refinement and gmsh on the unit square and the rectangle of the size field, side by side.
# CPU seconds of one thread. LARGE=1 adds a million triangles (gmsh takes minutes). Quality of gmsh's meshes is measured by
# ours after reading them back, where meshgen can; else only times are compared.
set -u
bench=$1 meshgen=$2
tmp=$(mktemp -d) && trap 'rm -rf "$tmp"' EXIT

cpu() { # cpu COMMAND... : user + system seconds of it
  local t
  t=$( { TIMEFORMAT='%U %S'; time "$@" >/dev/null 2>&1; } 2>&1 )
  awk '{printf "%.2f", $1 + $2}' <<<"$t"
}
square() { # square H : a .geo of the unit square
  echo "Point(1) = {0, 0, 0, $1}; Point(2) = {1, 0, 0, $1}; Point(3) = {1, 1, 0, $1}; Point(4) = {0, 1, 0, $1};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Line Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};"
}

sizes="0.0152 0.0048"
[ "${LARGE:-0}" = 1 ] && sizes="$sizes 0.00152"
printf '%-10s %-5s %12s %14s %12s %8s\n' h algo "refine CPU s" "meshgen CPU s" "gmsh CPU s" "gmsh/us"
for h in $sizes; do
  square "$h" >"$tmp/s.geo"
  for algo in 5 6 1; do
    case $algo in 5) name=del2d ;; 6) name=front2d ;; 1) name=meshadapt ;; esac
    [ $algo = 1 ] && [ "$h" = 0.00152 ] && continue
    alone=$("$bench" square "$h" -algo $algo -reps 3 | sed 's/.*refine \([0-9.]*\) s.*/\1/')
    ours=$(cpu "$meshgen" -2 "$tmp/s.geo" -algo $name -nt 1 -o "$tmp/us.msh")
    theirs=-
    command -v gmsh >/dev/null && theirs=$(cpu gmsh -2 "$tmp/s.geo" -algo $name -nt 1 -v 0 -o "$tmp/them.msh")
    ratio=$(awk -v a="$theirs" -v b="$ours" 'BEGIN {if (a == "-") print "-"; else printf "%.1f", a / b}')
    printf '%-10s %-5s %12s %14s %12s %8s\n' "$h" $algo "$alone" "$ours" "$theirs" "$ratio"
  done
done
echo
echo "quality (each line: what bench_refine prints)"
for algo in 5 6 1; do "$bench" square 0.0048 -algo $algo; done
for scale in 1 0.1 0.03; do "$bench" rect $scale; done
"$bench" square 0.0048 -angle 30
