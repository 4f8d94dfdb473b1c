#!/bin/bash
# language.sh - meshes of scripts as people write them: what the parts of the language come to in the end
. "$(dirname "$0")/lib.sh"
points='Point(1)={0,0,0,.1};Point(2)={1,0,0,.1};Point(3)={1,1,0,.1};Point(4)={0,1,0,.1};'
lines='Line(1)={1,2};Line(2)={2,3};Line(3)={3,4};Line(4)={4,1};'
square="$points $lines Curve Loop(1)={1:4};Plane Surface(1)={1};"
mesh() { # SCRIPT ARGS...: mesh it to a.msh and audit that; the report stays in $out
  printf '%s\n' "$1" >a.geo
  shift
  exits "${want:-0}" "${name:?}" "$MESHGEN" -2 a.geo -format msh2 -o a.msh "$@"
  report=$out
  [ "${want:-0}" != 0 ] || check "$name: audit" "$MESHGEN" check a.msh
  want=0 out=$report
}
# triangles LO HI: between so many in the report
triangles() {
  local n
  n=$(printf '%s\n' "$report" | sed -n 's/.* \([0-9]*\) triangles.*/\1/p' | head -n 1)
  check "$name: $n triangles, $1 to $2 expected" [ "$n" -ge "$1" -a "$n" -le "$2" ]
}
# area WANT TOLERANCE: of all triangles and quadrangles of a.msh; lines and areas are those of the chords
area() {
  check "$name: area $1" awk -v want="$1" -v tol="$2" '
    /^\$Nodes/ { getline; for (n = $1; n > 0; n--) { getline; x[$1] = $2; y[$1] = $3; z[$1] = $4 } }
    function tri(a, b, c,   u1, u2, u3, v1, v2, v3) {
      u1 = x[b] - x[a]; u2 = y[b] - y[a]; u3 = z[b] - z[a]; v1 = x[c] - x[a]; v2 = y[c] - y[a]; v3 = z[c] - z[a]
      return sqrt((u2 * v3 - u3 * v2) ^ 2 + (u3 * v1 - u1 * v3) ^ 2 + (u1 * v2 - u2 * v1) ^ 2) / 2
    }
    /^\$Elements/ { on = 1 }
    on && $2 == 2 { sum += tri($(NF - 2), $(NF - 1), $NF) }
    on && $2 == 3 { sum += tri($(NF - 3), $(NF - 2), $(NF - 1)) + tri($(NF - 3), $(NF - 1), $NF) }
    END { print sum; d = sum - want; exit !(d <= tol && -d <= tol) }' a.msh
}

# ---- sizes at embedded points ----
name="an embedded point with a size of its own"
mesh "$square Point(5)={.5,.5,0,.01}; Point{5} In Surface{1};"
triangles 450 680
name="an embedded point without a size"
mesh "$square Point(5)={.5,.5,0}; Point{5} In Surface{1};"
triangles 120 290
name="an embedded point, sizes of points not wanted"
mesh "$square Point(5)={.5,.5,0,.01}; Point{5} In Surface{1}; Mesh.MeshSizeFromPoints=0; Mesh.MeshSizeMax=.1;"
triangles 200 290

# ---- boundaries in parts ----
name="an outer boundary in two open loops, a hole first"
mesh "$points $lines Point(11)={.3,.3,0,.1};Point(12)={.6,.3,0,.1};Point(13)={.4,.6,0,.1};
Line(11)={11,12};Line(12)={12,13};Line(13)={13,11};
Curve Loop(1)={11:13}; Curve Loop(2)={1}; Curve Loop(3)={2,3,4}; Plane Surface(1)={1,2,3};"
area 0.955 1e-12
check "nothing is said of the open loops" [ -z "$err" ]
want=1 name="open loops that do not close together"
mesh "$points $lines Curve Loop(2)={1}; Curve Loop(3)={2,3}; Plane Surface(1)={2,3};"
says "is not closed" "the gap is named"

# ---- periodic curves by a map: the map says which way the master runs ----
name="a master that runs the other way"
mesh "$square Transfinite Curve{4}=7 Using Progression 1.4; Periodic Curve{2}={4} Translate{1,0,0};"
check "the nodes face one another" awk '
    /^\$Nodes/ { getline; for (n = $1; n > 0; n--) { getline; y[$1] = $3 } }
    /^\$Elements/ { on = 1 } on && $2 == 1 && $5 == 2 { r[y[$6]] } on && $2 == 1 && $5 == 4 { l[y[$6]]; l[y[$7]] }
    END { for (v in r) if (!(v in l)) exit 1 }' a.msh

