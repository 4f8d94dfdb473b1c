// A porous medium: 200 disks that do not touch, put at random into a square by a For loop and a macro. The generator is written out
// here (Lehmer's, modulus 2^31 - 1), so the same disks come out everywhere; change `state` for others.
//   meshgen -2 geo/porous.geo -o porous.msh
n = 200;
rmin = 0.012; rmax = 0.035;
free = 0.006; // least distance between disks, and from the sides
state = 4711;

Macro random // a number between 0 and 1 to `u`
  state = Fmod(16807*state, 2147483647);
  u = state/2147483647;
Return

Macro disk // four arcs about (cx, cy) of radius cr; the loop goes to `holes`
  p = newp;
  Point(p) = {cx, cy, 0};
  For q In {0:3}
    Point(p + 1 + q) = {cx + cr*Cos(q*Pi/2), cy + cr*Sin(q*Pi/2), 0, cr/3};
  EndFor
  c = newc;
  For q In {0:3}
    Circle(c + q) = {p + 1 + q, p, p + 1 + (q + 1) % 4};
  EndFor
  l = newcl;
  Curve Loop(l) = {c:c + 3};
  holes[] += l;
  rims[] += {c:c + 3};
Return

Point(1) = {0, 0, 0, 0.02}; Point(2) = {1, 0, 0, 0.02}; Point(3) = {1, 1, 0, 0.02}; Point(4) = {0, 1, 0, 0.02};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1:4};

xs[] = {}; ys[] = {}; rs[] = {}; holes[] = {}; rims[] = {};
found = 0;
For try In {1:20000}
  If(found < n)
    Call random; cr = rmin + (rmax - rmin)*u*u; // small ones are more frequent
    Call random; cx = cr + free + u*(1 - 2*(cr + free));
    Call random; cy = cr + free + u*(1 - 2*(cr + free));
    fits = 1;
    For k In {0:found - 1}
      If(Hypot(cx - xs[k], cy - ys[k]) < cr + rs[k] + free)
        fits = 0;
      EndIf
    EndFor
    If(fits)
      xs[] += cx; ys[] += cy; rs[] += cr; found++;
      Call disk;
    EndIf
  EndIf
EndFor
Printf("%g disks", found);

Plane Surface(1) = {1, holes[]};
Physical Surface("fluid") = {1};
Physical Curve("grains") = {rims[]};
Physical Curve("in") = {4};
Physical Curve("out") = {2};
