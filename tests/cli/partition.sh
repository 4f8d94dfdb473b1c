# partition.sh - meshes in parts as a user of Gmsh has them: files that gmsh reads and that it wrote, parts apart and together, pictures
. "$(dirname "$0")/lib.sh"

cat >two.geo <<'END'
h = 0.07;
Point(1)={0,0,0,h}; Point(2)={2,0,0,h}; Point(3)={2,1,0,h}; Point(4)={0,1,0,h}; Point(5)={1,0,0,h}; Point(6)={1,1,0,h};
Line(1)={1,5}; Line(2)={5,2}; Line(3)={2,3}; Line(4)={3,6}; Line(5)={6,4}; Line(6)={4,1}; Line(7)={5,6};
Curve Loop(1)={1,7,5,6}; Curve Loop(2)={2,3,4,-7}; Plane Surface(1)={1}; Plane Surface(2)={2}; Recombine Surface{2};
Physical Surface("left",1)={1}; Physical Surface("right",2)={2}; Physical Curve("wall",3)={-1,2,7}; Physical Point("corner",4)={1};
END
hash_of() { "$MESHGEN" hash "$1" | cut -c1-32; }
same_hash() { if [ "$(hash_of "$2")" = "$(hash_of "$3")" ]; then ok "$1"; else not_ok "$1" "$(hash_of "$2") $(hash_of "$3")"; fi; }
# quiet NAME FILE...: gmsh reads the files without a warning
quiet() {
  local name=$1 said
  shift
  said=$(gmsh "$@" -save -save_all -v 2 -o quiet.msh 2>&1)
  if [ -z "$said" ]; then ok "$name"; else not_ok "$name" "$said"; fi
}

# ---- formats: the same mesh whatever its parts
for order in 1 2; do
  "$MESHGEN" -2 two.geo -order $order -v 2 -no_report -o whole.msh
  for bin in "" -bin; do
    for how in "-part_ghosts" "-part_no_ghosts -part_no_topo" "-part_topo -setnumber Mesh.PartitionOldStyleMsh2 0"; do
      # shellcheck disable=SC2086
      exits 0 "order $order $bin $how: written" "$MESHGEN" -2 two.geo -order $order -part 5 $bin $how -v 2 -no_report -o p.msh -o p.msh2
      same_hash "order $order $bin $how: MSH 4 holds the same mesh" whole.msh p.msh
      quiet "order $order $bin $how: gmsh reads MSH 4" p.msh
      quiet "order $order $bin $how: gmsh reads MSH 2" p.msh2
      case $how in *OldStyle*) continue ;; esac
      same_hash "order $order $bin $how: MSH 2 holds the same mesh" whole.msh p.msh2
      exits 0 "order $order $bin $how: the parts are read" "$MESHGEN" p.msh -json -require "parts==5" -require "part_pieces==5"
    done
  done
done
quiet "gmsh finds five parts" p.msh
gmsh p.msh -save -o quiet.msh | grep -q "5 partitions" && ok "gmsh says five parts" || not_ok "gmsh says five parts"
"$MESHGEN" -2 two.geo -part 5 -setnumber Mesh.PartitionOldStyleMsh2 0 -v 2 -no_report -o n.msh
grep -q '"_part{[1-5]}_physical{-3}_dim{1}"' n.msh && ok "groups of parts are named as gmsh names them" || not_ok "groups of parts"
"$MESHGEN" p.msh -setnumber Mesh.PartitionOldStyleMsh2 0 -part_no_physicals -o n.msh -v 2
grep -q '_physical{' n.msh && not_ok "-part_no_physicals" || ok "-part_no_physicals"
"$MESHGEN" p.msh -setnumber Mesh.PartitionOldStyleMsh2 0 -part_physicals -o n.msh -v 2
grep -q '_physical{' n.msh && ok "-part_physicals" || not_ok "-part_physicals"

# ---- beside gmsh: its partition, written by us, is what it writes
"$MESHGEN" -2 two.geo -v 2 -no_report -save_all -o w.msh
for n in 3 20; do
  gmsh w.msh -save_all -part $n -part_ghosts -save -v 1 -o g.msh
  gmsh w.msh -save_all -save -v 1 -o w0.msh
  exits 0 "$n parts of gmsh are read" "$MESHGEN" g.msh -save_all -part_ghosts -v 2 -o m.msh
  same_hash "$n parts of gmsh: the same mesh" w0.msh g.msh
  check "$n parts of gmsh: elements, seams and ghosts are the same" "$PYTHON" "$here/partition.py" g.msh m.msh
  for b in "" -bin; do
    gmsh w.msh -save_all -part $n -part_ghosts -save -v 1 $b -format msh2 -o g2.msh 2>g2.txt
    "$MESHGEN" g2.msh -save_all -part_ghosts -v 2 -o m2.msh
    check "$n parts of gmsh by MSH 2 $b" "$PYTHON" "$here/partition.py" g.msh m2.msh
  done
