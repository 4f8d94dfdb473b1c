#!/bin/bash
# structured.sh - what scripts can ask of transfinite and extruded faces, subdivision, order and periodicity, and what is said when it
# cannot be
. "$(dirname "$0")/lib.sh"
square='Point(1)={0,0,0,.1};Point(2)={1,0,0,.1};Point(3)={1,1,0,.1};Point(4)={0,1,0,.1};
Line(1)={1,2};Line(2)={2,3};Line(3)={3,4};Line(4)={4,1};Curve Loop(1)={1:4};Plane Surface(1)={1};'
disc='Point(1)={0,0,0,.3};Point(2)={1,0,0,.3};Point(3)={0,1,0,.3};Point(4)={-1,0,0,.3};Point(5)={0,-1,0,.3};
Circle(1)={2,1,3};Circle(2)={3,1,4};Circle(3)={4,1,5};Circle(4)={5,1,2};Curve Loop(1)={1:4};Plane Surface(1)={1};'
mesh() { # SCRIPT ARGS...: mesh it to a.msh; the report's first lines stay in $out
  printf '%s\n' "$1" >a.geo
  shift
  exits "${want:-0}" "${name:?}" "$MESHGEN" -2 a.geo -format msh2 -o a.msh "$@"
}

# ---- grids ----
name="a grid of 3 x 5"
mesh "$square Transfinite Curve{1,3}=4;Transfinite Curve{2,4}=6;Transfinite Surface{1};Recombine Surface{1};"
prints "24 nodes, 16 lines, 0 triangles, 15 quadrangles" "a grid has nu * nv cells"
name="sides that do not match"
mesh "$square Transfinite Curve{1}=4;Transfinite Curve{2:4}=6;Transfinite Surface{1};"
says "opposite sides have 3 and 5, 5 and 5 elements" "unequal sides are named, and the face is meshed all the same"
name="holes in a grid"
mesh "$square Point(11)={.3,.3,0,.1};Point(12)={.6,.3,0,.1};Point(13)={.4,.6,0,.1};Line(11)={11,12};Line(12)={12,13};Line(13)={13,11};
Curve Loop(2)={11:13};Plane Surface(2)={1,2};Delete{Surface{1};} Transfinite Surface{2};"
says "it has holes" "a face with holes is no grid"
name="a point in a grid"
mesh "$square Transfinite Curve{1:4}=6;Transfinite Surface{1};Point(9)={.31,.43,0,.05};Point{9} In Surface{1};"
says "point 9 is embedded in it" "a grid has no place for embedded points"
name="a corner that is none"
mesh "$square Point(9)={.5,.5,0,.1};Transfinite Surface{1}={1,2,3,9};"
says "is not on its boundary" "corners must lie on the boundary"
name="a folded grid"
mesh 'Point(1)={0,0,0,1};Point(2)={4,0,0,1};Point(3)={4,4,0,1};Point(4)={3.5,0.3,0,1};
Line(1)={1,2};Line(2)={2,3};Line(3)={3,4};Line(4)={4,1};Curve Loop(1)={1:4};Plane Surface(1)={1};Transfinite Curve{1:4}=9;Transfinite Surface{1};'
check "a concave grid is unfolded or given up, never folded" "$MESHGEN" check a.msh
name="TransfiniteTri"
mesh 'Point(1)={0,0,0,1};Point(2)={1,0,0,1};Point(3)={.5,.9,0,1};Line(1)={1,2};Line(2)={2,3};Line(3)={3,1};Curve Loop(1)={1:3};
Plane Surface(1)={1};Transfinite Curve{1:3}=6;Transfinite Surface{1};Mesh.TransfiniteTri=1;'
prints "21 nodes, 15 lines, 25 triangles" "a triangular grid has n * n triangles"

