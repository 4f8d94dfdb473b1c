#!/bin/bash
# distance.sh MESHGEN - sizes by the distance to 10^5 curves, beside gmsh: processor time of 1D meshing of 20 lines across a coastline
# (2 million edges), less that of the same lines with sizes by a formula. CURVES sets another number of curves.
set -eu
meshgen=$(readlink -f "$1") n=${CURVES:-100000}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
# write FIELD: the coast (its curves get one edge each) and the lines, sized by that field
write() {
  awk -v n="$n" -v field="$1" 'BEGIN {
    for (i = 0; i < n; i++) {
      a = 2 * 3.14159265358979 * i / n
      r = 1 + 0.1 * sin(7 * a) + 0.02 * sin(61 * a) + 0.003 * sin(997 * a)
      printf "Point(%d) = {%.15g, %.15g, 0};\n", i + 1, r * cos(a), r * sin(a)
    }
    for (i = 0; i < n; i++) printf "Line(%d) = {%d, %d};\n", i + 1, i + 1, (i + 1) % n + 1
    printf "Transfinite Line {1:%d} = 2;\n", n
    for (k = 0; k < 20; k++) {
      p = n + 2 * k + 1
      y = -1.14 + 0.12 * k
      printf "Point(%d) = {-1.2, %g, 0}; Point(%d) = {1.2, %g, 0}; Line(%d) = {%d, %d};\n", p, y, p + 1, y + 0.01, n + k + 1, p, p + 1
    }
    printf "Field[1] = Distance; Field[1].EdgesList = {1:%d};\n", n
    print "Field[2] = Threshold; Field[2].IField = 1; Field[2].LcMin = 2e-5; Field[2].LcMax = 3e-5;"
    print "Field[2].DistMin = 0.01; Field[2].DistMax = 0.5;"
    print "Field[3] = MathEval; Field[3].F = \"2.5e-5 + 0 * x\";"
    printf "Background Field = %d; Mesh.CharacteristicLengthFromPoints = 0;\n", field
  }' >"field$1.geo"
}
ours() { "$meshgen" -1 "field$1.geo" -nt 1 -bin -o out.msh | awk '$1 == "mesh" && $2 == "1D" { print $4 }'; }
theirs() { gmsh -1 "field$1.geo" -nt 1 -bin -v 5 -o out.msh | sed -n 's/.*Done meshing 1D.*CPU \([0-9.e-]*\)s.*/\1/p'; }
write 2
write 3
row() { awk -v name="$1" -v with="$2" -v without="$3" 'BEGIN { printf "%-10s %8.3f s with Distance and Threshold, %8.3f s with a formula\n", name, with, without }'; }
a=$(ours 2) b=$(ours 3)
row meshgen "$a" "$b"
command -v gmsh >/dev/null || { echo "no gmsh to compare with"; exit 0; }
c=$(theirs 2) d=$(theirs 3)
row gmsh "$c" "$d"
awk -v a="$a" -v b="$b" -v c="$c" -v d="$d" 'BEGIN { printf "all of 1D meshing %.1f times faster; what the distance adds %.1f times less\n", c / a, (c - d) / (a - b) }'