done
"$MESHGEN" w.msh -save_all -part 7 -part_ghosts -v 2 -o m.msh
gmsh m.msh -save_all -part_ghosts -save -v 1 -format msh41 -o g.msh
check "our parts, written by gmsh" "$PYTHON" "$here/partition.py" m.msh g.msh

# ---- one file for each part
for order in 1 2; do
  for ext in msh msh2; do
    for how in "" "-part_ghosts -bin"; do
      rm -f s_*
      # shellcheck disable=SC2086
      "$MESHGEN" -2 two.geo -order $order -part 4 -part_split $how -v 2 -no_report -o s.$ext
      "$MESHGEN" -2 two.geo -order $order -v 2 -no_report -o whole.msh
      exits 0 "order $order $ext $how: four files are put together" "$MESHGEN" -merge s_1.$ext s_2.$ext s_3.$ext s_4.$ext -v 2 -o j.msh
      same_hash "order $order $ext $how: they are the mesh" whole.msh j.msh
      exits 0 "order $order $ext $how: each is a good mesh" "$MESHGEN" check s_1.$ext s_2.$ext s_3.$ext s_4.$ext
      # Without its conversion of parts, which ends in errors or crashes on its own MSH 2 files of one part too.
      for k in 1 2 3 4; do
        quiet "order $order $ext $how: gmsh reads part $k" s_$k.$ext -setnumber Mesh.PartitionConvertMsh2 0 -format vtk
      done
    done
  done
done
absent "and no fifth" s_5.msh2
gmsh w.msh -save_all -part 3 -part_split -part_ghosts -save -v 1 -o g.msh
"$MESHGEN" -merge g_1.msh g_2.msh g_3.msh -save_all -v 2 -o j.msh
same_hash "gmsh's files of parts are put together" w0.msh j.msh
"$MESHGEN" w.msh -part 2 -part_split -o v.vtu -v 2
[ -e v_1.vtu ] && [ -e v_2.vtu ] && ok "other formats have a file for each part too" || not_ok "v_1.vtu"
exits 2 "scripts cannot be put together" "$MESHGEN" -merge two.geo s_1.msh2 -o x.msh
says "-merge puts mesh files together, and 'two.geo' is none" "scripts cannot be put together: said"
exits 1 "meshes of different places are not one" "$MESHGEN" -merge s_1.msh2 g_1.msh -o x.msh
says "is not at the same place in all files: they are not of one mesh" "meshes of different places are not one: said"

# ---- the same bytes, whatever the threads
"$MESHGEN" -2 two.geo -part 12 -part_ghosts -v 2 -no_report -nt 1 -o one.msh
for nt in 1 2 4; do
  "$MESHGEN" -2 two.geo -part 12 -part_ghosts -v 2 -no_report -nt $nt -o again.msh
  same "-nt $nt" one.msh again.msh
done
mkdir batch
for k in 1 2 3 4; do cp two.geo m$k.geo; done
"$MESHGEN" -2 m1.geo m2.geo m3.geo m4.geo -nt 4 -part 12 -part_ghosts -v 1 -o batch >batch.txt
for k in 1 2 3 4; do same "batch: input $k" one.msh batch/m$k.msh; done

# ---- options
for o in Mesh.MetisAlgorithm=1 Mesh.MetisAlgorithm=2 Mesh.MetisEdgeMatching=1 Mesh.MetisObjective=2 Mesh.PartitionTriWeight=3 \
  Mesh.PartitionQuadWeight=5 Mesh.PartitionLineWeight=2 Mesh.MetisMinConn=1 Mesh.MetisMaxLoadImbalance=200 \
  Mesh.MetisRefinementAlgorithm=1; do
  "$MESHGEN" w.msh -part 10 -setnumber ${o%=*} ${o#*=} -v 2 -o o.msh
  "$MESHGEN" w.msh -part 10 -v 2 -o o0.msh
  if cmp -s o.msh o0.msh; then how=same; else how=other; fi
  case $o in *LineWeight=* | *RefinementAlgorithm=* | *MetisAlgorithm=2) want=same ;; *MinConn=*) want="same other" ;; *) want=other ;; esac
  case " $want " in *" $how "*) ok "$o: $how" ;; *) not_ok "$o" "the parts are the $how" ;; esac
