# degenerate_faces.sh - faces that touch themselves, of several parts, with slits, islands and embedded entities, by every strategy
. "$(dirname "$0")/lib.sh"

# all_ways NAME LEAST MOST: NAME.geo meshed by every algorithm, with a smallest angle and as quadrangles; audited, and of an area within
all_ways() {
  local how
  for how in "-algo meshadapt" "-algo del2d" "-algo front2d" "-algo delquad" "-algo pack" "-min_angle 25" "-quad"; do
    # shellcheck disable=SC2086
    check "$1 $how" "$MESHGEN" -2 "$1.geo" $how -require "area>$2" -require "area<$3" -no_report -o "$1.msh"
  done
}

# holes that touch each other and the boundary in a point
cat >touch.geo <<'END'
Point(1) = {0, 0, 0, 0.2}; Point(2) = {4, 0, 0, 0.2}; Point(3) = {4, 2, 0, 0.2}; Point(4) = {0, 2, 0, 0.2};
Point(5) = {2, 1, 0, 0.2}; Point(6) = {1, 0.5, 0, 0.2}; Point(7) = {1, 1.5, 0, 0.2};
Point(8) = {3, 0.5, 0, 0.2}; Point(9) = {3, 1.5, 0, 0.2}; Point(10) = {0.5, 1.6, 0, 0.2}; Point(11) = {0.3, 1.2, 0, 0.2};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 5};
Line(8) = {5, 8}; Line(9) = {8, 9}; Line(10) = {9, 5};
Line(11) = {4, 10}; Line(12) = {10, 11}; Line(13) = {11, 4};
Curve Loop(1) = {1, 2, 3, 4}; Curve Loop(2) = {5, 6, 7}; Curve Loop(3) = {8, 9, 10}; Curve Loop(4) = {11, 12, 13};
Plane Surface(1) = {1, 2, 3, 4};
END
all_ways touch 6.859999999 6.860000001

# a loop that runs along a slit and back
cat >slit.geo <<'END'
Point(1) = {0, 0, 0, 0.2}; Point(2) = {2, 0, 0, 0.2}; Point(3) = {2, 2, 0, 0.2}; Point(4) = {0, 2, 0, 0.2}; Point(5) = {1, 1, 0, 0.05}; Point(6) = {1, 0, 0, 0.2};
Line(1) = {1, 6}; Line(2) = {6, 2}; Line(3) = {2, 3}; Line(4) = {3, 4}; Line(5) = {4, 1}; Line(6) = {6, 5};
Curve Loop(1) = {1, 6, -6, 2, 3, 4, 5};
Plane Surface(1) = {1};
END
all_ways slit 3.999999999 4.000000001

# a loop that runs along a slit to a hole, round it one way or the other, and back; its second part touches the first at corners
for way in "7, 8, 9" "-9, -8, -7"; do
  cat >bridge.geo <<END
Point(1) = {0, 0, 0, 0.2}; Point(2) = {2, 0, 0, 0.2}; Point(3) = {2, 2, 0, 0.2}; Point(4) = {0, 2, 0, 0.2}; Point(6) = {1, 0, 0, 0.2};
Point(5) = {1, 0.5, 0, 0.05}; Point(7) = {1.5, 1, 0, 0.2}; Point(8) = {0.5, 1, 0, 0.2}; Point(9) = {1.5, 1.8, 0, 0.2}; Point(10) = {0.5, 1.8, 0, 0.2};
Line(1) = {1, 6}; Line(2) = {6, 2}; Line(3) = {2, 3}; Line(4) = {3, 4}; Line(5) = {4, 1}; Line(6) = {6, 5};
Line(7) = {5, 7}; Line(8) = {7, 8}; Line(9) = {8, 5}; Line(10) = {7, 9}; Line(11) = {9, 8}; Line(12) = {3, 9}; Line(13) = {9, 10}; Line(14) = {10, 3};
Curve Loop(1) = {1, 6, $way, -6, 2, 3, 4, 5}; Curve Loop(2) = {10, 11, -8}; Curve Loop(3) = {12, 13, 14};
Plane Surface(1) = {1, 2, 3};
END
  all_ways bridge 3.249999999 3.250000001
done

