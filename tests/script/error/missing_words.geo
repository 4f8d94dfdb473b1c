// Words and signs that are missing (1).
DefineConstant[ a = {1, 2 3} ];                          // expect error: expected ',' or '}', found '3'
DefineConstant[ b = {1, Name "x", 3} ];                  // expect error: expected an attribute such as Name or Min, found '3'
Struct S [ 1 ];                                          // expect error: expected the name of a member or ']', found '1'
Surface(1) = {1} In Cube {1};                            // expect error: expected 'Sphere', found 'Cube'
Nurbs(1) = {1,2} Knots {0,0,1,1} 2;                      // expect error: expected 'Order', found '2'
x = !{1,2};                                              // expect error: '!' needs a number, not a list
Transfinite Line {1} = 3 Using Nothing 2;                // expect error: unknown law 'Nothing': Progression, Bump or Beta
Transfinite Point {1} = 3;                               // expect error: expected Curve, Surface or Volume after 'Transfinite', found 'Point', a word of the language
Characteristic Size {1} = 3;                             // expect error: expected 'Length', found 'Size'
Periodic Point {1} = {2};                                // expect error: expected Curve or Surface after 'Periodic', found 'Point', a word of the language
Field[1] = 3;                                            // expect error: expected the type of the field, found '3'
Field[1].3 = 3;                                          // expect error: expected '=' and a type, or '.' and an option, found '.3'
Plugin(3).Run;                                           // expect error: expected the name of a plugin, found '3'
Plugin(MathEval).3 = 1;                                  // expect error: expected '.', found '.3'
View "a" { 3 };                                          // expect error: expected an element of the view such as ST(..){..};, or '}', found '3'
BoundaryLayer 3;                                         // expect error: expected 'Field', found '3'
Background 3;                                            // expect error: expected 'Field' or 'Mesh View[..]', found '3'
Background Mesh 3;                                       // expect error: expected 'View', found '3'
Extrude {1,0,0} { 3 }                                    // expect error: expected a shape such as Surface{1}; or '}', found '3'
Point In 3;                                              // expect error: expected a value, found 'In', a word of the language
