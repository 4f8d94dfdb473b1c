# errors.sh - bad input: a message with a place, the documented exit status, no output file
. "$(dirname "$0")/lib.sh"

cat >undefined_point.geo <<'END'
Point(1) = {0, 0, 0, 1};
Line(1) = {1, 99};
END
exits 1 "undefined point: exit status" "$MESHGEN" -2 undefined_point.geo -o x.msh
says "undefined_point.geo:2:" "undefined point: position"
says "99" "undefined point: names the point"
absent "undefined point: no output" x.msh

cat >open_loop.geo <<'END'
Point(1) = {0, 0, 0, 1};
Point(2) = {1, 0, 0, 1};
Point(3) = {1, 1, 0, 1};
Line(1) = {1, 2};
Line(2) = {2, 3};
Curve Loop(5) = {1, 2};
Plane Surface(6) = {5};
END
exits 1 "open loop: exit status" "$MESHGEN" -2 open_loop.geo -o x.msh
says "open_loop.geo:6:" "open loop: position"
says "error:" "open loop: is an error"
absent "open loop: no output" x.msh

exits 3 "missing file: exit status" "$MESHGEN" -2 no_such_file.geo -o x.msh
says "no_such_file.geo" "missing file: names it"
absent "missing file: no output" x.msh

exits 3 "unwritable output: exit status" "$MESHGEN" -2 "$ROOT/geo/conge.geo" -clscale 4 -o no/such/folder/x.msh
says "no/such/folder/x.msh" "unwritable output: names it"

exits 3 "full disk: exit status" "$MESHGEN" -2 "$ROOT/geo/conge.geo" -clscale 4 -format msh4 -o /dev/full
says "/dev/full" "full disk: names the file"

printf 'Point(1) = {0, 0, 0};\nPoint(2) = {0, 0 0};\nPoint(3) = {1, 1, 1};\n' >syntax.geo
exits 1 "syntax error: exit status" "$MESHGEN" -2 syntax.geo -o x.msh
says "syntax.geo:2:" "syntax error: position"
says "^" "syntax error: caret"
absent "syntax error: no output" x.msh

cat >crossing.geo <<'END'
Point(1) = {0, 0, 0, 1};
Point(2) = {1, 1, 0, 1};
Point(3) = {1, 0, 0, 1};
Point(4) = {0, 1, 0, 1};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
END
exits 1 "crossing curves: exit status" "$MESHGEN" -2 crossing.geo -o x.msh
says "0.5, 0.5" "crossing curves: names the point"
says "crossing.geo:5:" "crossing curves: names the line"
absent "crossing curves: no output" x.msh

exits 2 "unknown switch" "$MESHGEN" -clscal 2 a.geo
says "-clscale" "unknown switch: did you mean"
exits 2 "missing argument" "$MESHGEN" -clscale
exits 2 "no input" "$MESHGEN" -2
exits 1 "option out of range" "$MESHGEN" -2 "$ROOT/geo/conge.geo" -clscale 0 -o x.msh
exits 2 "unknown format" "$MESHGEN" -2 "$ROOT/geo/conge.geo" -format nonsense -o x.msh
exits 2 "unknown extension" "$MESHGEN" -2 "$ROOT/geo/conge.geo" -o x.nonsense
exits 0 "version" "$MESHGEN" -version
exits 0 "help" "$MESHGEN" --help
prints "-clscale" "help lists switches"

cat >bad_field.geo <<'END'
Point(1)={0,0,0,.1}; Point(2)={1,0,0,.1}; Point(3)={1,1,0,.1}; Line(1)={1,2}; Line(2)={2,3}; Line(3)={3,1};
Curve Loop(1)={1:3}; Plane Surface(1)={1};
Field[1]=MathEval; Field[1].F="sqrt(x-2)"; Background Field=1;
END
exits 1 "a field that is no number: exit status" "$MESHGEN" -2 bad_field.geo -o x.msh
says "bad_field.geo:3:" "bad field: position"
says "field 1 (MathEval) F is not a number at (0, 0, 0) on curve 1" "bad field: field, option, place"
says "on 2 more curves" "bad field: one message, the other curves counted"

