// café naïve, Latin-1 in a comment
a = 1; // über
s = "müll"; Printf("%g %g", a, StrLen(s)); // expect: 1 4
