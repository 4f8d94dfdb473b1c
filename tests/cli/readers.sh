# readers.sh - meshio, gmsh and VTK read every file we write, without a word, with our counts, names and area
. "$(dirname "$0")/lib.sh"

cat >two.geo <<'END'
h = 0.25;
Point(1)={0,0,0,h}; Point(2)={2,0,0,h}; Point(3)={2,1,0,h}; Point(4)={0,1,0,h}; Point(5)={1,0,0,h}; Point(6)={1,1,0,h};
Line(1)={1,5}; Line(2)={5,2}; Line(3)={2,3}; Line(4)={3,6}; Line(5)={6,4}; Line(6)={4,1}; Line(7)={5,6};
Curve Loop(1)={1,7,5,6}; Curve Loop(2)={2,3,4,-7};
Plane Surface(1)={1}; Plane Surface(2)={2};
Recombine Surface{2}; Transfinite Surface{2};
Physical Surface("left",1)={1}; Physical Surface("right side",2)={2};
Physical Curve("wall",3)={1,2,3,4,5,7}; Physical Curve("in let",4)={6};
END

# read_all READER FILE...: one run of the reader over several files, into rows.txt
read_all() { "$PYTHON" "$here/readers.py" "$@" >>rows.txt 2>&1; }

# expect READER ROW FILE: the reader's line about FILE is ROW
expect() {
  local got
  got=$(grep "^$1 $3 " rows.txt)
  if [ "$got" = "$1 $3 $2" ]; then ok "$1 reads $3"; else not_ok "$1 reads $3" "got:  $got" "want: $1 $3 $2"; fi
}

# counts FILE.geo: "nodes lines triangles quadrangles" as the report has them
counts() { sed -n 's/.*: \([0-9]*\) nodes, \([0-9]*\) lines, \([0-9]*\) triangles, \([0-9]*\) quadrangles.*/\1 \2 \3 \4/p' report.txt; }

names="in let,left,right side,wall"
for order in 1 2; do
  formats="msh msh2 vtk vtu"
  [ $order = 1 ] && formats="$formats msh1 mesh inp su2 unv off obj ply stl"
  for bin in "" -bin; do
    out=
    for f in $formats; do out="$out -o t.$f"; done
    # shellcheck disable=SC2086
    exits 0 "order $order $bin: every format is written" "$MESHGEN" -2 two.geo -order $order $bin -v 3 $out
    cat out.txt err.txt >report.txt
    read -r n l t q <<<"$(counts)"
    row="$n $l $t $q 2"
    rm -f rows.txt
    if [ $order = 1 ]; then
      read_all gmsh t.msh t.msh2 t.vtk t.msh1 t.mesh t.unv t.stl
      read_all meshio t.msh t.msh2 t.vtk t.vtu t.mesh t.ply
      read_all vtk t.vtk t.vtu t.ply t.obj t.stl
    else
      read_all gmsh t.msh t.msh2 t.vtk
      read_all meshio t.msh t.msh2 t.vtk t.vtu
      read_all vtk t.vtk t.vtu
    fi
    for f in msh msh2; do
      expect gmsh "$row $names" t.$f
      expect meshio "$row $names" t.$f
    done
    for r in gmsh meshio vtk; do expect $r "$row -" t.vtk; done
    for r in meshio vtk; do expect $r "$row $names" t.vtu; done
    [ $order = 1 ] || continue
    stl="$n 0 $((t + 2 * q)) 0 2 -"
    expect gmsh "$row -" t.msh1
    expect gmsh "$row -" t.mesh
    expect meshio "$row -" t.mesh
    expect gmsh "$row in_let,left,right_side,wall" t.unv
    for r in vtk meshio; do expect $r "$n 0 $t $q 2 -" t.ply; done
    expect vtk "$n 0 $t $q 2 -" t.obj
    expect gmsh "$stl" t.stl
    expect vtk "$stl" t.stl
  done
done

# The running example, whose curves are arcs: the three formats of the demo.
exits 0 "conge is written" "$MESHGEN" -2 "$ROOT/geo/conge.geo" -v 3 -o c.msh -o c.vtk -o c.vtu -o c.msh2
cat out.txt err.txt >report.txt
read -r n l t q <<<"$(counts)"
rm -f rows.txt
read_all gmsh c.msh2 c.msh c.vtk
read_all meshio c.msh c.vtk
read_all vtk c.vtk c.vtu
area=$(awk '$1 == "gmsh" && $2 == "c.msh2" { print $7 }' rows.txt)
names=arch,body,cover,foot,free,interface
# nodes of no saved element (centres of arcs) are in no file that is saved by groups
used=$(awk '$1 == "gmsh" && $2 == "c.msh2" { print $3 }' rows.txt)
for r in gmsh meshio; do expect $r "$used $l $t $q $area $names" c.msh; done
for r in gmsh meshio vtk; do expect $r "$used $l $t $q $area -" c.vtk; done
expect vtk "$used $l $t $q $area $names" c.vtu

# Conversions keep the hash, through every format that holds everything.
hash=$("$MESHGEN" hash c.msh | cut -d' ' -f1)
from=c.msh
for f in msh2 vtu msh4 msh; do
  check "convert $from to $f" "$MESHGEN" "$from" -v 2 -no_report -o "next.$f"
  mv "next.$f" "step-$f.${f}"
  from="step-$f.$f"
  if [ "$("$MESHGEN" hash "$from" | cut -d' ' -f1)" = "$hash" ]; then ok "same hash as $f"; else not_ok "same hash as $f" "$("$MESHGEN" hash "$from") $hash"; fi
done
check "the audit finds nothing in the file" "$MESHGEN" check c.msh step-msh2.msh2

# A full disk leaves no file and says so.
exits 3 "a full disk is an error" "$MESHGEN" -2 two.geo -o /dev/full -format msh
says "/dev/full: No space left" "and it says which file"
head -c 3000 c.msh >cut.msh
exits 1 "a file that is cut is refused" "$MESHGEN" check cut.msh
says "cut.msh:" "and it says where"
exit 0
