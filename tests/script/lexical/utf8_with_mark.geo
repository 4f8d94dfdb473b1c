a = 7; Printf("%g", a); // expect: 7
s = "é"; Printf(s); // expect: é