done
"$MESHGEN" w.msh -part 4 -part_weight quad 9 tri 1 line 1 -v 2 -o a.msh
"$MESHGEN" w.msh -part 4 -setnumber Mesh.PartitionQuadWeight 9 -setnumber Mesh.PartitionTriWeight 1 -v 2 -o b.msh
same "-part_weight is the options" a.msh b.msh
"$MESHGEN" w.msh -part 4 -setnumber Mesh.SaveElementTagType 3 -v 2 -o t.mesh
[ "$(awk '/Triangles/ {on = 1} on && NF > 3 {print $NF}' t.mesh | sort -u | tr '\n' ' ')" = "1 2 3 4 " ] && ok "Mesh.SaveElementTagType = 3" ||
  not_ok "Mesh.SaveElementTagType = 3" "$(tail -5 t.mesh)"

# ---- other formats, pictures, report
"$MESHGEN" -2 two.geo -part 6 -color_by partition -v 2 -no_report -o p.msh -o p.vtk -o p.vtu -o p.png -o p.svg
for f in vtk vtu; do
  same_hash "$f: the same mesh as without parts" <("$MESHGEN" -2 two.geo -v 2 -no_report -format $f -o -) p.$f
  exits 0 "$f: the parts are read back" "$MESHGEN" p.$f -json -require "parts==6" -require "part_pieces==6"
  "$PYTHON" -c "import meshio, numpy; m = meshio.read('p.$f'); p = numpy.concatenate(m.cell_data['partition']); print(sorted(int(k) for k in numpy.unique(p)))" >got.txt 2>&1
  grep -q "1, 2, 3, 4, 5, 6" got.txt && ok "$f: meshio finds the parts" || not_ok "$f: meshio finds the parts" "$(cat got.txt)"
done
grep -q ">Parts<" p.svg && ok "the picture names the parts" || not_ok "the picture names the parts"
exits 0 "report of parts" "$MESHGEN" -2 two.geo -part 6 -full_report -v 2 -o p.msh
prints "neighbours at most, each in one piece" "report of parts: a line"
prints "cut edges     ghosts neighbours     pieces" "report of parts: a table"
"$MESHGEN" -2 two.geo -part 6 -json -v 2 -o p.msh >r.json
check "report of parts: the schema" "$PYTHON" "$here/schema.py" "$ROOT/docs/report.schema.json" run r.json

# ---- scripts
cat >script.geo <<'END'
Include "two.geo";
Mesh 2;
PartitionMesh 3;
Save "three.msh";
RefineMesh;
Save "fine.msh";
PartitionMesh 0;
Save "none.msh";
END
exits 0 "PartitionMesh" "$MESHGEN" -save script.geo -v 2 -no_report -o x.msh
for f in three fine; do exits 0 "$f.msh is in parts" "$MESHGEN" $f.msh -json -require "parts==3"; done
grep -q Partitioned none.msh x.msh && not_ok "PartitionMesh 0" || ok "PartitionMesh 0"
tutorial=/usr/share/doc/gmsh-doc/doc/gmsh/tutorial/t21.geo
if [ -e $tutorial ]; then
  cp $tutorial .
  exits 0 "Gmsh's tutorial on partitions" "$MESHGEN" t21.geo -save -v 2 -no_report -o x.msh
  quiet "Gmsh's tutorial on partitions: gmsh reads it" t21.msh
else
  skip "Gmsh's tutorial on partitions" "no $tutorial (gmsh-doc was installed without its documents)"
fi

# ---- two bodies, curves alone, a mesh of one element
cat >apart.geo <<'END'
For k In {0:1}
  Rectangle(k + 1) = {3 * k, 0, 0, 1, 1};
EndFor
MeshSize {:} = 0.2;
END
sed -i '1i SetFactory("OpenCASCADE");' apart.geo
exits 0 "two bodies in four parts" "$MESHGEN" -2 apart.geo -part 4 -v 2 -o x.msh -require "part_pieces==4"
exits 0 "two bodies in three parts" "$MESHGEN" -2 apart.geo -part 3 -v 2 -o x.msh -require "part_imbalance<0.2"
exits 0 "curves alone" "$MESHGEN" -1 apart.geo -part 4 -v 2 -o x.msh -require "parts==4"
quiet "curves alone: gmsh reads them" x.msh
exits 1 "more parts than elements" "$MESHGEN" -2 two.geo -part 100000 -v 2 -o never.msh
says "elements to be divided: too few for 100000 parts" "more parts than elements: said"
absent "more parts than elements: no file" never.msh
