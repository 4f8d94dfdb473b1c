# min_angle.sh - the guaranteed smallest angle on models of several faces, which stay conforming
. "$(dirname "$0")/lib.sh"

exits 0 "conge at 30 degrees" "$MESHGEN" -2 "$ROOT/geo/conge.geo" -clscale 3 -min_angle 30 -require "min_angle>=30" -no_report -o conge.msh
exits 0 "conge is valid" "$MESHGEN" check conge.msh
exits 0 "porous medium at 30 degrees" "$MESHGEN" -2 "$ROOT/geo/porous.geo" -min_angle 30 -require "min_angle>=30" -no_report -o porous.msh

# two faces run the opposite way round, joined along a line, with a sliver of 0.6 by 10 at one of them
cat >sharp.geo <<'END'
Point(1) = {0, 0, 0, 1};
Point(2) = {10, 0, 0, 1};
Point(3) = {10, 0.6, 0, 1};
Point(4) = {3, 4, 0, 0.2};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 1};
Line(4) = {1, 4};
Line(5) = {4, 3};
Curve Loop(1) = {1, 2, 3};
Plane Surface(1) = {1};
Curve Loop(2) = {4, 5, 3};
Plane Surface(2) = {2};
END
exits 0 "sharp faces of opposite sense" "$MESHGEN" -2 sharp.geo -min_angle 30 -no_report -o sharp.msh
says "at input angles under 60 degrees" "what cannot reach the angle is counted"
says "meet at (0, 0, 0) at 3.434 degrees" "and listed with its place"
"$MESHGEN" -2 sharp.geo -min_angle 30 --json -o sharp.msh >sharp.json 2>/dev/null
if grep -q '"text": "curves [13] and [13] meet at (0, 0, 0) at 3.434 degrees' sharp.json; then
  ok "and in the JSON report"
else
  not_ok "and in the JSON report"
fi
exits 0 "sharp faces are valid" "$MESHGEN" check sharp.msh

exits 0 "transfinite faces keep their grids" "$MESHGEN" -2 "$ROOT/geo/backward_step.geo" -min_angle 30 -no_report -o step.msh
exits 0 "they are valid" "$MESHGEN" check step.msh

# faces with boundary layers keep their boundary edges: where they fall short is said, with the place
cat >layer.geo <<'END'
SetFactory("Built-in");
Point(1) = {0, 0, 0, 0.3};
Point(2) = {1, 0, 0, 0.3};
Point(3) = {1, 1, 0, 0.3};
Point(4) = {0, 1, 0, 0.3};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Field[1] = BoundaryLayer;
Field[1].CurvesList = {1};
Field[1].Size = 0.005;
Field[1].Ratio = 1.2;
Field[1].Thickness = 0.1;
Field[1].Quads = 0;
BoundaryLayer Field = 1;
END
exits 0 "a face with boundary layers" "$MESHGEN" -2 layer.geo -min_angle 30 -no_report -o layer.msh
says "surface 1 (with boundary layers) keeps its boundary edges" "is not passed over in silence"
# what cannot be in one triangulation is refined face by face, in rounds, until the common curves agree
cat >crack.geo <<'END'
h = 0.3;
Point(1) = {0, 0, 0, h};
Point(2) = {1, 0, 0, h};
Point(3) = {2, 0, 0, h};
Point(4) = {2, 1, 0, h};
Point(5) = {0, 1, 0, h};
Point(6) = {2, -1, 0, h};
Point(7) = {0, -1, 0, h};
Point(8) = {2, 0, 0, h / 4};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 1};
Line(6) = {2, 8};
Line(7) = {8, 6};
Line(8) = {6, 7};
Line(9) = {7, 1};
Curve Loop(1) = {1, 2, 3, 4, 5};
Plane Surface(1) = {1};
Curve Loop(2) = {1, 6, 7, 8, 9};
Plane Surface(2) = {2};
END
exits 0 "a crack with nodes on either side" "$MESHGEN" -2 crack.geo -min_angle 30 -require "min_angle>=30" -no_report -o crack.msh

cat >overlap.geo <<'END'
Point(1) = {0, 0, 0, 1};
Point(2) = {4, 0, 0, 1};
Point(3) = {4, 1, 0, 0.05};
Point(4) = {0, 1, 0, 1};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Line(5) = {1, 3};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Curve Loop(2) = {1, 2, -5};
Plane Surface(2) = {2};
END
exits 0 "faces that overlap" "$MESHGEN" -2 overlap.geo -min_angle 25 -no_report -o overlap.msh

# two sides of a box and its bottom: splits of the common edges are seen in every plane
cat >box.geo <<'END'
Point(1) = {0, 0, 0, 1};
Point(2) = {3, 0, 0, 1};
Point(3) = {3, 3, 0, 1};
Point(4) = {0, 3, 0, 1};
Point(5) = {0, 0, 3, 1};
Point(6) = {3, 0, 3, 1};
Point(7) = {1.5, 0, 0.05, 1};
Point(8) = {0.1, 1.5, 0, 1};
Point(9) = {0, 3, 3, 1};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Line(5) = {1, 5};
Line(6) = {5, 6};
Line(7) = {6, 2};
Line(8) = {5, 9};
Line(9) = {9, 4};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Curve Loop(2) = {5, 6, 7, -1};
Plane Surface(2) = {2};
Curve Loop(3) = {5, 8, 9, 4};
Plane Surface(3) = {3};
Point{7} In Surface{2};
Point{8} In Surface{1};
END
exits 0 "faces of three planes" "$MESHGEN" -2 box.geo -min_angle 30 -require "min_angle>=30" -no_report -o box.msh
check "which share their nodes" sh -c "'$MESHGEN' check box.msh | grep -q ': valid\$'"

