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

# Converted by one thread and by three: large blocks are read and written in parts.
cat >big.geo <<'END'
Point(1) = {0, 0, 0, 0.013}; Point(2) = {1, 0, 0, 0.004}; Point(3) = {0.7, 1.1, 0, 0.013}; Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 1};
Curve Loop(1) = {1:3}; Plane Surface(1) = {1}; Physical Surface("in") = {1}; Physical Surface("twice") = {1}; Physical Curve("rim") = {1:3};
END
check "a mesh of large blocks" "$MESHGEN" -2 big.geo -v 1 -no_report -clscale 0.7 -o big.msh
check "the same in binary" "$MESHGEN" big.msh -v 1 -bin -o bigb.msh
for f in msh msh2 msh1 vtk vtu stl off obj ply mesh inp su2; do
  for b in "" -bin; do
    "$MESHGEN" big.msh -v 1 -format $f $b -nt 1 -o one.$f && "$MESHGEN" bigb.msh -v 1 -format $f $b -nt 3 -o three.$f
    same "converted by one and three threads: $f $b" one.$f three.$f
  done
done
# The same mesh in lines that the fast way does not take.
awk '/^\$/ { s = $1 } { print } s == "$Elements" && NF == 4 && rand() < 0.001 { print "" }' big.msh >gaps.msh
awk '/^\$/ { s = $1; print; next } s == "$Nodes" && NF == 1 { printf "%s ", $1; next } s == "$Elements" && NF == 4 { print $1 "\n" $2, $3, $4; next } { print }' big.msh >odd.msh
sed 's/$/\r/' big.msh >dos.msh
for f in gaps odd dos; do
  for n in 1 3; do
    check "read: $f, $n threads" "$MESHGEN" $f.msh -v 1 -nt $n -o back.msh
    same "other lines, same mesh: $f, $n threads" big.msh back.msh
  done
done
# What is wrong far inside a large block is found there, whatever the threads.
awk '/^\$/ { s = $1 } { if (s == "$Elements" && NF == 4 && ++n == 30000) $3 = 99999999; print }' big.msh >wrong.msh
for n in 1 3; do
  exits 1 "a wrong node, $n threads" "$MESHGEN" wrong.msh -v 1 -nt $n -o back.msh
  says "node 99999999 is not defined" "it is named, $n threads"
  cp err.txt err$n.txt
done
same "the same place" err1.txt err3.txt
