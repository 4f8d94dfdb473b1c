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
# A triangle that is flat but for rounding is no reason to ask a field for its size nowhere.
cat >flat.geo <<'END'
x[] = {-0.6595870596896902, -0.8227834902700621, -0.6517769732063603, -0.0965946923340338, 0.4119097576163131, 0.7710081753252979, 0.8266779415998715, 0.3500941415963413, -0.1758473997576494};
y[] = {0.4992925940243685, -0.04132188073703184, -0.6051408269455607, -0.7727698921182479, -0.6373227758347635, -0.2375599702791173, 0.3487790815584377, 0.6834112948304392, 0.7693265130835601};
For i In {0:8}
  Point(i + 1) = {x[i], y[i], 0};
EndFor
MeshSize{1:9} = 0.5; MeshSize{2} = 0.191164; MeshSize{5} = 0.775957; BSpline(1) = {1:9, 1}; Curve Loop(1) = {1};
Point(10) = {0, 0, 0, 0.846618}; Point(11) = {0.10793975363630684, -0.08411047714136667, 0, 0.5}; Point(12) = {0.10279128163306527, -0.031151792812477704, 0, 0.281175};
Point(13) = {0.14581036256054472, 0.02107021356065694, 0, 0.5}; Point(14) = {0.13446022057345938, 0.1408209292218427, 0, 0.5};
Point(15) = {-0.17636240907221298, 0.08133944729604639, 0, 0.5}; Point(16) = {-0.12068118676708627, -0.06724511554411358, 0, 0.648678};
Line(2) = {10, 11}; Line(3) = {11, 12}; Line(4) = {12, 13}; Line(5) = {13, 14}; Line(6) = {14, 10}; Line(7) = {10, 15}; Line(8) = {15, 16}; Line(9) = {16, 10};
Curve Loop(2) = {2:6}; Curve Loop(3) = {7:9}; Plane Surface(1) = {1, 2, 3};
Mesh.Algorithm = 1; Mesh.Smoothing = 0; Mesh.MeshSizeFactor = 2;
Field[1] = MathEval; Field[1].F = "0.5 * (1 + 0.8 * sin(5 * x) * cos(4 * y))"; Background Field = 1;
END
exits 0 "a field beside flat triangles" "$MESHGEN" -2 flat.geo -o flat.msh
echo "1..$count"
