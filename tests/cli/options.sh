# options.sh - each option and switch does what its help says: the file changes where it must, and does not where it must not
. "$(dirname "$0")/lib.sh"

cat >model.geo <<'END'
h = DefineNumber[0.15, Name "Sizes/h"];
DefineConstant[label = "none", n = 3];
Point(1)={0,0,0,h}; Point(2)={2,0,0,h}; Point(3)={2,1,0,h/3}; Point(4)={0,1,0,h}; Point(5)={1,1.2,0,h/8};
Point(6)={0.6,0.5,0,h}; Point(7)={0.8,0.5,0,h}; Point(8)={0.4,0.5,0,h}; Point(9)={1.97,1,0,h};
Line(1)={1,2}; Line(2)={2,3}; Line(7)={3,9}; Spline(3)={9,5,4}; Line(4)={4,1}; Circle(5)={7,6,8}; Circle(6)={8,6,7};
Curve Loop(1)={1,2,7,3,4}; Curve Loop(2)={5,6}; Plane Surface(1)={1,2};
END
cp model.geo grouped.geo
echo 'Physical Surface("face")={1}; Physical Curve("rim")={-1,2,3,4,7};' >>grouped.geo
cat >blocks.geo <<'END'
Point(1)={0,0,0,.3}; Point(2)={1,0,0,.3}; Point(3)={0,1,0,.3}; Line(1)={1,2}; Line(2)={2,3}; Line(3)={3,1};
Curve Loop(1)={1,2,3}; Plane Surface(1)={1}; Transfinite Curve{1:3}=5; Transfinite Surface{1}={1,2,3};
END
cat >clockwise.geo <<'END'
Point(1)={0,0,0,.5}; Point(2)={1,0,0,.5}; Point(3)={0,1,0,.5}; Line(1)={1,3}; Line(2)={3,2}; Line(3)={2,1};
Curve Loop(1)={1,2,3}; Plane Surface(1)={1};
END
cat >copies.geo <<'END'
Point(1)={0,0,0,.4}; Point(2)={1,0,0,.4}; Point(3)={1,1,0,.4}; Point(4)={0,1,0,.4}; Line(1)={1,2}; Line(2)={2,3}; Line(3)={3,4};
Line(4)={4,1}; Curve Loop(1)={1:4}; Plane Surface(1)={1}; Transfinite Curve{1:4}=4; Transfinite Surface{1};
c[] = Translate{2,0,0}{Duplicata{Surface{1};}};
e[] = Extrude{{0,0,1},{-1,0,0},Pi/6}{Line{4};};
Printf("returned %g, next curve %g", #e[], newl);
END
cat >fan.geo <<'END'
Point(1)={0,0,0,.2}; Point(2)={1,0,0,.2}; Point(3)={1,1,0,.2}; Point(4)={-1,1,0,.2}; Point(5)={-1,-1,0,.2}; Point(6)={0,-1,0,.2};
Line(1)={1,2}; Line(2)={2,3}; Line(3)={3,4}; Line(4)={4,5}; Line(5)={5,6}; Line(6)={6,1}; Curve Loop(1)={1:6}; Plane Surface(1)={1};
Field[1]=BoundaryLayer; Field[1].CurvesList={1,6}; Field[1].PointsList={2,6}; Field[1].FanPointsList={1}; Field[1].Size=.02;
Field[1].Ratio=1.3; Field[1].Thickness=.1; BoundaryLayer Field=1;
END
cat >obtuse.geo <<'END'
Point(1)={0,0,0,9}; Point(2)={4,0,0,9}; Point(3)={2,0.3,0,9}; Line(1)={1,2}; Line(2)={2,3}; Line(3)={3,1}; Curve Loop(1)={1:3}; Plane Surface(1)={1};
END
printf 'Point(1)={0,0,0,1}; Point(2)={1,0,0,1}; Point(3)={1.03,0,0,1}; Line(1)={1,2}; Line(2)={2,3};\n' >short.geo
printf 'Point(1)={0,0,0,1}; Point(2)={1,0,0,1}; Point(3)={1.03,0,0,1}; Point(4)={1,1,0,1}; Line(1)={1,2}; Line(2)={3,4}; Coherence;\n' >near.geo
printf 'Point(1)={0,0,0,1}; Point(2)={1,0,0,1}; Line(1)={1,2}; Translate{1,0,0}{Duplicata{Curve{1};}}\n' >touching.geo
printf '$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 5 5 0\n$EndNodes\n$Elements\n1\n1 2 2 0 1 1 2 3\n$EndElements\n' >orphan.msh

# write FILE MODEL ARGUMENTS...
write() {
  local to=$1 model=$2
  shift 2
  "$MESHGEN" -2 "$model" -v 1 -no_report "$@" -o "$to" >said.txt 2>&1
}
# changes NAME=VALUE EXTENSION MODEL ARGUMENTS...: the file is another one;  keeps: it is the same
compare() {
  local how=$1 set=$2 ext=$3 model=$4 same
  shift 4
  write "a.$ext" "$model" "$@" && write "b.$ext" "$model" "$@" -setnumber "${set%=*}" "${set#*=}" || { not_ok "$set" "$(cat said.txt)"; return; }
  if cmp -s "a.$ext" "b.$ext"; then same=keeps; else same=changes; fi
  if [ $same = "$how" ]; then ok "$set $how $model to $ext"; else not_ok "$set $how $model to $ext" "it $same it"; fi
}
changes() { compare changes "$@"; }
keeps() { compare keeps "$@"; }
sw() { # sw 'SWITCH VALUE' OPTION VALUE ARGUMENTS...: the switch is the option
  local switch=$1 option=$2 value=$3
  shift 3
  # shellcheck disable=SC2086
  write a.msh model.geo $switch "$@" && write b.msh model.geo -setnumber "$option" "$value" "$@"
  same "$switch is $option" a.msh b.msh
}

changes Mesh.MeshSizeFactor=0.5 msh model.geo
changes Mesh.MeshSizeMin=0.1 msh model.geo
changes Mesh.MeshSizeMax=0.1 msh model.geo
changes Mesh.MeshSizeFromPoints=0 msh model.geo -clmax 0.2
changes Mesh.MeshSizeFromParametricPoints=1 msh model.geo
changes Mesh.MeshSizeFromCurvature=40 msh model.geo
changes Mesh.MeshSizeExtendFromBoundary=0 msh model.geo -clmax 0.3
changes Mesh.SizeGradation=1.05 msh model.geo
changes Mesh.RecombineAll=1 msh model.geo
changes Mesh.RecombinationAlgorithm=2 msh model.geo -setnumber Mesh.RecombineAll 1
changes Mesh.RecombineOptimizeTopology=0 msh model.geo -setnumber Mesh.RecombineAll 1
changes Mesh.RecombineNodeRepositioning=0 msh model.geo -setnumber Mesh.RecombineAll 1
changes Mesh.RecombineMinimumQuality=0.9 msh model.geo -setnumber Mesh.RecombineAll 1 -setnumber Mesh.RecombinationAlgorithm 0
changes Mesh.SubdivisionAlgorithm=1 msh model.geo
changes Mesh.SubdivisionAlgorithm=3 msh model.geo
changes Mesh.Smoothing=0 msh model.geo -setnumber Mesh.OptimizeLevel 0
changes Mesh.OptimizeLevel=0 msh model.geo
changes Mesh.MinimumAngle=33 msh model.geo -algo initial2d
changes Mesh.ConformingDelaunay=1 msh obtuse.geo -algo initial2d
changes Mesh.SecondOrderIncomplete=1 msh model.geo -order 2 -setnumber Mesh.RecombineAll 1
changes Mesh.SecondOrderLinear=1 msh model.geo -order 2
changes Mesh.LcIntegrationPrecision=0.3 msh model.geo
changes Mesh.MinimumLineNodes=40 msh model.geo
changes Mesh.MinimumCircleNodes=60 msh model.geo
changes Mesh.MinimumCurveNodes=60 msh model.geo
changes Mesh.FlexibleTransfinite=1 msh blocks.geo -clscale 0.5
changes Mesh.TransfiniteTri=1 msh blocks.geo
changes Mesh.SmoothRatio=1.05 msh model.geo
changes Mesh.ToleranceEdgeLength=0.05 msh short.geo
changes Mesh.BoundaryLayerFanElements=12 msh fan.geo
changes Mesh.Binary=1 msh model.geo
changes Mesh.SaveAll=1 msh grouped.geo
changes Mesh.SaveParametric=1 msh model.geo
changes Mesh.SaveWithoutOrphans=1 msh orphan.msh
changes Mesh.SaveElementTagType=2 mesh grouped.geo
changes Mesh.SaveGroupsOfNodes=1 inp grouped.geo
changes Mesh.SaveGroupsOfNodes=-10 unv grouped.geo
changes Mesh.SaveGroupsOfElements=0 inp grouped.geo
changes Mesh.SaveGroupsOfElements=-100 inp grouped.geo
changes Mesh.ScalingFactor=2 msh model.geo
changes Mesh.FirstNodeTag=10 msh model.geo
changes Mesh.FirstElementTag=10 msh model.geo
changes Mesh.MshFileVersion=2.2 msh model.geo
changes Mesh.StlOneSolidPerSurface=1 stl grouped.geo
changes Mesh.KeepOrientation=1 msh clockwise.geo
changes Geometry.CopyMeshingMethod=1 msh copies.geo
changes Geometry.OrientedPhysicals=0 msh2 grouped.geo
changes Geometry.ScalingFactor=2 msh model.geo
changes Geometry.Tolerance=0.05 msh near.geo
changes Geometry.AutoCoherence=0 msh touching.geo
for o in Mesh.QuasiTransfinite=1 Mesh.AnisoMax=5 Mesh.RefineSteps=3 Mesh.RandomFactor=0.1 Mesh.RandomSeed=7 Mesh.MeshOnlyVisible=1 \
  Mesh.MeshOnlyEmpty=1 Mesh.SaveTopology=1 Mesh.Renumber=0 Mesh.PreserveNumberingMsh2=1 Mesh.MaxRetries=3 Mesh.MaxElements=1e6 \
  Mesh.UnvStrictFormat=0 Mesh.BdfFieldFormat=0 Mesh.NbPartitions=1 Mesh.PartitionCreateTopology=0 Mesh.PartitionCreateGhostCells=1 \
  Mesh.PartitionCreatePhysicals=0 Mesh.PartitionSplitMeshFiles=1 Mesh.PartitionOldStyleMsh2=0 Mesh.MetisAlgorithm=2 Geometry.OldCircle=1 Geometry.OldRuledSurface=1 \
  Geometry.ExactExtrusion=0 Geometry.FirstEntityTag=5 Geometry.FirstPhysicalTag=5 General.ExpertMode=1 General.Terminal=0 \
  General.AbortOnError=2 General.NoPopup=0 General.NumThreads=3 General.Verbosity=2; do
  keeps $o msh grouped.geo
done
"$MESHGEN" -2 copies.geo -no_report -v 3 -o x.msh >one.txt && "$MESHGEN" -2 copies.geo -no_report -v 3 -o x.msh -setnumber Geometry.ExtrudeReturnLateralEntities 0 >two.txt
if cmp -s one.txt two.txt; then not_ok "Geometry.ExtrudeReturnLateralEntities"; else ok "Geometry.ExtrudeReturnLateralEntities"; fi
"$MESHGEN" -2 copies.geo -no_report -v 3 -o x.msh -setnumber Geometry.OldNewReg 0 >two.txt
if cmp -s one.txt two.txt; then not_ok "Geometry.OldNewReg"; else ok "Geometry.OldNewReg"; fi
printf 'Point(1)={1,0,0,1}; e[]=Extrude{{0,0,1},{0,0,1},{0,0,0},Pi/2}{Point{1};};\n' >helix.geo
for n in 5 9; do "$MESHGEN" -0 helix.geo -setnumber Geometry.ExtrudeSplinePoints $n -o $n.geo_unrolled; done
if cmp -s 5.geo_unrolled 9.geo_unrolled; then not_ok "Geometry.ExtrudeSplinePoints"; else ok "Geometry.ExtrudeSplinePoints"; fi
for f in 1:MeshFormat 2:2411 16:vtk 27:solid 30:MeshVersion 39:Heading 40:ply 42:NDIME 53:OFF 57:v; do
  "$MESHGEN" -2 model.geo -v 1 -no_report -setnumber Mesh.Format "${f%:*}" -o any.file && head -n 2 any.file >head.txt
  if grep -q "${f#*:}" head.txt; then ok "Mesh.Format ${f%:*}"; else not_ok "Mesh.Format ${f%:*}" "$(cat head.txt)"; fi
done

sw '-clscale 0.5' Mesh.MeshSizeFactor 0.5
sw '-clmin 0.1' Mesh.MeshSizeMin 0.1
sw '-clmax 0.1' Mesh.MeshSizeMax 0.1
sw '-clextend 0' Mesh.MeshSizeExtendFromBoundary 0
sw '-clcurv 40' Mesh.MeshSizeFromCurvature 40
sw '-gradation 1.05' Mesh.SizeGradation 1.05
sw '-smooth 3' Mesh.Smoothing 3
sw '-min_angle 30' Mesh.MinimumAngle 30
sw '-epslc1d 0.3' Mesh.LcIntegrationPrecision 0.3
sw '-smooth_ratio 1.05' Mesh.SmoothRatio 1.05
sw '-aniso_max 5' Mesh.AnisoMax 5
sw '-rand 0.1' Mesh.RandomFactor 0.1
sw '-edgelmin 0.05' Mesh.ToleranceEdgeLength 0.05
sw '-vmsh 1' Mesh.MshFileVersion 1
sw '-meshscale 2' Mesh.ScalingFactor 2
sw '-preserve_numbering_msh2' Mesh.PreserveNumberingMsh2 1
sw '-tol 0.02' Geometry.Tolerance 0.02
sw '-scale 2' Geometry.ScalingFactor 2
sw '-keep_orientation' Mesh.KeepOrientation 1
sw '-save_parametric' Mesh.SaveParametric 1
sw '-save_topology' Mesh.SaveTopology 1
sw '-quad' Mesh.RecombineAll 1 -setnumber Mesh.RecombinationAlgorithm 2
sw '-algo del2d' Mesh.Algorithm 5
sw '-part 1' Mesh.NbPartitions 1

# definitions
sees() { # sees TEXT ARGUMENTS...: the script prints TEXT
  local want=$1
  shift
  exits 0 "$*" "$MESHGEN" -parse_and_exit print.geo "$@"
  prints "$want" "$*: seen"
}
cat >print.geo <<'END'
DefineConstant[label = "none", n = 3, x = DefineNumber[1, Name "A/x"]];
If (!Exists(list)) list[] = {}; EndIf
Printf("n %g x %g list %g", n, x, #list[]);
Printf(StrCat("label ", label));
END
sees "n 7" -setnumber n 7
sees "x 4" -setnumber A/x 4
sees "label some text" -setstring label "some text"
sees "list 2" -setlist list 2 5 6
sees "n 3" -string "n = 9;"
echo 'Mesh.ElementOrder = 2;' >more.geo
exits 0 "-option FILE" "$MESHGEN" -2 model.geo -option more.geo -o second.msh
prints "triangles" "-option FILE: meshed"
"$MESHGEN" second.msh --json | grep -q '"order": 2' && ok "-option FILE is run" || not_ok "-option FILE is run"
exits 0 "-explain_size" "$MESHGEN" model.geo -explain_size 1,0.5
prints "size" "-explain_size says"
exits 2 "-explain_size without numbers" "$MESHGEN" model.geo -explain_size here
printf 'View "s" { ST(-1,-1,0, 9,-1,0, -1,9,0){0.05,0.05,0.05}; };\n' >bg.pos
write a.msh model.geo && write b.msh model.geo -bgm bg.pos && ! cmp -s a.msh b.msh && ok "-bgm changes the mesh" || not_ok "-bgm changes the mesh" "$(cat said.txt)"
write a.msh model.geo
for how in -refine -barycentric_refine; do
  exits 0 "$how" "$MESHGEN" a.msh $how -o finer.msh
  few=$("$MESHGEN" a.msh --json | sed -n 's/ *"triangles": \([0-9]*\),/\1/p') many=$("$MESHGEN" finer.msh --json | sed -n 's/ *"triangles": \([0-9]*\),/\1/p')
  case $how in -refine) want=$((4 * few)) ;; *) want=$((3 * few)) ;; esac
  [ "$many" = $want ] && ok "$how: $many triangles" || not_ok "$how: triangles" "$few $many"
