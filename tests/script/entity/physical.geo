// Physical groups by number, by name, by both; =, += and -=.
Point(1) = {0,0,0}; Point(2) = {1,0,0}; Point(3) = {0,1,0};
Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,1};
Curve Loop(1) = {1,2,3}; Plane Surface(1) = {1};
Physical Point(1) = {1, 2};
Physical Line("walls") = {1, -2};
Physical Curve("named", 7) = {3};                // expect note: made here
Physical Surface(StrCat("fl", "uid")) = 1;
Physical Curve(8) = {:};
Physical Curve(9) = Curve{:};
Physical Curve(8) -= {2};
Physical Curve(7) += {1};
w[] = Physical Curve{7}; Printf("7", w[]);       // expect: 7 [0]3 [1]1
w[] = Physical Curve{8}; Printf("8", w[]);       // expect: 8 [0]1 [1]3
w[] = Physical Curve{7, 8}; Printf("%g", #w[]);  // expect: 4
Printf(Physical Curve{7});                       // expect: named
w[] = Physical Curve{70};                        // expect error: there is no physical group 70
Physical Curve(7) = {1};                         // expect error: exists already
Physical Curve(50) += {1};                       // expect error: 50
Physical Curve(1, 2) = {1};                      // expect error: a physical group is given by number, by name
Physical Curve(-4) = {1};                        // expect error: a tag must be positive, not -4
Physical Line(60) *= {1};                        // expect error: expected '=', '+=' or '-='
Physical Lines(61) = {1};                        // expect error: expected Point, Curve, Surface or Volume after 'Physical'
name = "by variable"; Physical Line(name) = {2};
Physical Line(62) = "*";
Physical Volume("none") = {};
Physical Curve("x", 63) = {q};                   // expect error: unknown variable 'q'
Delete Physicals;
w[] = Physical Curve{7};                         // expect error: there is no physical group 7
// expect model: groups 0
