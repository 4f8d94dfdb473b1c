#!/bin/bash
# quads.sh - recombination by every method: nothing but quadrangles, transfinite beside recombined beside triangles, periodic
# curves, embedded curves that no quadrangle crosses
. "$(dirname "$0")/lib.sh"
# OpenMesh builds its half-edges of a file: manifold, with this Euler characteristic.
halfedges=$ROOT/build/${CONFIG:-release}/unit/test_halfedge
# From left to right: triangles, recombined with an embedded curve, transfinite quadrangles.
cat >mixed.geo <<'G'
h = 0.1;
For i In {0:3}
  Point(1 + 2 * i) = {i, 0, 0, h}; Point(2 + 2 * i) = {i, 1, 0, h};
  Line(100 + i) = {1 + 2 * i, 2 + 2 * i};
EndFor
For i In {0:2}
  Line(200 + i) = {1 + 2 * i, 3 + 2 * i}; Line(300 + i) = {2 + 2 * i, 4 + 2 * i};
  Curve Loop(1 + i) = {200 + i, 101 + i, -(300 + i), -(100 + i)}; Plane Surface(1 + i) = {1 + i};
EndFor
Point(21) = {1.25, 0.33, 0, h}; Point(22) = {1.75, 0.66, 0, h}; Line(400) = {21, 22}; Curve{400} In Surface{2};
Transfinite Curve{202, 302} = 9; Transfinite Surface{3}; Recombine Surface{2, 3};
Periodic Curve{103} = {100} Translate{3, 0, 0};
Physical Surface("triangles") = {1}; Physical Surface("quads") = {2}; Physical Surface("grid") = {3}; Physical Curve("crack") = {400};
G
for method in 0 1 2 3 4; do
  exits 0 "method $method: triangles, quadrangles and a transfinite face side by side" "$MESHGEN" -2 mixed.geo \
    -setnumber Mesh.RecombinationAlgorithm $method -format msh2 -o m.msh -require "quads>150" -require "min_eta>0.1"
  exits 0 "method $method: conforming, curves kept" "$MESHGEN" check m.msh
  exits 0 "method $method: OpenMesh reads a manifold" "$halfedges" m.msh 1
done
# A fan whose boundary nodes lie on straight lines: pairs of its triangles are not convex quadrangles.
cat >coarse.geo <<'G'
Point(1) = {0, 0, 0, 9}; Point(2) = {2, 0, 0, 9}; Point(3) = {1, 1, 0, 9};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 1}; Transfinite Curve{1} = 3;
Curve Loop(1) = {1:3}; Plane Surface(1) = {1}; Recombine Surface{1};
G
exits 0 "a quadrangle with a straight corner is replaced by five" "$MESHGEN" -2 coarse.geo -o c.msh -require "triangles=0"
for method in 1 2 3 4; do
  exits 0 "method $method leaves no triangle on the rectangle of the book" "$MESHGEN" -2 "$ROOT/geo/seed_rectangle.geo" \
    -setnumber Mesh.RecombineAll 1 -setnumber Mesh.RecombinationAlgorithm $method -o r.msh -require "triangles=0" -require "min_eta>0.45" -require "index_sum=1" -require "euler=1"
  exits 0 "method $method: OpenMesh reads the rectangle as a manifold" "$halfedges" r.msh 1
done
exits 0 "Blossom: sizes and angles" "$MESHGEN" -2 "$ROOT/geo/seed_rectangle.geo" -setnumber Mesh.RecombineAll 1 \
  -o r.msh -require "tau>=0.88" -require "mean_eta>=0.82" -require "irregular<90"
for method in 2 3 4; do
  exits 0 "method $method: sizes" "$MESHGEN" -2 "$ROOT/geo/seed_rectangle.geo" -setnumber Mesh.RecombineAll 1 \
    -setnumber Mesh.RecombinationAlgorithm $method -o r.msh -require "tau>=0.8" -require "quads<1000"
done
exits 0 "algorithm 8: sizes and angles" "$MESHGEN" -2 "$ROOT/geo/seed_rectangle.geo" -setnumber Mesh.RecombineAll 1 -algo delquad \
  -o r.msh -require "tau>=0.9" -require "mean_eta>=0.86" -require "irregular<70"
