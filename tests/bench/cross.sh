#!/bin/bash
# cross.sh MESHGEN - the meshes made for quads beside the triangle front: shape, sizes, irregular vertices, processor time
set -u
meshgen=$1
root=$(cd "$(dirname "$0")/../.." && pwd)
tmp=$(mktemp -d) && trap 'rm -rf "$tmp"' EXIT
cat >"$tmp/square.geo" <<'G'
h = 0.007;
Point(1) = {0, 0, 0, h}; Point(2) = {1, 0, 0, h}; Point(3) = {1, 1, 0, h}; Point(4) = {0, 1, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
G
cat >"$tmp/disc.geo" <<'G'
h = 0.03;
Point(1) = {0, 0, 0, h}; Point(2) = {1, 0, 0, h}; Point(3) = {0, 1, 0, h}; Point(4) = {-1, 0, 0, h}; Point(5) = {0, -1, 0, h};
Circle(1) = {2, 1, 3}; Circle(2) = {3, 1, 4}; Circle(3) = {4, 1, 5}; Circle(4) = {5, 1, 2};
Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
G
figure() { grep -oE "\"$1\": *[-0-9.e]+" "$tmp/report" | head -n 1 | sed 's/.*: *//'; }
printf '%-24s %5s %8s %5s %8s %8s %7s %11s %8s\n' model algo quads tris min_eta mean_eta tau irregular cpu_s
one() { # one NAME FILE OPTION...
  local name=$1 file=$2 a t0 t1
  shift 2
  for a in 6 8 9; do
    times >"$tmp/t0"
    "$meshgen" -2 "$file" -nt 1 -json -setnumber Mesh.RecombineAll 1 -setnumber Mesh.Algorithm $a "$@" -o "$tmp/m.msh" >"$tmp/report" 2>"$tmp/err" ||
      { echo "$name algorithm $a failed: $(head -n 1 "$tmp/err")"; continue; }
    times >"$tmp/t1"
    t0=$(sed -n '2s/ .*//p' "$tmp/t0") t1=$(sed -n '2s/ .*//p' "$tmp/t1")
    awk -v name="$name" -v a=$a -v q="$(figure quads)" -v t="$(figure triangles)" -v lo="$(figure min_eta)" -v mean="$(figure mean_eta)" \
      -v tau="$(figure tau)" -v irr="$(figure irregular)" -v n="$(figure nodes)" -v b="$(figure lines)" -v t0="$t0" -v t1="$t1" '
      function s(x, p) { split(x, p, /[ms]/); return 60 * p[1] + p[2] }
      BEGIN { printf "%-24s %5d %8d %5d %8.3f %8.3f %7.3f %5d %4.1f%% %8.2f\n", name, a, q, t, lo, mean, tau, irr, 100 * irr / (n - b), s(t1) - s(t0) }'
  done
}
one "rectangle of the book" "$root/geo/seed_rectangle.geo"
one "rectangle, scale 0.3" "$root/geo/seed_rectangle.geo" -setnumber s 0.3
one "square, h = 0.007" "$tmp/square.geo"
one "disc, h = 0.03" "$tmp/disc.geo"
one "conge" "$root/geo/conge.geo"
one "naca0012" "$root/geo/naca0012.geo"
