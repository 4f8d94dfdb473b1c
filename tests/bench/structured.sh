#!/bin/bash
# structured.sh MESHGEN - transfinite squares of N x N cells, triangles and quadrangles, to a binary MSH, ours and gmsh's in turn: medians
# over REPS (7) of the whole process, wall and CPU seconds.
set -u
meshgen=$1 reps=${REPS:-7}
tmp=$(mktemp -d) && trap 'rm -rf "$tmp"' EXIT

median() { sort -n | awk '{ v[NR] = $1 } END { print v[int((NR + 1) / 2)] }'; }
timed() { # timed FILE COMMAND... : append "wall cpu" to FILE
  local file=$1 t
  shift
  t=$( { TIMEFORMAT='%R %U %S'; time "$@" >/dev/null 2>&1; } 2>&1 )
  awk '{ print $1, $2 + $3 }' <<<"$t" >>"$file"
}
column() { awk -v k="$2" '{ print $k }' "$1" | median; }

printf '%-10s %-12s %10s %10s %10s %10s\n' cells elements "wall s" "CPU s" "gmsh wall" "gmsh CPU"
for n in ${SIZES:-300 1000}; do
  for what in triangles quadrangles; do
    recombine=""
    [ $what = quadrangles ] && recombine="Recombine Surface{1};"
    echo "Point(1)={0,0,0};Point(2)={1,0,0};Point(3)={1,1,0};Point(4)={0,1,0};Line(1)={1,2};Line(2)={2,3};Line(3)={3,4};Line(4)={4,1};
Curve Loop(1)={1:4};Plane Surface(1)={1};Transfinite Curve{1:4}=$((n + 1));Transfinite Surface{1};$recombine" >"$tmp/s.geo"
    rm -f "$tmp/us" "$tmp/them"
    for ((i = 0; i < reps; i++)); do
      timed "$tmp/us" "$meshgen" -2 "$tmp/s.geo" -bin -o "$tmp/us.msh"
      command -v gmsh >/dev/null && timed "$tmp/them" gmsh -2 "$tmp/s.geo" -bin -v 0 -nt 1 -o "$tmp/them.msh"
    done
    theirs="- -"
    [ -s "$tmp/them" ] && theirs="$(column "$tmp/them" 1) $(column "$tmp/them" 2)"
    printf '%-10s %-12s %10s %10s %10s %10s\n' "$n" $what "$(column "$tmp/us" 1)" "$(column "$tmp/us" 2)" $theirs
  done
done