# ---- along normals ----
name="layers round a square"
mesh "$square Delete{Surface{1};} e[]=Extrude{Line{1:4};Layers{{3,2},{.02,.1}};Recombine;}; Printf('%g %g', #e[], e[7]);
Physical Surface(1)={e[1],e[5],e[9],e[13]};"
prints "16 -7" "their sides are shared"
prints "1                                  200  0.44" "they are as thick as asked for, round the corners too"
name="layers round a circle, and the rest"
mesh 'lc=.1;Point(1)={0,0,0};Point(2)={.5,0,0,lc};Point(3)={0,.5,0,lc};Point(4)={-.5,0,0,lc};Point(5)={0,-.5,0,lc};
Circle(1)={2,1,3};Circle(2)={3,1,4};Circle(3)={4,1,5};Circle(4)={5,1,2};
e[]=Extrude{Line{1:4};Layers{{5,5},{.05,.2}};Recombine;};Line Loop(1)={e[0],e[4],e[8],e[12]};
Point(101)={-2,-2,0,.4};Point(102)={4,-2,0,.4};Point(103)={4,2,0,.4};Point(104)={-2,2,0,.4};
Line(101)={101,102};Line(102)={102,103};Line(103)={103,104};Line(104)={104,101};Line Loop(2)={101:104};Plane Surface(9)={2,1};'
prints "320 quadrangles" "ten layers on 32 edges"
check "fit together" "$MESHGEN" check a.msh
name="surfaces along normals"
want=1 mesh "$square Extrude{Surface{1};Layers{2,.1};}"
says "takes curves alone" "surfaces are refused"

# ---- boundary layers on embedded curves ----
channel='Point(1)={0,0,0,.1};Point(2)={1,0,0,.1};Point(3)={2,0,0,.1};Point(4)={2,1,0,.1};Point(5)={0,1,0,.1};Line(1)={1,2};Line(2)={2,3};
Line(3)={3,4};Line(4)={4,5};Line(5)={5,1};Curve Loop(1)={1:5};Plane Surface(1)={1};Point(6)={1,.5,0,.1};Line(6)={2,6};Curve{6} In Surface{1};
Physical Surface(1)={1};Field[1]=BoundaryLayer;Field[1].Size=.01;Field[1].Ratio=1.3;Field[1].Thickness=.04;Field[1].Quads=1;BoundaryLayer Field=1;'
name="a fin with layers on both sides"
mesh "$channel Field[1].CurvesList={6};"
prints "42 quadrangles" "5 edges, 3 layers on either side, and a fan round the tip"
check "fit together" "$MESHGEN" check a.msh
name="a fin on a wall, both with layers"
mesh "$channel Field[1].CurvesList={1,2,6};"
prints "102 quadrangles" "the layers of both go on into each other"
prints "                                  682  2" "nothing is lost of the face"
name="layers that end at a fin"
mesh "$channel Field[1].CurvesList={1};Field[1].PointsList={1,2};"
prints "30 quadrangles" "ten edges, three layers"
check "their last column lies on it" "$MESHGEN" check a.msh
name="a cut with three arms"
mesh "$channel Point(7)={.5,.5,0,.1};Point(8)={.2,.3,0,.1};Point(9)={.2,.7,0,.1};Point(10)={.8,.5,0,.1};Line(7)={7,8};Line(8)={7,9};Line(9)={10,7};
Curve{7,8,9} In Surface{1}; Field[1].CurvesList={7,8,9};"
prints "  2
" "nothing is lost of the face"
check "has layers all round" "$MESHGEN" check a.msh

