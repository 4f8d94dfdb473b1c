a = 5; // expect: 5
Printf("%g", a);