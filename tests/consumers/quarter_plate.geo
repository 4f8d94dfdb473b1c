// A quarter of a plate with a circular hole, fine at the hole
r = 1; L = 10; h = 1.2;
Point(1)={0,0,0}; Point(2)={r,0,0,0.1}; Point(3)={L,0,0,h}; Point(4)={L,L,0,h}; Point(5)={0,L,0,h}; Point(6)={0,r,0,0.1};
Line(1)={2,3}; Line(2)={3,4}; Line(3)={4,5}; Line(4)={5,6}; Circle(5)={6,1,2};
Curve Loop(1)={1,2,3,4,5}; Plane Surface(1)={1};
Physical Curve("bottom")={1}; Physical Curve("right")={2}; Physical Curve("left")={4}; Physical Curve("hole")={5}; Physical Surface("plate")={1};