exits 0 "the greedy method leaves few" "$MESHGEN" -2 "$ROOT/geo/seed_rectangle.geo" -setnumber Mesh.RecombineAll 1 \
  -setnumber Mesh.RecombinationAlgorithm 0 -o r.msh -require "triangles<=200" -require "quads>=800"
# Double size does not follow holes of four to eight edges: two coarse edges overlap, or put back on the circle their middles lie beyond
# the coarse elements around.
cat >holes.geo <<'G'
h = 0.2; Point(1) = {0, 0, 0, h}; Point(2) = {2, 0, 0, h}; Point(3) = {2, 2, 0, h}; Point(4) = {0, 2, 0, h};
For i In {1:4}
  Line(i) = {i, i % 4 + 1};
EndFor
Curve Loop(1) = {1:4}; s() = {1};
For i In {0:8}
  x = 0.4 + 0.6 * (i % 3); y = 0.4 + 0.6 * Floor(i / 3); r = 0.22; p = 10 + 5 * i; c = 100 + 2 * i;
  Point(p) = {x, y, 0, h}; Point(p + 1) = {x + r, y, 0, h}; Point(p + 2) = {x - r, y, 0, h};
  Circle(c) = {p + 1, p, p + 2}; Circle(c + 1) = {p + 2, p, p + 1}; Curve Loop(10 + i) = {c, c + 1}; s() += {10 + i};
EndFor
Plane Surface(1) = {s()};
G
for method in 2 3 4; do
  for scale in 1 1.3 1.6 2 2.5 3; do
    exits 0 "method $method, size factor $scale: no quadrangle is turned over by the nodes put back on small holes" "$MESHGEN" -2 holes.geo \
      -require "index_sum=-8" -require "euler=-8" -clscale $scale -setnumber Mesh.RecombineAll 1 -setnumber Mesh.RecombinationAlgorithm $method -o h.msh
    exits 0 "method $method, size factor $scale: OpenMesh reads nine holes" "$halfedges" h.msh -8
  done
done
cat >spline.geo <<'G'
Point(1) = {0, 0, 0, 1}; Point(2) = {1, 0, 0, 1}; Point(3) = {1, 1, 0, 1}; Point(4) = {0, 1, 0, 1};
For i In {1:4}
  Line(i) = {i, i % 4 + 1};
EndFor
Point(5) = {0.2, 0.8, 0, 1}; Point(6) = {0.8, 0.2, 0, 1}; Point(7) = {0.45, 0.5, 0, 1}; Spline(5) = {5, 7, 6, 5};
Curve Loop(1) = {1:4}; Curve Loop(2) = {5}; Plane Surface(1) = {1, 2};
G
for method in 2 3 4; do
  exits 0 "method $method: a closed curve of four edges" "$MESHGEN" -2 spline.geo -setnumber Mesh.RecombineAll 1 \
    -setnumber Mesh.RecombinationAlgorithm $method -o h.msh -require "triangles=0"
done
# Faces that share curves, one of them closed and within another, side by side on periodic sides: all recombined, then one in triangles.
cat >shared.geo <<'G'
h = 0.13; Point(1) = {0, 0, 0, h}; Point(2) = {1, 0, 0, h}; Point(3) = {2, 0, 0, h}; Point(4) = {2, 1, 0, h};
Point(5) = {1, 1, 0, h}; Point(6) = {0, 1, 0, h}; Point(7) = {0.5, 0.5, 0, h / 2}; Point(8) = {0.75, 0.5, 0, h / 2}; Point(9) = {0.25, 0.5, 0, h / 2};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 5}; Line(5) = {5, 6}; Line(6) = {6, 1}; Line(7) = {2, 5};
Circle(8) = {8, 7, 9}; Circle(9) = {9, 7, 8};
Curve Loop(1) = {1, 7, 5, 6}; Curve Loop(2) = {8, 9}; Curve Loop(3) = {2, 3, 4, -7};
Plane Surface(1) = {1, 2}; Plane Surface(2) = {2}; Plane Surface(3) = {3};
Periodic Curve{3} = {-6} Translate{2, 0, 0};
Point(10) = {1.3, 0.3, 0, h}; Point(11) = {1.7, 0.6, 0, h}; Line(10) = {10, 11}; Curve{10} In Surface{3};
Physical Surface("all") = {1:3}; Physical Curve("crack") = {10};
G
for algorithm in 6 8 9; do
  for method in 0 1 2 3; do
    options="-setnumber Mesh.Algorithm $algorithm -setnumber Mesh.RecombinationAlgorithm $method"
    none=$([ $method = 0 ] || echo '-require triangles=0 -require index_sum=2 -require euler=2')
    # shellcheck disable=SC2086
    exits 0 "algorithm $algorithm, method $method: faces that share curves" "$MESHGEN" -2 shared.geo $options -setnumber Mesh.RecombineAll 1 -o s.msh $none
    exits 0 "algorithm $algorithm, method $method: conforming, embedded and periodic curves kept" "$MESHGEN" check s.msh
    exits 0 "algorithm $algorithm, method $method: OpenMesh reads a manifold" "$halfedges" s.msh 1
  done