# ---- embedded curves that are on the boundary already ----
name="a boundary curve embedded"
mesh "$points $lines Line(5)={1,3}; Curve Loop(1)={1,2,-5}; Curve Loop(2)={5,3,4}; Plane Surface(1)={1}; Plane Surface(2)={2};
Curve{5} In Surface{1}; Curve{3,5} In Surface{2};"
want=1
name="of another surface it lies outside"
mesh "$points $lines Line(5)={1,3}; Curve Loop(1)={1,2,-5}; Plane Surface(1)={1}; Curve{4} In Surface{1};"

# ---- commands on meshes ----
name="commands on a mesh that is not there yet"
mesh "$square RefineMesh; RecombineMesh; SetOrder 2; Save 'b.msh';"
says "there is no mesh yet, so nothing is done" "it is said"
says "there is no mesh yet, so nothing is written" "of Save too"
absent "and no file is written" b.msh
name="RecombineMesh"
mesh "$square Mesh 2; RecombineMesh; Save 'b.msh2';"
check "quadrangles are saved" awk '/^\$Elements/ { on = 1 } on && $2 == 3 { n++ } END { exit !(n > 50) }' b.msh2

# ---- a sphere by its stereographic projection ----
polar='R=2; Point(1)={0,0,0};Point(2)={0,0,R}; PolarSphere(1)={1,2};
Point(3)={.1,0,0,.1};Point(4)={.5,0,0,.1};Point(5)={.5,.6,0,.1};Point(6)={.1,.5,0,.1};
Line(1)={3,4};Line(2)={4,5};BSpline(3)={5,6};Spline(4)={6,3};Curve Loop(1)={1:4};Plane Surface(1)={1};Physical Surface(1)={1};'
name="a patch of a sphere"
mesh "$polar"
prints "64 lines" "curves are measured on the sphere" # 6.23 long, in steps of 0.1
triangles 540 700
area 2.4803 1e-3
check "all nodes are on the sphere" awk '
    /^\$Nodes/ { getline; for (n = $1; n > 0; n--) { getline; d = $2 * $2 + $3 * $3 + $4 * $4 - 4; if (d > 1e-12 || -d > 1e-12) bad++ } }
    END { exit bad > 0 }' a.msh
check "elements look outwards" awk '
    /^\$Nodes/ { getline; for (n = $1; n > 0; n--) { getline; x[$1] = $2; y[$1] = $3; z[$1] = $4 } }
    /^\$Elements/ { on = 1 }
    on && $2 == 2 { a = $6; b = $7; c = $8
      d = x[a] * (y[b] * z[c] - z[b] * y[c]) - y[a] * (x[b] * z[c] - z[b] * x[c]) + z[a] * (x[b] * y[c] - y[b] * x[c]); if (d <= 0) bad++ }
    END { exit bad > 0 }' a.msh
cp a.msh first.msh
check "unrolled" "$MESHGEN" -0 a.geo -o b.geo
check "and meshed again" "$MESHGEN" -2 b.geo -format msh2 -o b.msh
"$MESHGEN" -2 b.geo -o b.msh | sed -n '1s/.*: //p' >b.txt
"$MESHGEN" -2 a.geo -o a.msh | sed -n '1s/.*: //p' >a.txt
same "it is the same patch" a.txt b.txt
"$MESHGEN" -0 b.geo -o c.geo
same "it is unrolled the same again" b.geo c.geo
printf '%s\n' 'Point(1)={0,0,0};Physical Point("later",3)={};Physical Point(4)={9};Physical Point(5)={1};' >a.geo
"$MESHGEN" -0 a.geo -o b.geo 2>err.txt
check "a group of nothing and no name is not written" [ "$(grep -c Physical b.geo)" = 2 ]
check "examples unrolled and read back" "$PYTHON" "$ROOT/tests/unrolled.py" "$MESHGEN" "$ROOT/geo"
name="a grid on a sphere"
mesh "$polar Transfinite Curve{:}=9; Transfinite Surface{1}; Recombine Surface{1};"
prints "64 quadrangles" "transfinite in the plane of the projection"
name="sizes of fields are those of space"
mesh "$polar Field[1]=Distance; Field[1].PointsList={2}; Field[2]=Threshold; Field[2].InField=1; Field[2].DistMin=0; Field[2].DistMax=3;
Field[2].SizeMin=.05; Field[2].SizeMax=.3; Background Field=2; Mesh.MeshSizeFromPoints=0; Mesh.MeshSizeExtendFromBoundary=0;"
triangles 150 500