square='Point(1)={0,0,0,.1}; Point(2)={1,0,0,.1}; Point(3)={1,1,0,.1}; Point(4)={0,1,0,.1}; Line(1)={1,2}; Line(2)={2,3};
Line(3)={3,4}; Line(4)={4,1}; Curve Loop(1)={1:4}; Plane Surface(1)={1};'
refused() { # NAME LIMIT SCRIPT: before anything is meshed
  printf '%s\n' "$square" "$3" >many.geo
  exits 1 "too many elements, $1: exit status" "$MESHGEN" -2 many.geo -max_elements "$2" -time_limit 5 -o x.msh
  absent "too many elements, $1: no output" x.msh
}
refused "by a field" 1e8 'Field[1]=Box; Field[1].VIn=1e-5; Field[1].VOut=.1; Field[1].XMin=.3; Field[1].XMax=.7; Field[1].YMin=.3;
Field[1].YMax=.7; Background Field=1;'
says "about 3.7" "too many elements, by a field: the estimate, 4 / sqrt(3) * 0.16 / 1e-10"
says "fixed by Field[1] (Box, line 3)" "too many elements, by a field: which"
refused "by the sizes of points" 1e5 'Mesh.MeshSizeFactor=1e-2;'
says "about 2.31e+06 elements" "too many elements, by points: the estimate"
says "curve 1 has 1000 edges: fixed by the sizes of points 1 (0.1) and 2 (0.1) times Mesh.MeshSizeFactor = 0.01" "too many elements, by points: why"
refused "of a transfinite face" 1e8 'Transfinite Curve{1:4}=20001; Transfinite Surface{1};'
says "about 8e+08 elements" "too many elements, of a transfinite face: exactly"
printf '%s\n' "$square" 'Mesh.MeshSizeFactor=.2;' >many.geo
exits 0 "a mesh of about half the limit is made" "$MESHGEN" -2 many.geo -max_elements 12000 -o x.msh
printf '%s\n' "$square" 'Field[1]=MathEval; Field[1].F="0.1-10*x*(1-x)*y*(1-y)*(x-y)"; Background Field=1;' >many.geo
exits 1 "sizes that sink below 0 inside a face" "$MESHGEN" -2 many.geo -time_limit 5 -o x.msh
says "many.geo:3:29: error: field 1 (MathEval) F gives the size" "sizes below 0: field, option, line"
says "on surface 1; sizes must be positive" "sizes below 0: where"
printf '%s\n' "$square" 'Field[1]=MathEval; Field[1].F="0.01+0.1/x"; Background Field=1;' >many.geo
exits 0 "a division by zero" "$MESHGEN" -2 many.geo -o x.msh
says "many.geo:3:29: warning: field 1 (MathEval) F is infinite at (0, " "division by zero: field, option, line, place"
check "division by zero: one warning" test "$(grep -c warning: err.txt)" = 1

# Words that are no files, but switches without their dash or arguments of switches that take none.
cp "$ROOT/geo/square.geo" good.geo
exits 2 "help without a dash" "$MESHGEN" help
says "there is no file 'help'; did you mean -help?" "the switch is named"
exits 2 "a level after -optimize" "$MESHGEN" -2 good.geo -optimize 2 -o none.msh
says "-optimize takes no number, and there is no file '2'" "both readings are named"
absent "nothing is written" none.msh
exits 2 "2 without a dash" "$MESHGEN" 2 good.geo
says "did you mean -2?" "-2 is named"
exits 2 "an empty word" "$MESHGEN" -2 ""
says "an empty word is no input file" "it is said"
exits 3 "a file of such a name is missed as a file after --" "$MESHGEN" -2 -- help
cp good.geo 2
exits 0 "a file of such a name is read" "$MESHGEN" -2 -v 1 -no_report -optimize 2 -o y.msh