# holes that have a side in common, one of them the outer loop's too, each filled by a face
cat >holes.geo <<'END'
h = 0.3;
Point(1) = {0, 0, 0, h}; Point(2) = {3, 0, 0, h}; Point(3) = {3, 2, 0, h}; Point(4) = {0, 2, 0, h}; Point(5) = {0.5, 0.5, 0, h}; Point(6) = {1.5, 0.5, 0, h};
Point(7) = {3, 0.5, 0, h}; Point(8) = {3, 1.5, 0, h}; Point(9) = {1.5, 1.5, 0, h / 3}; Point(10) = {0.5, 1.5, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 7}; Line(3) = {7, 8}; Line(4) = {8, 3}; Line(5) = {3, 4}; Line(6) = {4, 1};
Line(7) = {5, 6}; Line(8) = {6, 9}; Line(9) = {9, 10}; Line(10) = {10, 5}; Line(11) = {6, 7}; Line(12) = {8, 9};
Curve Loop(1) = {1:6}; Curve Loop(2) = {7:10}; Curve Loop(3) = {11, 3, 12, -8}; Curve Loop(4) = {8, -12, -3, -11};
Plane Surface(1) = {1, 2, 3}; Plane Surface(2) = {2}; Plane Surface(3) = {4};
END
all_ways holes 5.999999999 6.000000001
sed -i 's/Plane Surface(1) = {1, 2, 3}; .*/Plane Surface(1) = {1, 2, 4};/' holes.geo
exits 0 "holes with a side in common" "$MESHGEN" -2 holes.geo -order 2 -require "area>3.499999999" -require "area<3.500000001" -format msh4 -o holes.msh
case $err in *warning*) not_ok "are no reason for a warning" "$err" ;; *) ok "are no reason for a warning" ;; esac
exits 0 "and pass the audit when read back" "$MESHGEN" check holes.msh

# faces within holes of faces
cat >islands.geo <<'END'
SetFactory("Built-in");
h = 0.3;
Macro Square
 p = newp; Point(p) = {x-r, y-r, 0, h}; Point(p+1) = {x+r, y-r, 0, h}; Point(p+2) = {x+r, y+r, 0, h}; Point(p+3) = {x-r, y+r, 0, h};
 l = newl; Line(l) = {p, p+1}; Line(l+1) = {p+1, p+2}; Line(l+2) = {p+2, p+3}; Line(l+3) = {p+3, p};
 ll = newll; Curve Loop(ll) = {l:l+3};
Return
x = 0;y = 0;
r = 4; Call Square; a = ll;
r = 3; Call Square; b = ll;
r = 2; Call Square; c = ll;
r = 1; Call Square; d = ll;
Plane Surface(1) = {a, b};
Plane Surface(2) = {b, c};
Plane Surface(3) = {c, d};
Plane Surface(4) = {d};
END
all_ways islands 63.999999999 64.000000001

# a loop that touches itself
cat >eight.geo <<'END'
h = 0.2;
Point(1) = {0, 0, 0, h}; Point(2) = {-1, -1, 0, h}; Point(3) = {-1, 1, 0, h}; Point(4) = {1, -1, 0, h}; Point(5) = {1, 1, 0, h};
Line(1) = {1, 3}; Line(2) = {3, 2}; Line(3) = {2, 1}; Line(4) = {1, 4}; Line(5) = {4, 5}; Line(6) = {5, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6};
Plane Surface(1) = {1};
END
all_ways eight 1.999999999 2.000000001

# lobes run opposite ways, and a hole at the point where they meet
cat >pinch.geo <<'END'
h = 0.2;
Point(1) = {0, 0, 0, h}; Point(2) = {-1, -1, 0, h}; Point(3) = {-1, 1, 0, h}; Point(4) = {1, -1, 0, h}; Point(5) = {1, 1, 0, h};
Line(1) = {1, 3}; Line(2) = {3, 2}; Line(3) = {2, 1}; Line(4) = {1, 5}; Line(5) = {5, 4}; Line(6) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4, 5, 6};
Point(6) = {0.6, -0.3, 0, h}; Point(7) = {0.6, 0.3, 0, h};
Line(7) = {1, 6}; Line(8) = {6, 7}; Line(9) = {7, 1};
Curve Loop(2) = {7, 8, 9};
Plane Surface(1) = {1, 2};
END
all_ways pinch 1.819999999 1.820000001

# one surface of two separate squares
cat >two.geo <<'END'
h = 0.3;
Point(1) = {0, 0, 0, h}; Point(2) = {1, 0, 0, h}; Point(3) = {1, 1, 0, h}; Point(4) = {0, 1, 0, h};
Point(5) = {3, 0, 0, h}; Point(6) = {4, 0, 0, h}; Point(7) = {4, 1, 0, h}; Point(8) = {3, 1, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 8}; Line(8) = {8, 5};
Curve Loop(1) = {1, 2, 3, 4};Curve Loop(2) = {5, 6, 7, 8};
Plane Surface(1) = {1, 2};
END
all_ways two 1.999999999 2.000000001