# ---- halved, where thin cells stand on a bent curve ----
around='Point(11)={-3,-3,0,1};Point(12)={3,-3,0,1};Point(13)={3,3,0,1};Point(14)={-3,3,0,1};Line(11)={11,12};Line(12)={12,13};Line(13)={13,14};
Line(14)={14,11};Curve Loop(2)={11:14};Plane Surface(2)={2,1};Physical Surface(1)={1,2};'
name="layers thinner than the bulge of an edge"
mesh "$disc""$around"'Field[1]=BoundaryLayer;Field[1].CurvesList={1:4};Field[1].Size=.002;Field[1].Ratio=1.3;Field[1].Thickness=.02;
Field[1].Quads=1;BoundaryLayer Field=1;Mesh.SubdivisionAlgorithm=1;'
says "edges had to be halved nearer to straight lines than their curves" "stay nearer to the chords"
check "no part turns over" "$MESHGEN" check a.msh
name="and refined"
mesh "$disc""$around"'Field[1]=BoundaryLayer;Field[1].CurvesList={1:4};Field[1].Size=.002;Field[1].Ratio=1.3;Field[1].Thickness=.02;
BoundaryLayer Field=1;Mesh 2;RefineMesh;'
check "no triangle does" "$MESHGEN" check a.msh

# ---- faces that copy faces ----
name="a box of layers"
mesh 'Point(1)={2,0,0};l[]=Extrude{1,0,0}{Point{1};Layers{4};};s[]=Extrude{0,1,0}{Curve{l[1]};Layers{4};Recombine;};
v[]=Extrude{0,0,1}{Surface{s[1]};Layers{4};Recombine;};'
prints "98 nodes, 48 lines, 0 triangles, 96 quadrangles" "the far end of a swept face has its mesh"
same_cells() { # ENTITY ENTITY: have they equally many elements of each type in a.msh?
  awk -v a="$1" -v b="$2" '/^\$Elements/ { on = 1 } on && NF > 5 && ($2 == 2 || $2 == 3) { n[$5, $2]++ }
    END { exit !(n[a, 2] + n[a, 3] > 5 && n[a, 2] == n[b, 2] && n[a, 3] == n[b, 3]) }' a.msh
}
name="a free mesh swept round an axis"
mesh "$square Recombine Surface{1}; Extrude{{0,1,0},{-1,0,0},Pi/3}{Surface{1};Layers{3};}"
check "both ends have the same cells" same_cells 1 26
check "and fit the sides" "$MESHGEN" check a.msh
name="a periodic box"
mesh "${square/1,1,0,.1/1,1,0,.02} e[]=Extrude{0,0,1}{Surface{1};}; Periodic Surface{e[0]}={1} Translate{0,0,1};
Periodic Surface{e[3]}={e[5]} Translate{1,0,0};"
check "its top has the cells of its bottom" same_cells 1 26
check "and its right side those of its left" same_cells 17 25
check "and all fits" "$MESHGEN" check a.msh

# ---- surfaces in space ----
area() { awk -v want="$1" -v share="$2" '$1 == "surface" && $2 == 1 { a = $NF } END { exit !(a < want && a > (1 - share) * want) }' out.txt; }
name="a torus in three turns"
mesh 'Point(1)={2,0,0,.3};Point(2)={2.7,0,0,.3};Point(3)={2,0,.7,.3};Point(4)={1.3,0,0,.3};Point(5)={2,0,-.7,.3};
Circle(1)={2,1,3};Circle(2)={3,1,4};Circle(3)={4,1,5};Circle(4)={5,1,2}; a[]={1:4};
For i In {1:3}
  b[]=Extrude{{0,0,1},{0,0,0},2*Pi/3}{Line{a[]};}; a[]={b[0],b[4],b[8],b[12]};
EndFor
Physical Surface(1)={:};'
check "lacks less than 0.7 percent of 4 pi^2 R r, by chords" area 55.2698 0.007
name="a cone with its tip on the axis"
mesh 'Point(1)={0,0,1,.1};Point(2)={1,0,0,.1};Line(1)={1,2};a=1;
For i In {1:4}
  b[]=Extrude{{0,0,1},{0,0,0},Pi/2}{Line{a};}; a=b[0];