# ---- OpenCASCADE's curves: nodes at equal distances, as Gmsh has them ----
occ='SetFactory("OpenCASCADE");' zigzag='Point(1)={0,0,0};Point(2)={1,1,0};Point(3)={2,-1,0};Point(4)={4,0,0};Point(5)={5,2,0};'
curve() { # DEFINITION "X Y"...: nodes of curve 1 in eight equal parts
  printf '%s\n' "$occ $zigzag $1 Transfinite Curve{1}=9; Mesh.SaveAll=1;" >a.geo
  check "$1" "$MESHGEN" -1 a.geo -format msh2 -o a.msh
  check "$1, unrolled" "$MESHGEN" -0 a.geo -o b.geo
  check "$1, read back" "$MESHGEN" -1 b.geo -format msh2 -o b.msh
  local file place
  shift
  for file in a.msh b.msh; do
    for place in "$@"; do
      check "$place is a node of $file" awk -v at="$place" 'BEGIN { split(at, p, " ") } /^\$Nodes/ { on = 1 } /^\$EndNodes/ { on = 0 }
        on && ($2 - p[1]) ^ 2 + ($3 - p[2]) ^ 2 < 1e-10 { found = 1 } END { exit !found }' $file
    done
  done
}
curve "Spline(1)={1:3};" "0.26668 0.40101" "1.91702 -0.52549"
curve "Spline(1)={1:5};" "0.56353 0.89781" "3.34689 -0.61106" "4.73741 0.98442"
curve "Spline(1)={1:5,1};" "1.23773 0.63598" "4.96166 1.45202" "0.51421 -0.94246"
curve "BSpline(1)={1:5};" "0.66941 0.41828" "4.61373 1.29959"
curve "BSpline(1)={1:5,1};" "0.5 0.5" "1.45497 0.21152" "1.40631 0.57094"
printf '%s\n' "$zigzag Spline(1)={1:5}; Split Curve{1} Point{3}; MeshSize{:}=.05;" >a.geo
"$MESHGEN" -0 a.geo -o b.geo
for file in a b; do "$MESHGEN" -1 $file.geo -o $file.msh | sed -n '1s/.*: //p' | sed 's/[0-9]* nodes, //' >$file.txt; done
same "the parts of a spline are unrolled as such" a.txt b.txt
name="loops of OpenCASCADE have no signs, and a wire is one"
mesh "$occ $points Line(1)={1,2};Line(2)={3,2};Line(3)={3,4};Line(4)={4,1}; Wire(1)={1:4};Plane Surface(1)={1};"
check "$name: nothing is said" [ -z "$err" ]

# ---- Boolean operations on plane faces ----
occ='SetFactory("OpenCASCADE");'
name="a plate with holes, one across its edge"
mesh "$occ Rectangle(1)={0,0,0,4,2}; Disk(2)={1,1,0,.5}; Disk(3)={4,1,0,.5}; MeshSize{:}=.05;
BooleanDifference(10)={Surface{1};Delete;}{Surface{2,3};Delete;}; Mesh.MeshSizeMax=.03; Physical Surface('plate')={10}; Physical Curve('rim')=Boundary{Surface{10};};"
area 6.8219 4e-3 # 8 - 3/2 pi/4
name="fragments: neighbours share their nodes"
mesh "$occ Disk(1)={0,0,0,1}; Disk(2)={1,0,0,1}; Disk(3)={.5,.8,0,1}; Mesh.MeshSizeMax=.05;
f()=BooleanFragments{Surface{1};Delete;}{Surface{2,3};Delete;}; Physical Surface(1)={f()};"
check "seven faces" [ "$(awk '/^\$Elements/ { on = 1 } on && $2 == 2 && !($5 in f) { f[$5]; n++ } END { print n }' a.msh)" = 7 ]
check "no boundary inside: every edge within has two triangles" awk '
    /^\$Nodes/ { getline; for (n = $1; n > 0; n--) { getline; x[$1] = $2; y[$1] = $3 } }
    /^\$Elements/ { on = 1 }
    on && $2 == 2 { for (i = 0; i < 3; i++) { a = $(NF - i); b = $(NF - (i + 1) % 3); e[a < b ? a " " b : b " " a]++ } }
    END { for (k in e) if (e[k] == 1) { split(k, v, " "); px = (x[v[1]] + x[v[2]]) / 2; py = (y[v[1]] + y[v[2]]) / 2
        if (px ^ 2 + py ^ 2 < .99 || (px - 1) ^ 2 + py ^ 2 < .99 || (px - .5) ^ 2 + (py - .8) ^ 2 < .99) bad++ } exit bad > 0 }' a.msh
