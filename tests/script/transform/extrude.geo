// Extrude returns the copy, the body swept, and the lateral ones.
Point(1) = {0,0,0}; Point(2) = {1,0,0}; Line(1) = {1, 2};
e[] = Extrude {0, 1, 0} { Line{1}; };
Printf("e", e[]);                                // expect: e [0]2 [1]5 [2]4 [3]-3
q[] = Extrude {0, 0, 1} { Point{1}; }; Printf("%g", #q[]); // expect: 2
Extrude {0, 1, 0} { Line{2}; Layers{5}; Recombine; }
Extrude {0, 1, 0} { Point{1}; Layers{{2, 3}, {0.5, 1}}; }
r[] = Extrude {{0, 1, 0}, {5, 0, 0}, Pi/4} { Point{2}; Layers{4}; }; Printf("%g", #r[]); // expect: 2
s[] = Extrude {{0, 0, 1}, {0, 1, 0}, {5, 0, 0}, Pi/4} { Point{2}; }; Printf("%g", #s[]); // expect: 2
Extrude Point {1, {0, 0, -1}};
Extrude Line {1, {0, 0, 1}, {-3, 0, 0}, Pi/6} { Layers{3}; Recombine; };
Extrude {0, 1, 0} { Line{1}; Layers{{1, 2}, {1}}; } // expect error: 2 numbers of layers, but 1 heights
Extrude {0, 1, 0} { Line{1}; Layers{-1}; }       // expect error: -1 layers are not possible
Extrude {{0, 0, 1}, {0, 0, 0}} { Line{1}; }      // expect error: Extrude by rotation needs an axis, a point and an angle
Extrude Line {1};                                // expect error: Extrude needs a translation
Extrude { Surface{5}; } Using Wire {1}           // expect error: Wire (extrusion along a curve) needs OpenCASCADE