# Faces of one plane are one triangulation, whichever way their loops run: splits of the side between them are not passed on from one to
# the other and back, each time taken for input (1,092 triangles)
cat >strip.geo <<'END'
h = 0.2;
Point(1) = {0, 0, 0, h}; Point(2) = {1, 0, 0, h}; Point(3) = {1, 0.1, 0, h}; Point(4) = {0, 0.1, 0, h}; Point(5) = {1, 1.1, 0, h}; Point(6) = {0, 1.1, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {4, 3}; Line(4) = {1, 4}; Line(5) = {3, 5}; Line(6) = {6, 5}; Line(7) = {4, 6};
Curve Loop(1) = {1, 2, -3, -4}; Plane Surface(1) = {1}; Curve Loop(2) = {3, 5, -6, -7}; Plane Surface(2) = {2};
x[] = {0.5137, 0.4978, 0.4859, 0.4793, 0.5354, 0.4874, 0.4976, 0.5143, 0.5374, 0.5097};
y[] = {0.0919, 0.0077, 0.0283, 0.0314, 0.0367, 0.0923, 0.0531, 0.0815, 0.0429, 0.0701};
For k In {0:9}
  Point(10 + k) = {x[k], y[k], 0, h};
EndFor
For k In {0:4}
  Line(10 + k) = {10 + 2 * k, 11 + 2 * k}; Curve{10 + k} In Surface{1};
EndFor
For k In {0:3}
  c = 0.17 + 0.22 * k; a = k ? 0.22 : 0.18; b = k ? 0.78 : 0.82;
  Point(30 + 4 * k) = {c, 0.1 + a, 0, h}; Point(31 + 4 * k) = {c, 0.1 + b, 0, h}; Line(30 + 2 * k) = {30 + 4 * k, 31 + 4 * k};
  Point(32 + 4 * k) = {a, 0.1 + c, 0, h}; Point(33 + 4 * k) = {b, 0.1 + c, 0, h}; Line(31 + 2 * k) = {32 + 4 * k, 33 + 4 * k};
  Curve{30 + 2 * k, 31 + 2 * k} In Surface{2};
EndFor
END
exits 0 "faces beside one another" "$MESHGEN" -2 strip.geo -min_angle 28 -require "triangles<900" -no_report -o strip.msh

# a curve that turns back within an edge of it: its new nodes are in the order of its parameter, not of where they lie along the chord
cat >hairpin.geo <<'END'
h = 0.2; Point(1) = {-0.1, -0.1, 0, h}; Point(2) = {0.1, -0.1, 0, h}; Point(3) = {0.1, 0.1, 0, h}; Point(4) = {-0.1, 0.1, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
Point(20) = {0.02381, 0.00735, 0, h}; Point(21) = {-0.04027, -0.02618, 0, h}; Point(22) = {0.05674, 0.01922, 0, h};
Spline(16) = {20, 21, 22}; Curve{16} In Surface{1};
END
for h in 1 0.7 0.2; do
  exits 0 "a hairpin, sizes times $h" "$MESHGEN" -2 hairpin.geo -clscale $h -setnumber Mesh.ConformingDelaunay 1 -no_report -o hairpin.msh
done

# where curves meet at a sharp angle and beside it at a wide one, only the sharp one is an excuse
cat >beside.geo <<'END'
Point(1) = {0, 0, 0, 0.1}; Point(2) = {-0.7452920581558482, -0.28199767268076814, 0, 0.0197705}; Point(3) = {0.11428165722735584, -0.488738936510943, 0, 0.72388};
Point(4) = {0.5796289138620003, -0.5199056641714566, 0, 0.0677908}; Point(5) = {0.8021203119129642, 0.08368061574528222, 0, 0.1};
Point(6) = {0.28021960691120884, 0.872471096098121, 0, 0.1}; Point(7) = {-0.41299777369516893, 0.3619447301723939, 0, 0.1};
Point(8) = {-0.8226150729298773, 0.04879752348634625, 0, 0.128216};
Line(1) = {2, 3}; Line(2) = {3, 4}; Line(3) = {4, 5}; Line(4) = {5, 6}; Line(5) = {6, 7}; Line(6) = {7, 8}; Line(7) = {8, 2};
For k In {2:8}
  Line(6 + k) = {1, k};
EndFor
Curve Loop(1) = {8, 1, -9}; Curve Loop(2) = {9, 2, -10}; Curve Loop(3) = {10, 3, -11}; Curve Loop(4) = {11, 4, 5, 6, 7, -8};
For k In {1:4}
  Plane Surface(k) = {k};
EndFor
END
exits 0 "sharp angles beside wide ones" "$MESHGEN" -2 beside.geo -min_angle 30 -no_report -o beside.msh
says "2 triangles have an angle below 30 degrees" "are those in the sharp ones"

exits 1 "an angle beyond reach is refused" "$MESHGEN" -2 "$ROOT/geo/conge.geo" -min_angle 50 -o x.msh