done
cat >some.geo <<'G'
Include "shared.geo";
Recombine Surface{2} = 20; Recombine Surface{3};
G
exits 0 "some faces recombined, one with an angle of its own" "$MESHGEN" -2 some.geo -o s.msh -require "quads>20" -require "triangles>20"
exits 0 "they conform" "$MESHGEN" check s.msh
exits 0 "OpenMesh reads them as one manifold" "$halfedges" s.msh 1
# Odd numbers fixed by the user are made even by curves that are free; where none is, one triangle stays and is named.
cat >odd.geo <<'G'
h = 0.17; Point(1) = {0, 0, 0, h}; Point(2) = {1, 0, 0, h}; Point(3) = {1, 1, 0, h}; Point(4) = {0, 1, 0, h}; Point(5) = {2, 0, 0, h}; Point(6) = {2, 1, 0, h};
For i In {1:4}
  Line(i) = {i, i % 4 + 1};
EndFor
Line(5) = {2, 5}; Line(6) = {5, 6}; Line(7) = {6, 3}; Curve Loop(1) = {1:4}; Curve Loop(2) = {5, 6, 7, -2};
Plane Surface(1) = {1}; Plane Surface(2) = {2}; Transfinite Curve{1} = 8; Transfinite Curve{6} = 4;
G
sed '$a Transfinite Curve{5, 7} = 5; Transfinite Curve{2:4} = 7;' odd.geo >fixed.geo
for method in 1 2 3; do
  for all in 0 1; do
    options="-setnumber Mesh.RecombineAll $all -setnumber Mesh.RecombinationAlgorithm $method"
    { cat odd.geo; [ $all = 1 ] || echo 'Recombine Surface{1, 2};'; } >odd_$all.geo
    # shellcheck disable=SC2086
    exits 0 "method $method, all $all: odd numbers on two curves" "$MESHGEN" -2 odd_$all.geo $options -o o.msh -require triangles=0 -require "quads>30"
  done
  exits 0 "method $method: odd numbers everywhere leave one triangle a face" "$MESHGEN" -2 fixed.geo \
    -setnumber Mesh.RecombineAll 1 -setnumber Mesh.RecombinationAlgorithm $method -o o.msh -require triangles=2
done
# Few elements, corners that are not right, curves inside: the worst quadrangle is no worse than the geometry asks for.
cat >disc.geo <<'G'
Point(1) = {0, 0, 0, 0.15}; Point(2) = {1, 0, 0, 0.15}; Point(3) = {-1, 0, 0, 0.15}; Circle(1) = {2, 1, 3}; Circle(2) = {3, 1, 2};
Curve Loop(1) = {1, 2}; Plane Surface(1) = {1};
G
cat >triangle.geo <<'G'
Point(1) = {0, 0, 0, 0.1}; Point(2) = {1, 0, 0, 0.1}; Point(3) = {0.3, 0.8, 0, 0.1}; Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 1};
Curve Loop(1) = {1:3}; Plane Surface(1) = {1};
G
cat >inside.geo <<'G'
Point(1) = {0, 0, 0, 0.1}; Point(2) = {1, 0, 0, 0.1}; Point(3) = {1, 1, 0, 0.1}; Point(4) = {0, 1, 0, 0.1};
For i In {1:4}
  Line(i) = {i, i % 4 + 1};