EndFor
Physical Surface(1)={:};'
check "lacks half a percent of pi sqrt 2" area 4.44288 0.005
name="a sphere of eight patches"
mesh 'lc=.2;Point(1)={0,0,0};Point(2)={1,0,0,lc};Point(3)={0,1,0,lc};Point(4)={-1,0,0,lc};Point(5)={0,-1,0,lc};Point(6)={0,0,1,lc};
Point(7)={0,0,-1,lc};Circle(1)={2,1,3};Circle(2)={3,1,4};Circle(3)={4,1,5};Circle(4)={5,1,2};Circle(5)={2,1,6};Circle(6)={3,1,6};
Circle(7)={4,1,6};Circle(8)={5,1,6};Circle(9)={2,1,7};Circle(10)={3,1,7};Circle(11)={4,1,7};Circle(12)={5,1,7};
For i In {0:3}
  j=(i+1)%4; Line Loop(10+i)={1+i,6+i-4*(i==3),-(5+i)};Ruled Surface(10+i)={10+i};
  Line Loop(20+i)={1+i,10+i-4*(i==3),-(9+i)};Ruled Surface(20+i)={20+i};
EndFor
Physical Surface(1)={:};'
check "lacks one percent of 4 pi" area 12.5664 0.01

# ---- bodies in contact ----
name="two squares that are not joined"
mesh 'Point(1)={0,0,0,.1};Point(2)={1,0,0,.1};Point(3)={1,1,0,.1};Point(4)={0,1,0,.1};Line(1)={1,2};Line(2)={2,3};Line(3)={3,4};
Line(4)={4,1};Point(5)={0,1,0,.07};Point(6)={1,1,0,.07};Point(7)={1,2,0,.07};Point(8)={0,2,0,.07};Line(5)={5,6};Line(6)={6,7};
Line(7)={7,8};Line(8)={8,5};Line Loop(1)={1:4};Line Loop(2)={5:8};Plane Surface(1)={1};Plane Surface(2)={2};'
prints "100 lines" "each has its own nodes on the contact"
check "which the audit only mentions" "$MESHGEN" check a.msh

# ---- compound surfaces ----
strips='lc=.15;Point(1)={0,0,0,lc};Point(2)={1,0,0,lc};Point(3)={2,0,0,lc};Point(4)={2,1,0,lc};Point(5)={1.02,1,0,lc};
Point(6)={0,1,0,lc};Point(7)={1.05,1,0,lc};Point(8)={1.03,0,0,lc};Line(1)={1,2};Line(2)={2,8};Line(3)={8,3};Line(4)={3,4};
Line(5)={4,7};Line(6)={7,5};Line(7)={5,6};Line(8)={6,1};Line(9)={2,5};Line(10)={8,7};
Line Loop(1)={1,9,7,8};Plane Surface(1)={1};Line Loop(2)={2,10,6,-9};Plane Surface(2)={2};Line Loop(3)={3,4,5,-10};Plane Surface(3)={3};
Physical Surface(1)={1,2,3};Compound Surface{1,2,3};'
name="a narrow strip between two faces"
mesh "$strips"
check "does not make small elements" awk 'NR == 1 { for (i = 2; i <= NF; i++) if ($i ~ /^triangles/) exit !($(i - 1) < 330) }' out.txt
check "and nothing is on the curves that dissolve" awk '/^\$Elements/ { on = 1 } on && $2 == 1 && ($5 == 9 || $5 == 10) { exit 1 }' a.msh
check "the whole passes the audit" "$MESHGEN" check a.msh
area() { awk -v want="$1" '$1 == "surface" && $2 == 1 { a = $NF } END { exit !(a > want - 1e-9 && a < want + 1e-9) }' out.txt; }
check "and has the area of all three" area 2
name="a curve in a group"
mesh "$strips Physical Curve(7)={9};" -save_all
check "stays" awk '/^\$Elements/ { on = 1 } on && $2 == 1 && $5 == 9 { n++ } END { exit !(n > 4) }' a.msh
check "as edges of the mesh" "$MESHGEN" check a.msh

