# min_angle.sh - the guaranteed smallest angle on models of several faces, which stay conforming
. "$(dirname "$0")/lib.sh"

exits 0 "conge at 30 degrees" "$MESHGEN" -2 "$ROOT/geo/conge.geo" -clscale 3 -min_angle 30 -require "min_angle>=30" -no_report -o conge.msh
exits 0 "conge is valid" "$MESHGEN" check conge.msh
exits 0 "porous medium at 30 degrees" "$MESHGEN" -2 "$ROOT/geo/porous.geo" -min_angle 30 -require "min_angle>=30" -no_report -o porous.msh

# two faces run the opposite way round, joined along a line, with a sliver of 0.6 by 10 at one of them
cat >sharp.geo <<'END'
Point(1) = {0, 0, 0, 1};
Point(2) = {10, 0, 0, 1};
Point(3) = {10, 0.6, 0, 1};
Point(4) = {3, 4, 0, 0.2};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 1};
Line(4) = {1, 4};
Line(5) = {4, 3};
Curve Loop(1) = {1, 2, 3};
Plane Surface(1) = {1};
Curve Loop(2) = {4, 5, 3};
Plane Surface(2) = {2};
END
exits 0 "sharp faces of opposite sense" "$MESHGEN" -2 sharp.geo -min_angle 30 -no_report -o sharp.msh
says "at input angles under 60 degrees" "what cannot reach the angle is counted"
exits 0 "sharp faces are valid" "$MESHGEN" check sharp.msh

exits 0 "transfinite faces keep their grids" "$MESHGEN" -2 "$ROOT/geo/backward_step.geo" -min_angle 30 -no_report -o step.msh
exits 0 "they are valid" "$MESHGEN" check step.msh
exits 1 "an angle beyond reach is refused" "$MESHGEN" -2 "$ROOT/geo/conge.geo" -min_angle 50 -o x.msh