EndFor
Point(5) = {0.5, 0.5, 0, 0.05}; Point(6) = {0.7, 0.5, 0, 0.05}; Point(7) = {0.3, 0.5, 0, 0.05}; Circle(5) = {6, 5, 7}; Circle(6) = {7, 5, 6};
Curve Loop(1) = {1:4}; Plane Surface(1) = {1}; Curve{5, 6} In Surface{1};
G
for model in disc triangle inside; do
  for algorithm in 6 8; do
    for method in 1 2 3; do
      exits 0 "$model, algorithm $algorithm, method $method: good quadrangles only" "$MESHGEN" -2 $model.geo -setnumber Mesh.RecombineAll 1 \
        -setnumber Mesh.Algorithm $algorithm -setnumber Mesh.RecombinationAlgorithm $method -o w.msh -require triangles=0 -require "min_eta>0.4"
    done
  done
done
# A strip narrower than the edges on both sides, which do not face each other: few pairs are convex.
cat >strip.geo <<'G'
DefineConstant[ m = {6}, k = {4}, w = {49} ];
L = k * (m * 98 + 2); Point(1) = {0, 0, 0, 100}; Point(2) = {L, 0, 0, 100}; Line(1) = {1, 2}; Transfinite Curve{1} = Round(L / 100) + 1;
x = L; p = 100; Point(p) = {x, w, 0, 100}; Line(2) = {2, p}; Transfinite Curve{2} = 2; c() = {1, 2};
For j In {1:k}
  For i In {1:m + 1}
    x -= (i == m / 2) ? 2 : 98; Point(p + 1) = {x, w, 0, 100}; Line(p) = {p, p + 1}; Transfinite Curve{p} = 2; c() += {p}; p += 1;
  EndFor
EndFor
Line(3) = {p, 1}; Transfinite Curve{3} = 2; c() += {3};
Curve Loop(1) = {c()}; Plane Surface(1) = {1}; Recombine Surface{1};
G
for w in 30 40 49 60; do
  exits 0 "a strip of width $w" "$MESHGEN" -2 strip.geo -setnumber w $w -o s.msh -require triangles=0
  exits 0 "a strip of width $w, shorter" "$MESHGEN" -2 strip.geo -setnumber w $w -setnumber k 2 -setnumber m 12 -o s.msh -require triangles=0
done
# Boundary layers: tips of fans, walls of all angles at curves that cannot take the nodes of the layers, explicit odd numbers.
cat >layers.geo <<'G'
h = 0.12;
Point(1) = {0, 0, 0, h}; Point(2) = {3, 0, 0, h}; Point(3) = {3.6, 2, 0, h}; Point(4) = {-1, 2, 0, h};
Point(5) = {1, 0.7, 0, h}; Point(6) = {2, 0.8, 0, h}; Point(7) = {1.5, 1.4, 0, h};
For i In {1:4}
  Line(i) = {i, i % 4 + 1};
EndFor
Line(5) = {5, 6}; Line(6) = {6, 7}; Line(7) = {7, 5}; Transfinite Curve{2, 3, 4} = 19;
Curve Loop(1) = {1:4}; Curve Loop(2) = {5:7}; Plane Surface(1) = {1, 2}; Recombine Surface{1};
Field[1] = BoundaryLayer; Field[1].CurvesList = {1}; Field[2] = BoundaryLayer; Field[2].CurvesList = {5:7};
Field[2].FanPointsList = {5:7}; Field[2].FanPointsSizesList = {3, 7, 1};
For i In {1:2}
  Field[i].Size = 0.01; Field[i].Ratio = 1.3; Field[i].Thickness = 0.15;
EndFor
BoundaryLayer Field = 1; BoundaryLayer Field = 2;
G
for angle in 2 3 4; do # points of the quadrilateral that move up or down
  exits 0 "boundary layers in quadrangles, $angle" "$MESHGEN" -2 layers.geo -o l.msh -require triangles=0 -require index_sum=0 -require "quads>700"
  exits 0 "boundary layers $angle: conforming" "$MESHGEN" check l.msh
  exits 0 "boundary layers $angle: a manifold with one hole" "$halfedges" l.msh 0
  sed -i "s/^Point(1) = {0, 0, 0, h}; Point(2) = {[0-9.]*/Point(1) = {-$angle, 0, 0, h}; Point(2) = {2.$angle/" layers.geo