# embedded points and curves: crossing, ending on the boundary, closed
cat >emb.geo <<'END'
h = 0.3;
Point(1) = {0, 0, 0, h}; Point(2) = {4, 0, 0, h}; Point(3) = {4, 4, 0, h}; Point(4) = {0, 4, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Point(5) = {0.5, 3.5, 0, 0.02}; Point{5} In Surface{1};
Point(6) = {1, 1, 0, h}; Point(7) = {3, 3, 0, h}; Point(8) = {1, 3, 0, h}; Point(9) = {3, 1, 0, h};
Line(5) = {6, 7}; Line(6) = {8, 9}; Line(7) = {1, 6};
Line{5, 6, 7} In Surface{1};
Point(10) = {3.5, 2, 0, h}; Point(11) = {3.6, 2, 0, 0.05}; Point(12) = {3.4, 2, 0, 0.05};
Circle(8) = {11, 10, 12};Circle(9) = {12, 10, 11};
Line{8, 9} In Surface{1};
END
all_ways emb 15.999999999 16.000000001

# ---- embedded points on curves, and outside ----
cat >points.geo <<'G'
h = .3; Point(1) = {0, 0, 0, h}; Point(2) = {1, 0, 0, h}; Point(3) = {1, 1, 0, h}; Point(4) = {0, 1, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Curve Loop(1) = {1:4};
Point(20) = {.5, .7, 0, h}; Point(21) = {.7, .7, 0, h}; Point(22) = {.3, .7, 0, h}; Circle(5) = {21, 20, 22}; Circle(6) = {22, 20, 21};
Curve Loop(2) = {5, 6}; Plane Surface(1) = {1, 2};
Point(14) = {.3, .2, 0, h}; Point(15) = {.7, .2, 0, h}; Line(15) = {14, 15}; Curve{15} In Surface{1};
Point(10) = {.4, 0, 0, h}; Point(11) = {.5 + .2*Cos(1), .7 + .2*Sin(1), 0, h}; Point(12) = {.35, .2, 0, h}; Point(13) = {.5, .7, 0, h};
Point{10:13} In Surface{1};
Physical Point(9) = {10:13}; Physical Curve(1) = {1:4}; Physical Curve(2) = {15}; Physical Surface(3) = {1};
G
exits 0 "embedded points on a side, an arc and an embedded line" "$MESHGEN" -2 points.geo -format msh2 -o p.msh
says "embedded point at (0.5, 0.7, 0) is outside surface 1: it is left out" "one in a hole is left out"
prints "  4" "no length is lost"
check "they fit together" "$MESHGEN" check p.msh
check "all three are in triangles" awk '/^\$Elements/ { on = 1 } on && $2 == 15 { p[$6] = 1 } on && $2 == 2 { for (i = 6; i <= 8; i++) if ($i in p) used[$i] = 1 }
  END { for (i in used) n++; exit n != 3 }' p.msh

# ---- a curve of one edge from corner to corner that is in no face ----
cat >free.geo <<'G'
h = .3; Point(1) = {0, 0, 0, h}; Point(2) = {1, 0, 0, h}; Point(3) = {1, 1, 0, h}; Point(4) = {0, 1, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
Line(5) = {1, 3}; Transfinite Curve{5} = 2;
G
exits 0 "a free line between nodes of a face" "$MESHGEN" -2 free.geo -o free.msh
printf 'Point(5) = {.1, .9, 0, h}; Circle(6) = {1, 2, 3}; Transfinite Curve{6} = 2; Mesh.ElementOrder = 2;' >>free.geo
exits 0 "and two, of order 2" "$MESHGEN" -2 free.geo -format msh2 -o free.msh
check "which bend no edge of the face" "$MESHGEN" check free.msh
sed -i 's/Mesh.ElementOrder = 2/Mesh.SubdivisionAlgorithm = 1/' free.geo
exits 0 "and halved" "$MESHGEN" -2 free.geo -format msh2 -o free.msh
cat >doubled.geo <<'G'
Point(1) = {0, 0, 0, 2}; Point(2) = {1, 0, 0, 2}; Point(3) = {1, 1, 0, 2}; Point(4) = {0, 1, 0, 2};
Line(5) = {1, 2}; Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Line(6) = {1, 2};
Curve Loop(1) = {5, 2, 3, 4}; Plane Surface(1) = {1};
G
exits 0 "a side defined three times, of one edge each" "$MESHGEN" -2 doubled.geo -o doubled.msh

cat >crack.geo <<'G'
Point(1) = {0, 0, 0, 9}; Point(2) = {1, 0, 0, 9}; Point(3) = {1, 1, 0, 9}; Point(4) = {0, 1, 0, 9}; Point(5) = {0, -1, 0, 9};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Line(5) = {2, 1}; Line(6) = {1, 5}; Line(7) = {5, 2};
Curve Loop(1) = {1:4}; Curve Loop(2) = {6, 7, 5}; Plane Surface(1) = {1}; Plane Surface(2) = {2};
G
exits 0 "a crack of one edge on either side opens" "$MESHGEN" -2 crack.geo -require "nodes==8" -o crack.msh
printf 'MeshSize{:} = 0.4; Transfinite Curve{1} = 4; Transfinite Curve{5} = 6; Physical Surface(1) = {1, 2};' >>crack.geo
exits 0 "a crack with other nodes on either side" "$MESHGEN" -2 crack.geo -o crack.msh
exits 0 "it is seen as one where its lines are not in the file" "$MESHGEN" check crack.msh
prints "not joined to it" "with a warning"

# ---- embedded curves on the boundary, and outside, with a smallest angle ----
cat >rim.geo <<'G'
h = 0.3; Point(1) = {0, 0, 0, h}; Point(2) = {1, 0, 0, h}; Point(3) = {1, 1, 0, h}; Point(4) = {0, 1, 0, h}; Point(5) = {1.5, 0.5, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
Line(5) = {2, 1}; Line(6) = {1, 3}; Curve{5, 6} In Surface{1}; Coherence;
G
exits 0 "an embedded curve that Coherence makes a side" "$MESHGEN" -2 rim.geo -o rim.msh
echo 'Line(7) = {2, 5}; Curve{7} In Surface{1};' >>rim.geo
exits 1 "an embedded curve that is outside, with a smallest angle" "$MESHGEN" -2 rim.geo -min_angle 30 -o rim.msh
says "embedded curve 7 is outside surface 1" "is named"

# ---- an embedded curve that crosses itself: it is cut twice at the point where it does ----
cat >loop.geo <<'G'
h = 0.02; Point(1) = {-1, -1, 0, 0.3}; Point(2) = {1, -1, 0, 0.3}; Point(3) = {1, 1, 0, 0.3}; Point(4) = {-1, 1, 0, 0.3};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
Point(5) = {-0.5, -0.5, 0, h}; Point(6) = {0.5, 0.3, 0, h}; Point(7) = {0, 0.7, 0, h}; Point(8) = {-0.5, 0.3, 0, h}; Point(9) = {0.5, -0.5, 0, h};
Spline(5) = {5:9}; Curve{5} In Surface{1};
G
exits 0 "an embedded spline with a loop in it" "$MESHGEN" -2 loop.geo -require "area>3.999999999" -o loop.msh
exits 0 "passes the audit" "$MESHGEN" check loop.msh

# ---- two faces on one loop: an edge within each may join the same nodes ----
cat >twins.geo <<'G'
Point(1) = {0, 0, 0, 2}; Point(2) = {2, 0, 0, 2}; Point(3) = {2, 1, 0, 2}; Point(4) = {0, 1, 0, 2};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Curve Loop(1) = {1:4}; Plane Surface(1) = {1}; Plane Surface(2) = {1};
G
exits 0 "two faces on one loop" "$MESHGEN" -2 twins.geo -format msh2 -o twins.msh
exits 0 "of order 2" "$MESHGEN" -2 twins.geo -order 2 -o twins.msh
exits 0 "halved" "$MESHGEN" -2 twins.geo -setnumber Mesh.SubdivisionAlgorithm 1 -o twins.msh

# ---- points among the shapes of fragments ----
cat >fragments.geo <<'G'
SetFactory("OpenCASCADE");
Rectangle(1) = {0, 0, 0, 2, 1}; Disk(2) = {1, .5, 0, .3};
Point(20) = {.2, .2, 0}; Point(21) = {1, .5, 0}; Point(22) = {9, 9, 0}; Point(23) = {.5, 0, 0}; Point(24) = {0, 0, 0}; Point(25) = {1 + .3*Cos(1), .5 + .3*Sin(1), 0};
BooleanFragments{ Surface{1}; Delete; }{ Surface{2}; Point{20:25}; Delete; }
Physical Point(1) = {20, 21, 23, 25}; Physical Surface(1) = Surface{:}; MeshSize{:} = .2;
G
exits 0 "points in faces, on curves, at a corner and outside" "$MESHGEN" -2 fragments.geo -format msh2 -o fr.msh
check "are in the mesh" "$MESHGEN" check fr.msh
check "where they lie in faces" awk '/^\$Elements/ { on = 1 } on && $2 == 15 { p[$6] = 1 } on && $2 == 2 { for (i = 6; i <= 8; i++) if ($i in p) used[$i] = 1 }
  END { for (i in used) n++; exit n != 4 }' fr.msh