name="a face that is turned the other way"
turned=$(echo "$strips" | sed 's/Line Loop(2)={2,10,6,-9}/Line Loop(2)={9,-6,-10,-2}/')
mesh "$turned"
check "goes with the others" awk 'NR == 1 { for (i = 2; i <= NF; i++) if ($i ~ /^triangles/) exit !($(i - 1) < 330) }' out.txt
check "as the first is turned" "$MESHGEN" check a.msh
check "with the area of all" area 2
mesh "$turned Physical Curve(7)={9};" -save_all
check "and a curve in a group stays" awk '/^\$Elements/ { on = 1 } on && $2 == 1 && $5 == 9 { n++ } END { exit !(n > 4) }' a.msh
check "as edges of the mesh too" "$MESHGEN" check a.msh

# ---- compound curves ----
wall='Point(1)={0,0,0,.3};Point(2)={.55,0,0,.3};Point(3)={1,.1,0,.3};Point(4)={1.7,0,0,.3};Point(5)={2,0,0,.3};Point(6)={2,1,0,.3};
Point(7)={0,1,0,.3};Line(1)={1,2};Spline(2)={4,3,2};Line(3)={4,5};Line(4)={5,6};Line(5)={6,7};Line(6)={7,1};
Curve Loop(1)={1,-2,3:6};Plane Surface(1)={1};Compound Curve{1,2,3};'
lines_of() { awk -v curve="$1" '/^\$Elements/ { on = 1 } on && $2 == 1 && $5 == curve { n++ } END { print n + 0 }' a.msh; }
name="three curves meshed as one"
mesh "$wall"
check "all on the curve of least number" [ "$(lines_of 1) $(lines_of 2) $(lines_of 3)" = "7 0 0" ]
check "their points are in no triangle" awk '/^\$Elements/ { on = 1 } on && $2 == 2 && ($6 <= 4 && $6 >= 2 || $7 <= 4 && $7 >= 2 || $8 <= 4 && $8 >= 2) { exit 1 }' a.msh
check "the mesh passes the audit" "$MESHGEN" check a.msh
name="groups of their own"
mesh "$wall Physical Curve(1)={1};Physical Curve(2)={2,3};Physical Surface(3)={1};"
check "keep the point between them" [ "$(lines_of 1) $(lines_of 2) $(lines_of 3)" = "2 5 0" ]
says "curve 1 of a compound is meshed on its own" "and that is said"
name="layers on a part"
mesh "$wall Field[1]=BoundaryLayer;Field[1].CurvesList={2};Field[1].PointsList={1,5};Field[1].Size=.01;Field[1].Ratio=1.3;Field[1].Thickness=.1;Field[1].Quads=1;BoundaryLayer Field=1;"
prints "58 triangles, 35 quadrangles" "are on the whole"
name="a ring of forty lines"
mesh 'n=40; For i In {0:n-1} t=2*Pi*i/n; Point(i+1)={Cos(t),Sin(t),0,.3}; EndFor For i In {1:n} Line(i)={i,i%n+1}; EndFor
Curve Loop(1)={1:n};Plane Surface(1)={1};Compound Curve{1:n};'
check "closes on itself" [ "$(lines_of 1)" = 21 ]
name="afterwards"
area_of_all() { # AREA TOLERANCE: by the shoelace formula
  awk -v want="$1" -v tol="$2" '/^\$Nodes/ { getline; for (n = $1; n > 0; n--) { getline; x[$1] = $2; y[$1] = $3 } } /^\$Elements/ { on = 1 }
    on && $2 == 2 { s += (x[$7] - x[$6]) * (y[$8] - y[$6]) - (x[$8] - x[$6]) * (y[$7] - y[$6]) } END { s /= 2; exit !(s > want - tol && s < want + tol) }' a.msh
}
mesh "$wall Mesh 2; Point(8)={1,.5,0,.3}; RefineMesh;"
check "the script may refine the mesh" area_of_all 1.93547 2e-2
mesh "$wall Mesh 2; RefineMesh; Point(8)={1,.5,0,.3}; Point{8} In Surface{1}; Mesh 2;"
check "the script may go on" [ "$(lines_of 1) $(lines_of 2)" = "7 0" ]

