// The marks that version control leaves are told once.
<<<<<<< HEAD // expect error: the marks of a merge conflict
a = 1;
=======
a = 2;
>>>>>>> branch
Printf("%g", a); // expect: 2
