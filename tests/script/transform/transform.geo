// Transformations return the tags they were given; Duplicata returns new ones.
Point(1) = {1,0,0}; Point(2) = {2,0,0}; Line(1) = {1,2};
t[] = Translate {0, 1, 0} { Point{1}; Point{2}; };
Printf("t", t[]);                                // expect: t [0]1 [1]2
Printf("%g %g %g", Point{1});                    // expect: 1 1 0
Translate {0, -1, 0} { Line{1}; }
Printf("%g %g %g", Point{2});                    // expect: 2 0 0
Rotate {{0, 0, 1}, {0, 0, 0}, Pi/2} { Line{1}; }
Printf("%.3f %.3f", Point{1}[0], 0);             // expect error: expected ',' or ')'
p[] = Point{1}; Printf("%.3f %.3f", Fabs(p[0]), p[1]); // expect: 0.000 1.000
Symmetry {0, 1, 0, 0} { Point{1, 2}; }
p[] = Point{2}; Printf("%.3f", p[1]);            // expect: -2.000
Dilate {{0, 0, 0}, 3} { Point{2}; }
p[] = Point{2}; Printf("%.3f", p[1]);            // expect: -6.000
Dilate {{0, 0, 0}, {1, 0.5, 1}} { Point{2}; }
p[] = Point{2}; Printf("%.3f", p[1]);            // expect: -3.000
Affine {1,0,0,5, 0,1,0,0, 0,0,1,0} { Point{2}; }
p[] = Point{2}; Printf("%.3f", p[0]);            // expect: 5.000
d[] = Duplicata { Point{1, 2}; }; Printf("d", d[]); // expect: d [0]3 [1]4
e[] = Translate {10, 0, 0} { Duplicata { Line{1}; } }; Printf("%g", #e[]); // expect: 1
Translate {1, 0, 0} { Point{1}; };               // expect warning: this ';' is superfluous
Translate {1, 0, 0} { Point{1} }                 // expect error: expected ';' after this shape
Translate {1, 0} { Point{1}; }                   // expect error: a vector needs 3 components {x, y, z}; 2 given
Rotate {{0,0,0}, {0,0,0}, 1} { Point{1}; }       // expect error: the axis of a rotation cannot be {0, 0, 0}
Symmetry {1, 0, 0} { Point{1}; }                 // expect error: a plane of symmetry needs 4 numbers {a, b, c, d}; 3 given
Symmetry {0, 0, 0, 1} { Point{1}; }              // expect error: the normal of a plane of symmetry cannot be
Affine {1, 2, 3} { Point{1}; }                   // expect error: an affine map needs 12 or 16 numbers, row by row; 3 given
Translate {1, 0, 0} { Points{1}; }               // expect error: expected a shape such as Surface{1}; or '}'
Translate {1, 0, 0} Point{1};                    // expect error: expected '{' and a list of shapes
Translate {1, 0, 0} { Physical Point{5}; }       // expect error: there is no physical group 5
Translate {1, 0, 0} { Duplicata{ Point{1}; }; }  // expect warning: this ';' is superfluous
