// Structures, their members and name spaces.
Struct S [ a 1, b {1,2,3}, name "x", l Str["p","q"] ];
Printf("%g %g %g", S.a, S.b, S.b(1));                   // expect: 1 1 2
x() = S.b();
Printf("x", x(), #S.b());                               // expect: x [0]1 [1]2 [2]3 [3]3
Printf(S.name);                                         // expect: x
Printf(S.l(1));                                         // expect: q
Printf("%g %g %g", S.a + 2*S.b[2], #S.b[], -S.a);       // expect: 7 3 -1
Struct NS::S [ a 10, b {4,5} ];
Struct NS::T [ a 20 ];
Struct T [ ];
Printf("%g %g %g", NS::S.a, NS::T.a, S.a);              // expect: 10 20 1
Printf("%g %g", NS::S.b(1), #NS::S.b());                // expect: 5 2
Printf("%g %g %g %g", S, T, NS::S, NS::T);              // expect: 1 2 1 2
Printf("%g %g %g", DimNameSpace[NS], DimNameSpace[], DimNameSpace[None]); // expect: 2 2 0
Printf(StrCat(NameStruct[NS::#2], NameStruct[#1]));     // expect: TS
Printf("%g %g %g %g", Exists(S), Exists(S.a), Exists(S.name), Exists(S.zz)); // expect: 1 1 1 0
Printf("%g %g %g", Exists(NS::S), Exists(NS::S.b), Exists(NS::Q)); // expect: 1 1 0
Printf("%g %g", GetForced(S.a), GetForced(S.zz, 7));    // expect: 1 7
Printf(StrCat(GetForcedStr(S.name, "d"), GetForcedStr(S.zz, "d"))); // expect: xd
Struct S [ Append, c 9 ];
Struct S [ AppendToExistingStruct 1, d 8 ];
Printf("%g %g %g", S.c, S.d, DimNameSpace[]);           // expect: 9 8 2
Struct R~{3} [ a 6, Type 2, Min 3 ];
Printf("%g %g %g", R_3.a, R~{3}.Type, R_3.Min);         // expect: 6 2 3
Struct Mesh [ Algorithm 77 ];
Printf("%g", Mesh.Algorithm);                           // expect: 77
T = 5; Printf("%g", T);                                 // expect: 5
Point(NS::S.a) = {S.b(0), NS::S.b(1), 0};
Printf("p", Point{10});                                 // expect: p [0]1 [1]5 [2]0
For i In {1:2}
  Struct Ring::K~{i} [ v 10*i ];
  Printf("%g", Ring::K~{i}.v);
EndFor
// expect: 10
// expect: 20
Struct S [ a 2 ];                                       // expect error: the Struct 'S' exists already
Struct S [ Append, a 2 ];                               // expect error: the member 'a' of this Struct exists already
Printf("%g", S.b(3));                                   // expect error: does not exist
Printf("%g", S.zz);                                     // expect error: unknown member 'S.zz' of a Struct
Printf("%g", No::S.a);                                  // expect error: unknown member 'No::S.a' of a Struct
Printf("%g", NS::Q);                                    // expect error: unknown Struct 'NS::Q'
S.a = 3;                                                // expect error: the members of a Struct cannot be changed
Printf(NameStruct[NS::#3]);                             // expect error: there is no Struct number 3 in name space NS
Printf("%g", S.name);                                   // expect error: is a text
Struct B [ a = 1 ];                                     // expect error: expected the value of this member
Struct B [ a ];                                         // expect error: expected the value of this member
// Numbers: given, counted on from the last, as values; enumerations; members added in parentheses.
Struct U::A [ a 1 ];
Struct U::B [ a 1, Tag 10 ];
n = Struct U::C [ a 1 ];
Printf("%g %g %g %g %g", U::A.Tag, U::B.Tag, U::B, n, DimNameSpace[U]); // expect: 1 10 10 11 3
Struct U::E [ Enum, NONE, PHYS, SKIN 10, GATE ];
Struct U::E (Append) [ Enum, CUT ];
Printf("%g %g %g %g %g", U::E.NONE, U::E.PHYS, U::E.SKIN, U::E.GATE, U::E.CUT); // expect: 0 1 10 11 12
Struct U::E (Add) [ Enum, X ];                          // expect error: expected 'Append'
