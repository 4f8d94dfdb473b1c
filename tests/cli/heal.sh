# heal.sh - curves that meet without a common point: embedded ones are split, others are errors, and with -heal split too
. "$(dirname "$0")/lib.sh"

square='Point(1)={0,0,0,.1}; Point(2)={1,0,0,.1}; Point(3)={1,1,0,.1}; Point(4)={0,1,0,.1};
Line(1)={1,2}; Line(2)={2,3}; Line(3)={3,4}; Line(4)={4,1}; Curve Loop(1)={1,2,3,4};'

cat >bow.geo <<'END'
Point(1)={0,0,0,.1}; Point(2)={1,1,0,.1}; Point(3)={1,0,0,.1}; Point(4)={0,1,0,.1};
Line(1)={1,2}; Line(2)={2,3}; Line(3)={3,4}; Line(4)={4,1};
Curve Loop(1)={1,2,3,4}; Plane Surface(1)={1};
Physical Curve("rim")={1,2,3,4}; Physical Surface("wings")={1};
END
exits 1 "bow tie: an error" "$MESHGEN" -2 bow.geo -o bow.msh
says "curve 3 crosses curve 1 at (0.5, 0.5)" "bow tie: names both and the place"
exits 0 "bow tie: healed" "$MESHGEN" -2 -heal bow.geo -o bow.msh
prints "0.5" "bow tie: both wings are meshed"
exits 0 "bow tie: audited as read" "$MESHGEN" check bow.msh
exits 0 "bow tie: healed by the option" "$MESHGEN" -2 -setnumber Mesh.Heal 1 bow.geo -o option.msh
exits 0 "bow tie: in two calls of the mesher" "$MESHGEN" -2 -heal bow.geo -string "Mesh 2;" -o twice.msh

cat >cracks.geo <<END
$square Plane Surface(1)={1};
Point(5)={.2,.2,0,.03}; Point(6)={.8,.8,0,.1}; Point(7)={.2,.7,0,.1}; Point(8)={.8,0,0,.1};
Line(5)={5,6}; Line(6)={7,8}; Point(9)={.5,.5,0}; Point(10)={.75,.5,0,.05}; Point(11)={.25,.5,0,.05};
Circle(7)={10,9,11}; Circle(8)={11,9,10}; Curve{5,6,7,8} In Surface{1};
Physical Curve("crack")={6}; Physical Surface("plate")={1};
END
exits 0 "embedded curves that cross, and one that ends on the boundary" "$MESHGEN" -2 cracks.geo -o cracks.msh
prints "0.921954" "the parts of a split curve stay in its group"

cat >leaves.geo <<END
$square Plane Surface(1)={1};
Point(7)={.2,.7,0,.1}; Point(8)={.8,-.2,0,.1}; Line(6)={7,8}; Curve{6} In Surface{1};
END
exits 1 "embedded curve that leaves its face" "$MESHGEN" -2 leaves.geo -o x.msh
says "leaves.geo:3:48:" "it has a place"
says "curve 6, embedded in surface 1, leaves it through curve 1 at (0.6666666667, 0)" "it says what and where"
absent "nothing is written" x.msh
exits 0 "healed: what is inside stays" "$MESHGEN" -2 -heal leaves.geo -o x.msh
says "left out" "and a warning"

cat >holes.geo <<END
$square
Point(9)={.9,.5,0}; Point(10)={1.2,.5,0,.05}; Point(11)={.6,.5,0,.05}; Circle(7)={10,9,11}; Circle(8)={11,9,10};
Point(19)={.5,.6,0}; Point(20)={.8,.6,0,.05}; Point(21)={.2,.6,0,.05}; Circle(17)={20,19,21}; Circle(18)={21,19,20};
Curve Loop(2)={7,8}; Curve Loop(3)={17,18}; Plane Surface(1)={1,2,3}; Physical Surface("rest")={1};
END
exits 0 "holes that cross each other and the boundary" "$MESHGEN" -2 -heal holes.geo -clscale 0.05 -o holes.msh
check "their union is taken away" "$PYTHON" - <<'END'
import math, re
text = open("out.txt").read()
area = float(re.search(r"rest +\d+ +(\S+)", text)[1])
n = 2000
want = sum(1 for i in range(n) for j in range(n) if math.hypot((i + .5) / n - .9, (j + .5) / n - .5) > .3
           and math.hypot((i + .5) / n - .5, (j + .5) / n - .6) > .3) / n ** 2
assert abs(area - want) < 1e-3, (area, want)
END

cat >fields.geo <<END
$square Plane Surface(1)={1}; Point(5)={.2,.5,0}; Point(6)={.8,.5,0}; Point(7)={.5,.2,0}; Point(8)={.5,.8,0};
Line(5)={5,6}; Line(6)={7,8}; Curve{5,6} In Surface{1};
Field[1]=Distance; Field[1].CurvesList={5}; Field[2]=Threshold; Field[2].InField=1; Field[2].DistMin=.02; Field[2].DistMax=.2;
Field[2].SizeMin=.01; Field[2].SizeMax=.1; Background Field=2; Physical Curve("fine")={5};
END
exits 0 "fields follow the parts of a curve" "$MESHGEN" -2 fields.geo -o fields.msh
prints " 60 " "all of it is fine"

for gap in 0.02 0.001; do # a strait narrower than the sagittas of the edges on its coasts
  exits 0 "two islands, $gap apart" "$MESHGEN" -2 "$ROOT/geo/islands.geo" -setnumber gap $gap -v 4 -require "crossing_rounds>=1" \
    -require "crossing_rounds<=12" -require "halved_edges>5" -save_all -o islands.msh
  says "none crosses now" "two islands, $gap apart: rounds are told"
  exits 0 "two islands, $gap apart: no crossing is left" "$MESHGEN" check islands.msh
done

cat >duplicates.geo <<END
Point(1)={0,0,0,.2}; Point(2)={1,0,0,.2}; Point(3)={1,1,0,.2}; Point(4)={0,1,0,.2};
Point(12)={1,0,0,.2}; Point(13)={1,1,0,.2}; Point(14)={0,1,0,.2}; Point(11)={0,0,0,.2};
Line(1)={1,2}; Line(2)={12,3}; Line(3)={13,4}; Line(4)={14,11};
Curve Loop(1)={1:4}; Plane Surface(1)={1}; Physical Surface("whole")={1};
END
exits 1 "a loop of duplicates of points" "$MESHGEN" -2 duplicates.geo -o x.msh
says "curve loop 1 is not closed" "it is not closed"
exits 0 "healed: they are one" "$MESHGEN" -2 -heal duplicates.geo -o duplicates.msh
check "and the loop encloses the square" grep -Eq 'whole +[0-9]+ +1$' out.txt
exits 0 "sizes are explained there too" "$MESHGEN" -heal -explain_size .5,.5 duplicates.geo

check "soups of polygons: the mesh has the area of their union" "$PYTHON" "$here/heal_soup.py" "$MESHGEN" 42
echo "1..$count"
