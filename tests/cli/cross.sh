#!/bin/bash
# cross.sh - meshes made for quads: lattices in a square, quality with sizes that vary, every variant of recombination, any thread count
. "$(dirname "$0")/lib.sh"
cat >square.geo <<'G'
Point(1) = {0, 0, 0, 0.02}; Point(2) = {1, 0, 0, 0.02}; Point(3) = {1, 1, 0, 0.02}; Point(4) = {0, 1, 0, 0.02};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
G
# Two faces with a common curve, a hole, an embedded curve and an embedded point.
cat >faces.geo <<'G'
h = 0.05;
Point(1) = {0, 0, 0, h}; Point(2) = {1, 0, 0, h}; Point(3) = {2, 0.3, 0, h}; Point(4) = {2, 1, 0, h}; Point(5) = {1, 1.2, 0, h}; Point(6) = {0, 1, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 1}; Line(7) = {2, 5};
Point(11) = {0.5, 0.5, 0, h}; Point(12) = {0.7, 0.5, 0, h / 2}; Point(13) = {0.3, 0.5, 0, h / 2};
Circle(11) = {12, 11, 13}; Circle(12) = {13, 11, 12};
Point(21) = {1.3, 0.5, 0, h}; Point(22) = {1.7, 0.8, 0, h}; Line(21) = {21, 22}; Point(23) = {1.2, 0.9, 0, h};
Curve Loop(1) = {1, 7, 5, 6}; Curve Loop(2) = {11, 12}; Plane Surface(1) = {1, 2};
Curve Loop(3) = {2, 3, 4, -7}; Plane Surface(2) = {3};
Curve {21} In Surface {2}; Point {23} In Surface {2};
G
# Long edges beside a fine point: the mesh of the field splits edges of the boundary, not exactly on them.
cat >needle.geo <<'G'
Point(1) = {0, 0, 0, 5}; Point(2) = {9, 3, 0, 5}; Point(3) = {8.7, 3.95, 0, 5}; Point(4) = {-0.3, 0.95, 0, 5}; Point(5) = {3, 1.05, 0, 0.05};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1:4}; Plane Surface(1) = {1}; Point {5} In Surface {1};
G
for a in 8 9; do
  exits 0 "algorithm $a: long edges beside a fine point" "$MESHGEN" -2 needle.geo -algo $a -no_report -o n.msh
  exits 0 "algorithm $a: a square is one lattice" "$MESHGEN" -2 square.geo -algo $a -setnumber Mesh.RecombineAll 1 -o s.msh \
    -require "quads=2500" -require "triangles=0" -require "irregular=0" -require "min_eta>0.999"
  if [ -z "$err" ]; then ok "without a warning"; else not_ok "without a warning" "$err"; fi
  exits 0 "algorithm $a: triangles with right angles" "$MESHGEN" -2 square.geo -algo $a -o s.msh -require "triangles=5000" -require "min_angle>44.9"
  exits 0 "algorithm $a: the rectangle of the book" "$MESHGEN" -2 "$ROOT/geo/seed_rectangle.geo" -algo $a -setnumber Mesh.RecombineAll 1 -o r.msh \
    -require "mean_eta>0.8" -require "tau>0.84" -require "irregular<120"
  for variant in 0 1 2 3; do
    exits 0 "algorithm $a, recombination $variant: two faces, a hole, embedded curve and point" "$MESHGEN" -2 faces.geo -algo $a \
      -setnumber Mesh.RecombineAll 1 -setnumber Mesh.RecombinationAlgorithm $variant -format msh2 -o f.msh -require "min_eta>0.15"
    exits 0 "it passes the audit when read back" "$MESHGEN" check f.msh
  done
  exits 0 "algorithm $a with a guaranteed angle" "$MESHGEN" -2 faces.geo -algo $a -min_angle 25 -o f.msh -require "min_angle>=25"
  "$MESHGEN" -2 faces.geo -algo $a -nt 1 -no_report -o one.msh && "$MESHGEN" -2 faces.geo -algo $a -nt 4 -no_report -o four.msh
  same "algorithm $a: the same bytes with any number of threads" one.msh four.msh
done
exits 0 "names of the command line" "$MESHGEN" -2 square.geo -algo delquad -no_report -o a.msh
exits 0 "and the other" "$MESHGEN" -2 square.geo -algo pack -no_report -o b.msh
printf 'Merge "square.geo";\nMeshAlgorithm Surface {1} = 8;\n' >one.geo
exits 0 "per face" "$MESHGEN" -2 one.geo -no_report -o c.msh
same "MeshAlgorithm does what -algo does" a.msh c.msh
exits 0 "algorithm 11 is replaced" "$MESHGEN" -2 square.geo -algo 11 -no_report -o d.msh
says "Frontal-Delaunay for quads is used" "and that is said"
same "by 8" a.msh d.msh
# a sliver needs no mesh of good triangles, as many as it is longer than wide, for its field
for w in 1e-3 1e-7; do
  cat >sliver.geo <<END
h = 0.1; w = $w;
Point(1) = {0, 0, 0, h}; Point(2) = {1, 0, 0, h}; Point(3) = {1, w, 0, h}; Point(4) = {0, w, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
END
  for a in 8 9; do
    exits 0 "algorithm $a: a sliver of 1 by $w" "$MESHGEN" -2 sliver.geo -algo $a -setnumber Mesh.RecombineAll 1 -max_memory 200 -o s.msh
  done
done
echo "1..$count"
