#!/bin/bash
# convert.sh MESHGEN FILE.msh - whole processes that convert the same file, meshgen with one thread and with all, and gmsh, in turn: least of
# RUNS (5), and the ratios
set -eu
meshgen=$1 file=$2 runs=${RUNS:-5}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
TIMEFORMAT='%R %U %S'
# run NAME COMMAND...: one line "NAME wall cpu"
run() {
  local name=$1 t
  shift
  t=$({ time "$@" >/dev/null 2>&1; } 2>&1)
  awk -v n="$name" '{ print n, $1, $2 + $3 }' <<<"$t"
}
for to in msh2 vtk stl msh; do
  for how in "-bin" ""; do
    for _ in $(seq "$runs"); do
      run one "$meshgen" -v 1 "$file" $how -nt 1 -format "$to" -o "$work/a.$to"
      run all "$meshgen" -v 1 "$file" $how -nt 0 -format "$to" -o "$work/a.$to"
      run gmsh gmsh -save -v 1 "$file" $how -format "$to" -o "$work/b.$to"
    done | sed "s/^/$to$how /"
  done
done | awk '{ k = $1 " " $2; if (!(k in w) || $3 < w[k]) w[k] = $3; if (!(k in c) || $4 < c[k]) c[k] = $4; to[$1] }
  END { for (t in to) printf "to %-9s wall: all processors %.3f gmsh %.3f ratio %.1f   cpu: one thread %.3f gmsh %.3f ratio %.1f\n", t,
    w[t " all"], w[t " gmsh"], w[t " gmsh"] / w[t " all"], c[t " one"], c[t " gmsh"], c[t " gmsh"] / c[t " one"] }' | sort
