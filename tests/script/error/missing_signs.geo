// Words and signs that are missing (2).
Translate {1,0,0} { 3 }                                  // expect error: expected a shape such as Surface{1}; or '}', found '3'
BooleanUnion{ 3 }{ Surface{1}; }                         // expect error: expected a shape such as Surface{1}; or '}', found '3'
Split Point {1} Point {2};                               // expect error: expected 'Curve', found 'Point', a word of the language
Function Field(1) = 3;                                   // expect error: 'Function Field(..)' was removed long ago; write Field[1] = MathEval; Field[1].F = "...";
x = Sin 3;                                               // expect error: expected '(' or '[', found '3'
x = #3;                                                  // expect error: expected a name, found '3'
A::B::c = 3;                                             // expect error: name spaces cannot stand in one another
x = S~{1}.3;                                             // expect error: expected ';', found '.3'
x = Mesh.3;                                              // expect error: expected ';', found '.3'
x() = Point In 3;                                        // expect error: expected 'BoundingBox', found '3'
y = Field[1].3;                                          // expect error: expected '.' and the name of a field's option, found '.3'
Struct T [ a 1 ];
z = NameStruct[#1] + 1;                                  // expect error: NameStruct gives a text, a number is needed here
Physical Curve(1, "a") = {1};                            // expect error: a physical group is given by number, by name, or by "name", number
Translate {1,0,0} { Point In 3; }                        // expect error: expected 'BoundingBox', found '3'
Nothing.Key = 3;                                         // expect error: unknown option category 'Nothing' in 'Nothing.Key'
s = Str(Point);                                          // expect error: expected '{', found ')'
