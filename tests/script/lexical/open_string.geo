a = 5;
s = "never closed; // expect error: this string has no end