name="a union"
mesh "$occ Rectangle(1)={0,0,0,4,2}; Disk(2)={4,1,0,1}; Rectangle(3)={1,1,0,1,3}; BooleanUnion(10)={Surface{1};Delete;}{Surface{2,3};Delete;}; Mesh.MeshSizeMax=.05;"
area 11.5708 4e-3 # 8 + pi/2 + 2
name="a disk cut by lines, some of which end inside"
mesh "$occ Point(1)={0,0,0};Point(2)={12,0,0};Point(3)={-60,0,0};Point(4)={10,-5,0}; Line(1)={3,1};Line(2)={1,2};Line(3)={1,4};
Circle(4)={0,0,0,50,0,2*Pi}; Curve Loop(1)={4}; Surface(1)={1}; f()=BooleanFragments{Surface{1};Delete;}{Curve{1:3};Delete;}; MeshSize{:}=5;"
check "lines inside are in the mesh" awk '
    /^\$Nodes/ { getline; for (n = $1; n > 0; n--) { getline; y[$1] = $3; x[$1] = $2 } }
    /^\$Elements/ { on = 1 } on && $2 == 1 { r = x[$6] ^ 2 + y[$6] ^ 2; if (y[$6] < 1e-9 && y[$6] > -1e-9 && r < 2000) n++ } END { exit !(n >= 10) }' a.msh
name="splines that are cut"
mesh "$occ Point(1)={0,0,0};Point(2)={1,0,0};Point(3)={1,1,0};Point(4)={0,1,0};Spline(1)={1,2,3,4,1};Curve Loop(1)={1};Plane Surface(1)={1};
Rectangle(2)={.5,.5,0,3,3}; Disk(3)={0,.5,0,.3}; Physical Surface(9)=BooleanFragments{Surface{1};Delete;}{Surface{2,3};Delete;}; MeshSize{:}=.03;"
mesh "$occ Point(1)={0,0,0};Point(2)={3,0,0};Point(3)={1.5,-.4,0};Point(4)={3,2,0};Point(5)={0,2,0};Spline(1)={1,3,2};Line(2)={2,4};Line(3)={4,5};
Line(4)={5,1};Curve Loop(1)={1:4};Plane Surface(1)={1};Rectangle(2)={1,-1,0,1,2}; f()=BooleanDifference{Surface{1};Delete;}{Surface{2};Delete;}; MeshSize{:}=.03;"
area 5.4148 1e-3 # 6 + 0.8 under the axis; what goes: 1 + 0.3852 of that

# ---- layers along normals, on both sides ----
name="negative heights are on the other side"
mesh "Point(1)={0,0,0,.3};Point(2)={1,0,0,.3};Point(3)={1,1,0,.3}; Line(1)={1,2};Line(2)={2,3};
a[]=Extrude{Curve{1,2}; Layers{2,.1}; Using Index[0];}; b[]=Extrude{Curve{1,2}; Layers{2,-.1}; Using Index[1];}; Physical Surface(1)={a[1],a[5],b[1],b[5]};"
area 0.4 1e-12

# ---- the tree of a script ----
printf 'x = 1 + 2;\nPoint(1) = {0, x, 0};\nPrintf("never run");\n' >tree.geo
exits 0 "-dump_ast" "$MESHGEN" -dump_ast tree.geo
prints "(DEFINE Point 1 (LIST 0 x 0))" "it prints the tree"
printf 'Point(1) = {0, 0, 0;\n' >tree.geo
exits 1 "-dump_ast of what does not parse" "$MESHGEN" -dump_ast tree.geo
says "tree.geo:1:20: error:" "the place is named"

# ---- groups of volumes: they decide what is saved, as groups of faces do ----
cat >volume.geo <<'GEO'
Point(1) = {0, 0, 0, 0.5};
l[] = Extrude {1, 0, 0} { Point{1}; };
s[] = Extrude {0, 1, 0} { Curve{l[1]}; };
v[] = Extrude {0, 0, 1} { Surface{s[1]}; };
Physical Volume("solid", 7) = {v[1]};
GEO
exits 0 "a group of volumes only" "$MESHGEN" volume.geo -2 -format msh22 -o volume.msh
says "surface elements are dropped on saving" "the loss is told"
check "nothing is saved but the name" awk '/^\$Nodes/ { getline; n = $1 } /^\$Elements/ { getline; e = $1 } /^3 7 "solid"$/ { name = 1 }
    END { exit !(n == "0" && e == "0" && name) }' volume.msh
exits 0 "-save_all" "$MESHGEN" volume.geo -2 -format msh22 -save_all -o volume.msh
check "all is saved, and the name" awk '/^\$Elements/ { getline; e = $1 } /^3 7 "solid"$/ { name = 1 } END { exit !(e > 50 && name) }' volume.msh
