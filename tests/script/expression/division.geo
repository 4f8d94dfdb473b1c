// Division by zero is an error; the value is the left operand.
zero = 0;
x = 3 / zero;                                    // expect error: division by zero
Printf("%g", x);                                 // expect: 3
x = 1/0;                                         // expect error: division by zero
y = 5 % zero;                                    // expect error: division by zero
y /= 0;                                          // expect error: division by zero
