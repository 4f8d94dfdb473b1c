#!/bin/bash
# quads.sh MESHGEN - recombination side by side with gmsh (where there is one): time and quality of the same models
set -u
meshgen=$1
root=$(cd "$(dirname "$0")/../.." && pwd)
tmp=$(mktemp -d) && trap 'rm -rf "$tmp"' EXIT
report() { awk '/quadrangles|triangles|eta|tau|irregular|mesh 2D/' "$1" | sed 's/^/    /'; }
one() { # one NAME FILE OPTIONS...
  local name=$1 file=$2
  shift 2
  echo "$name: $*"
  if "$meshgen" -2 "$file" "$@" -o "$tmp/m.msh" >"$tmp/m.log" 2>&1; then report "$tmp/m.log"; else echo "    meshgen failed"; fi
  if command -v gmsh >/dev/null; then
    local opt=() a
    for a in "$@"; do opt+=("$a"); done
    timeout 120 gmsh -2 "$file" "${opt[@]}" -format msh22 -o "$tmp/g.msh" >"$tmp/g.log" 2>&1
    echo "    gmsh: exit $?; $(grep -ioE 'recombination completed.*|quads, [0-9]+ triangles.*' "$tmp/g.log" | tail -n 1)"
    "$meshgen" info "$tmp/g.msh" >"$tmp/g.rep" 2>/dev/null && grep -E "quadrangles|eta" "$tmp/g.rep" | sed 's/^/    gmsh: /'
  fi
}
for method in 0 1 3; do
  one "rectangle" "$root/geo/seed_rectangle.geo" -setnumber Mesh.RecombineAll 1 -setnumber Mesh.RecombinationAlgorithm $method
done
cat >"$tmp/square.geo" <<'G'
h = 0.007;
Point(1) = {0, 0, 0, h}; Point(2) = {1, 0, 0, h}; Point(3) = {1, 1, 0, h}; Point(4) = {0, 1, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
G
one "square h=0.007" "$tmp/square.geo" -setnumber Mesh.RecombineAll 1 -setnumber Mesh.Algorithm 6