done
exits 0 "-info" "$MESHGEN" -info
exits 0 "-help_options" "$MESHGEN" -help_options -clscale 0.25
prints "Mesh.MeshSizeFactor = 0.25;" "-help_options shows values"

# a face that fails
cat >two.geo <<'END'
Point(1)={0,0,0,1}; Point(2)={1,0,0,1}; Point(3)={0,1,0,1}; Point(4)={5,0,0,.01}; Point(5)={6,0,0,.01}; Point(6)={5,1,0,.01};
Line(1)={1,2}; Line(2)={2,3}; Line(3)={3,1}; Line(4)={4,5}; Line(5)={5,6}; Line(6)={6,4};
Curve Loop(1)={1:3}; Curve Loop(2)={4:6}; Plane Surface(1)={1}; Plane Surface(2)={2};
END
exits 1 "a face fails" "$MESHGEN" -2 two.geo -max_elements 2000 -o two.msh
absent "a face fails: no file" two.msh
exits 4 "a face fails, -keep_going" "$MESHGEN" -2 two.geo -max_elements 2000 -keep_going -o two.msh
check "a face fails, -keep_going: the other is there" test -s two.msh

# what scripts read
cat >stat.geo <<'END'
Merge "model.geo";
Mesh 2;
Printf("nodes %g tri %g quad %g", Mesh.NbNodes, Mesh.NbTriangles, Mesh.NbQuadrangles);
Printf("none %g", Mesh.NbTetrahedra + Mesh.NbHexahedra + Mesh.NbPrisms + Mesh.NbPyramids + Mesh.NbTrihedra);
If (Mesh.MinQuality > 0 && Mesh.MinQuality <= Mesh.AvgQuality && Mesh.AvgQuality <= Mesh.MaxQuality && Mesh.MaxQuality <= 1 && Mesh.CpuTime > 0)
  Printf("quality holds");
EndIf
Printf("box %g %g %g %g %g %g", General.MinX, General.MaxX, General.MinY, General.MaxY, General.MinZ, General.MaxZ);
Printf(StrCat("version ", General.Version, General.ExecutableFileName, General.TmpFileName, General.OptionsFileName));
Printf(StrCat(General.ErrorFileName, General.DefaultFileName, General.FileName, Geometry.OCCTargetUnit));
END
exits 0 "statistics in scripts" "$MESHGEN" -save stat.geo -no_report -o stat.msh
prints "none 0" "no volumes"
prints "quality holds" "qualities are in order"
prints "box 0 2 0 1.2 0 0" "bounding box"
