// Rarer forms.
Point(1) = {0,0,0}; Point(2) = {1,0,0}; Point(3) = {2,0,0}; Point(4) = {2,1,0};
Line(1) = {1, 2, 3}; Line(2) = {3, 4};
Physical Curve(5) = {2}; Physical Curve(6) = {1};
s[] = Split Curve {1} Point {2}; Printf("%g", #s[]); // expect: 2
Translate {0, 0, 1} { Physical Curve{:}; }
Translate {0, 0, -1} { Point In BoundingBox {-1,-1,-1, 9,9,9}; }
Extrude {0, 0, 1} { Line{2}; Layers{2}; Recombine 1; ScaleLastLayer; Using Index[0]; QuadTriNoNewVerts RecombLaterals; } // expect warning: 'QuadTriNoNewVerts' is left out
Extrude { Point{1}; Layers{2, 0.1}; }            // expect error: normal
Duplicata Point{1};                              // expect error: expected '{' and a list of shapes
Intersect Curve {1} Surface {2};                 // expect error: Intersect Curve is not supported
Ruled ThruSections(1) = {1};                     // expect error: Ruled ThruSections needs the OpenCASCADE kernel
b[] = BoundingBox Curve{99};                     // expect error: 99
Extrude {0, 0, 1} {
  Line{2}; Foo{1};                               // expect error: expected a shape such as Surface{1}; or '}', found 'Foo'
}
Delete Point;                                    // expect error: expected shapes in braces, or what to delete
Curve Loop(20) = {2}; Printf(StrCat("<", Curve{2}, ">")); // expect: <>
