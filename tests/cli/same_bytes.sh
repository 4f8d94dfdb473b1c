# same_bytes.sh - equal input gives equal bytes: twice, with threads, without optimization, from the other compiler
. "$(dirname "$0")/lib.sh"

mesh() { "$1" -2 "$ROOT/geo/conge.geo" -v 2 -no_report "${@:3}" -o "$2.msh" -o "$2.vtk" -o "$2.svg"; }
check "mesh once" mesh "$MESHGEN" a
check "mesh again" mesh "$MESHGEN" b
for e in msh vtk svg; do same "two runs: $e" a.$e b.$e; done
check "mesh with two threads" mesh "$MESHGEN" c -nt 2
same "threads: msh" a.msh c.msh

build() { # build NAME CONFIG CC CXX: another build of the same tree, kept between runs of the tests
  make -s -C "$ROOT" CONFIG="$2" B="build/$1" CC="$3" CXX="$4" "build/$1/meshgen" >build.log 2>&1 || { tail -n 20 build.log; return 1; }
}
check "build with gcc -O0" build gcc-O0 debug gcc g++
check "mesh with gcc -O0" mesh "$ROOT/build/gcc-O0/meshgen" d
for e in msh vtk svg; do same "-O0 and -O3: $e" a.$e d.$e; done
check "build with clang" build clang release clang clang++
check "mesh with clang" mesh "$ROOT/build/clang/meshgen" e
for e in msh vtk svg; do same "gcc and clang: $e" a.$e e.$e; done
# Quadrangles: cross field, matching, clean-up and smoothing.
quads() { "$1" -2 "$ROOT/geo/seed_rectangle.geo" -v 2 -no_report -setnumber Mesh.RecombineAll 1 -algo "$3" -o "$2.msh"; }
for algorithm in front2d delquad; do
  check "quadrangles, $algorithm" quads "$MESHGEN" q $algorithm
  check "quadrangles, $algorithm, gcc -O0" quads "$ROOT/build/gcc-O0/meshgen" r $algorithm
  check "quadrangles, $algorithm, clang" quads "$ROOT/build/clang/meshgen" s $algorithm
  same "$algorithm, -O0 and -O3" q.msh r.msh
  same "$algorithm, gcc and clang" q.msh s.msh
done