name="curves along united faces"
mesh "$strips Compound Curve{1,2,3};" -save_all
check "go on where the curve between the faces dissolves" [ "$(lines_of 1) $(lines_of 2) $(lines_of 3)" = "14 0 0" ]
check "and the mesh passes the audit" "$MESHGEN" check a.msh

# ---- subdivision and order ----
name="all quadrangles"
mesh "$square" -setnumber Mesh.SubdivisionAlgorithm 1
prints "80 lines, 0 triangles" "every element becomes quadrangles, every line two"
name="refining twice"
mesh "$square Transfinite Curve{1:4}=3;Transfinite Surface{1}; Mesh 2; RefineMesh; RefineMesh; Save 'b.msh2';"
check "the saved file passes the audit" "$MESHGEN" check b.msh2
check "8 triangles become 128" [ "$(awk '/^\$Elements/ { on = 1 } on && $2 == 2 { n++ } END { print n }' b.msh2)" = 128 ]
for order in 2 3 4; do
  name="order $order"
  mesh "$disc" -order $order
  check "order $order passes the audit" "$MESHGEN" check a.msh
  check "and its nodes are on the circle" awk -v order=$order '
    /^\$Nodes/ { getline; for (n = $1; n > 0; n--) { getline; r[$1] = sqrt($2 * $2 + $3 * $3) } }
    /^\$Elements/ { on = 1 } on && ($2 == 8 || $2 == 26 || $2 == 27) { for (i = 6; i <= NF; i++) if (r[$i] - 1 > 1e-14 || 1 - r[$i] > 1e-14) bad++; seen++ }
    END { exit !(seen == 24 && !bad) }' a.msh
done

name="refining before -2"
mesh "$square Transfinite Curve{1:4}=3;Transfinite Surface{1}; Mesh 2; RefineMesh;"
prints "25 nodes, 16 lines, 32 triangles" "what a script has refined stays refined"
name="recombining afterwards"
mesh "$square Transfinite Curve{1:4}=3;Transfinite Surface{1}; Mesh 2; RecombineMesh;"
prints "9 nodes, 8 lines, 0 triangles, 4 quadrangles" "RecombineMesh makes quadrangles"
name="a size at one end alone"
mesh 'Point(1)={0,0,0};Point(2)={1,0,0,.01};Point(3)={1,1,0,.1};Line(1)={1,2};Line(2)={2,3};Line(3)={3,1};' -1
prints "lines" "the other end counts as very large"

# ---- periodicity ----
name="periodic sides"
mesh "${square/1,1,0,.1/1,1,0,.02} Periodic Curve{2}={-4} Translate{1,0,0}; Periodic Curve{3}={-1} Translate{0,1,0};" -order 2
check "the file lists equal numbers of nodes" awk '/^\$Periodic/ { getline; n = $1 } END { exit !(n >= 2) }' a.msh
check "and the nodes are images bit for bit" "$PYTHON" - <<'EOF'
import sys
lines = open("a.msh").read().split("\n")
i = lines.index("$Nodes")
node = {w[0]: tuple(map(float, w[1:4])) for w in (l.split() for l in lines[i + 2 : i + 2 + int(lines[i + 1])])}
i = lines.index("$Periodic") + 1
n, i, pairs = int(lines[i]), i + 1, 0
for _ in range(n):
    dim, slave, master = map(int, lines[i].split())
    i += 1
    shift = (0, 0, 0)
    if lines[i].startswith("Affine"):
        a = list(map(float, lines[i].split()[1:]))
        shift = (a[3], a[7], a[11])
        i += 1
    for l in lines[i + 1 : i + 1 + int(lines[i])]:
        s, m = l.split()
        pairs += 1
        if dim == 1 and node[s] != tuple(x + d for x, d in zip(node[m], shift)):
            sys.exit("node %s is not the image of %s" % (s, m))
    i += 1 + int(lines[i])
sys.exit(0 if pairs > 40 else "only %d pairs" % pairs)
EOF