done
# Spikes far from the origin: corners that are flat but for rounding would fold when their quadrangles are halved.
cat >spikes.geo <<'G'
DefineConstant[a = -1, w = 0.001];
Point(1) = {1000, 0, 0, 2};
For i In {0:4}
  r = 10 + i / 2; t = a + w * i;
  Point(3 * i + 2) = {1000 + r * Cos(t), r * Sin(t), 0, 2}; Point(3 * i + 3) = {1000 + r * Cos(t + w / 2), r * Sin(t + w / 2), 0, 2};
  Point(3 * i + 4) = {1000 + Cos(t + 0.75 * w), Sin(t + 0.75 * w), 0, 2};
EndFor
For i In {1:14}
  Line(i) = {i, i + 1};
EndFor
Line(15) = {15, 1}; Curve Loop(1) = {1:15}; Plane Surface(1) = {1};
Recombine Surface{1}; Mesh.SubdivisionAlgorithm = 1;
G
for a in -1 -0.9 0.3; do for w in 0.001 0.003; do exits 0 "spikes of $w at $a" "$MESHGEN" -2 spikes.geo -setnumber a $a -setnumber w $w -o spikes.msh; done; done
# Embedded lines with loose ends: two elements that share an edge of one share the next edge too, which must not be merged away.
cat >star.geo <<'G'
Point(26) = {-8.692626, 22.553938, 0, 2}; Point(27) = {-16.08888, 24.5047, 0, 2}; Point(28) = {-19.101702, 17.53391, 0, 1.378}; Point(29) = {-11.750801, 15.509653, 0, 3.64};
Point(30) = {-13.92994, 20.028117, 0, 0.683}; Point(31) = {-14.319468, 18.549628, 0, 2}; Point(32) = {-13.016878, 18.801748, 0, 2}; Point(33) = {-12.401841, 19.977348, 0, 2};
Point(34) = {-12.937492, 21.191178, 0, 2}; Point(35) = {-14.220474, 21.529201, 0, 7.56}; Point(36) = {-15.284679, 20.736879, 0, 2}; Point(37) = {-15.328739, 19.410846, 0, 2};
Spline(23) = {26, 27, 28}; Spline(24) = {28, 29, 26}; Curve Loop(5) = {23, 24}; Plane Surface(3) = {5};
For i In {25:31}
  Line(i) = {30, i + 6}; Curve{i} In Surface{3};
EndFor
Recombine Surface{3}; Mesh.MeshSizeFactor = 10;
G
for r in 1 2 3; do exits 0 "a star of embedded lines, method $r" "$MESHGEN" -2 star.geo -setnumber Mesh.RecombinationAlgorithm $r -o star.msh; done
# A loop of few edges, of which every second node is left out: the hole is outside of what remains.
cat >outside.geo <<'G'
h = 9; Point(1) = {-0.9, -0.9, 0, h}; Point(2) = {0.6, -1.25, 0, h}; Point(3) = {1.3, 0.2, 0, h}; Point(4) = {0.2, 1.25, 0, h}; Point(5) = {-1.1, 0.6, 0, h};
Spline(1) = {1, 2, 3, 4}; Line(2) = {4, 5}; Line(3) = {5, 1}; Curve Loop(1) = {1:3};
Point(6) = {0.35, -0.2, 0, h}; Point(7) = {0.6, -0.1, 0, h}; Point(8) = {0.5, 0.2, 0, h}; Line(4) = {6, 7}; Line(5) = {7, 8}; Line(6) = {8, 6};
Curve Loop(2) = {4:6}; Plane Surface(1) = {1, 2}; Recombine Surface{1};
G
for r in 2 3; do exits 0 "a hole outside of the coarse polygon, method $r" "$MESHGEN" -2 outside.geo -setnumber Mesh.RecombinationAlgorithm $r -o outside.msh; done
echo "1..$count"
