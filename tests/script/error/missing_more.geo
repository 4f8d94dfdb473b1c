// Words and signs that are missing (3).
Point(1) = {0,0,0}; Point(2) = {1,0,0}; Point(3) = {1,1,0}; Point(4) = {0,1,0}; Point(5) = {2,0,0}; Point(6) = {2,1,0};
Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,4}; Line(4) = {4,1}; Line(5) = {2,5}; Line(6) = {5,6}; Line(7) = {6,3};
Nurbs(8) = {1, 4} Knots {0, 1, 1, 2} Order 1;
Extrude {0,0,1} { Line{1}; Layers{{2,-1}, {.5, 1}}; }    // expect error: -1 layers are not possible
Transfinite Surface "x";                                 // expect error: expected a list, or "*" for all
Transfinite Line {1} = 3 Using 3;                        // expect error: expected Progression, Bump or Beta, found '3'
Field[1]. 3 = 1;                                         // expect error: expected the name of a field's option, found '3'
Plugin(MathEval). 3 = 1;                                 // expect error: expected an option of the plugin, or Run, found '3'
x = Mesh. 3;                                             // expect error: expected the name of an option, found '3'
y = Field[1]. 3;                                         // expect error: expected the name of a field's option, found '3'
Printf("a") > "no_such_folder/x";                        // expect error: writing to 'tests/script/error/no_such_folder/x' is not allowed: it lies outside the working folder
Rotate {{0,0,1}, {0,0,0}, 1} { Point{1}; Line{1} }       // expect error: expected ';' after this shape
x = Str(3) + 1;                                          // expect error: a list can only be negated, or scaled by a number on its left (2 * l[])
Extrude {0,0,1} { Line{1}; Layers{1, 2, 3, 4}; }         // expect error: expected '}', found '4'
Extrude {{0,0,1}, {0,0,1}, {0,0,0}, 1, 2} { Line{1}; }   // expect error: expected '}', found '2'
Rotate {{0,0,1}, {0,0,0}, 1, 2, 3} { Line{1}; }          // expect error: expected '}', found ','
Printf("a") > ".";                                       // expect error: writing to 'tests/script/error/.' is not allowed: it lies outside the working folder
Macro Outer
  Macro Inner                                            // expect error: a macro inside a macro: the one before has no Return
  Return
Return                                                   // expect error: this Return belongs to no Macro
Call Outer;
DefineConstant[ a = {1, Choices {1, 2
                                                         // expect error: expected '}', found the end of the file