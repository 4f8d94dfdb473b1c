#!/bin/bash
# sizes.sh - fields as a user writes them: mistakes are told with their place, sizes are explained, growth is limited
. "$(dirname "$0")/lib.sh"
cat >square.geo <<'END'
Point(1) = {0, 0, 0, 0.1}; Point(2) = {1, 0, 0, 0.1}; Point(3) = {1, 1, 0, 0.1}; Point(4) = {0, 1, 0, 0.1};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1}; Curve Loop(1) = {1:4}; Plane Surface(1) = {1};
END
# field STATUS TEXT MESSAGE...: the square with that line ends with the status and says all of the messages
field() {
  local status=$1 text=$2
  shift 2
  { cat square.geo; echo "$text"; } >case.geo
  exits "$status" "$text" "$MESHGEN" -2 case.geo -o case.msh -v 2
  for m in "$@"; do says "$m" "  says: $m"; done
}
field 1 'Field[1] = Distanse;' "case.geo:3:1: error: unknown field type 'Distanse'; did you mean 'Distance'?"
field 1 'Field[1] = Distance; Field[1].CurveList = {1};' "case.geo:3:31: error: field 1 (Distance) has no option 'CurveList'; did you mean 'CurvesList'?"
field 1 'Field[1] = Min; Field[1].FieldsList = {2}; Field[2] = Max; Field[2].FieldsList = {1}; Background Field = 1;' \
  "error: field 1 refers to itself" "by way of field 2 (Max)"
field 0 'Field[1] = MathEval; Field[1].F = "0.1/x"; Background Field = 1;' \
  "case.geo:3:31: warning: field 1 (MathEval) F is infinite at (0, 0, 0) on curve 1, as by a division by zero"
field 1 'Field[1] = MathEval; Field[1].F = "Sqrt(x-0.5)+0.1"; Background Field = 1;' \
  "case.geo:3:31: error: field 1 (MathEval) F is not a number at (0, 0, 0) on curve 1" "met while meshing curve 1"
field 1 'Field[1] = MathEval; Field[1].F = "0.1-0.3*x*y"; Background Field = 1;' \
  "error: field 1 (MathEval) F gives the size -0.2 at (1, 1, 0) on curve 2; sizes must be positive"
field 1 'Field[1] = MathEval; Field[1].F = "0.02*(x"; Background Field = 1;' "expected ')' (at character 8)"
field 1 'Field[1] = Threshold; Field[1].InField = 7; Background Field = 1;' "case.geo:3:32: error: there is no field 7"
field 0 'Field[1] = MathEval; Field[1].F = "0.1*Exp(-x^2)"; Background Field = 1;' "Gmsh reads (-x)^2: write parentheses"
field 1 'Field[1] = Structured; Field[1].FileName = "none"; Background Field = 1;' "cannot read 'none': No such file"
field 1 'Field[1] = PostView; Field[1].ViewIndex = 3; Background Field = 1;' "there is no View[3]"
field 0 'Background Field = 9;' "there is no field 9: the background field is ignored"
field 0 'MeshSize{1} = -0.1;' "the mesh size -0.1 is negative: the points have none"
field 0 'Point(9) = {2, 2, 0, -1};' "the mesh size -1 is negative: the point has none"
field 1 'Mesh.MeshSizeMin = 0.1; Mesh.MeshSizeMax = 0.01;' "Mesh.MeshSizeMin (0.1) is larger than Mesh.MeshSizeMax (0.01)"
field 1 'Field[1] = MathEval; Field[1].F = "1e-5"; Background Field = 1;' "more than Mesh.MaxElements = 1e+08 (-max_elements)" "Field[1] (MathEval, line 3)"
field 1 'MeshSize{1, 2} = 1e-9;' "curve 1 alone" "more than Mesh.MaxElements = 1e+08" "the sizes of points 1 (1e-09) and 2 (1e-09)"
# through the tree of fields
{ cat square.geo; cat <<'END'; } >tree.geo
Field[1] = Distance; Field[1].CurvesList = {1};
Field[2] = Threshold; Field[2].InField = 1; Field[2].DistMin = 0.1; Field[2].DistMax = 0.5; Field[2].SizeMin = 0.02; Field[2].SizeMax = 0.2;
Field[3] = MathEval; Field[3].F = "0.05+0.1*x";
Field[4] = Min; Field[4].FieldsList = {2, 3};
Background Field = 4;
END
exits 0 "-explain_size" "$MESHGEN" -explain_size 0.3,0.2 tree.geo
prints "Field[4] (Min, line 6) = 0.065  <- decides" "  the background field"
prints "    Field[2] (Threshold, line 4) = 0.065  <- decides" "  the field of it that decides"
prints "      Field[1] (Distance, line 3) = 0.2" "  and what that looks at"
prints "    Field[3] (MathEval, line 5) = 0.08  [0.05+0.1*x]" "  the other one with its expression"
# growth: neighbouring edges on curves differ by a factor of exp(alpha - 1) at most, where sizes jump by 40
{ cat square.geo; cat <<'END'; } >jump.geo
Mesh.MeshSizeExtendFromBoundary = 0; Mesh.MeshSizeFromPoints = 0;
Field[1] = Ball; Field[1].VIn = 0.005; Field[1].VOut = 0.2; Field[1].Radius = 0.1; Field[1].XCenter = 0.5; Background Field = 1;
END
for alpha in 1.1 1.3 2; do
  "$MESHGEN" -2 jump.geo -gradation $alpha -format msh2 -o jump.msh2 -v 1 >/dev/null
  worst=$(awk -v alpha=$alpha '
    /^\$/ { part = $1; next }
    part == "$Nodes" && NF == 4 { x[$1] = $2; y[$1] = $3 }
    part == "$Elements" && $2 == 1 {
      d = sqrt((x[$6] - x[$7]) ^ 2 + (y[$6] - y[$7]) ^ 2)
      if ($5 == curve) { r = d > before ? d / before : before / d; if (r > most) most = r }
      curve = $5; before = d
    }
    END { print most / exp(alpha - 1) }' jump.msh2)
  check "-gradation $alpha limits neighbours on curves ($worst of the limit)" awk -v w="$worst" 'BEGIN { exit !(w > 0.5 && w <= 1.0001) }'
done
echo "1..$count"
