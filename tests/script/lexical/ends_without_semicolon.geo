// A file that ends in the middle of a statement.
a = 5;
b = a + 1 // expect error: expected ';' at the end