a = 5;
/* never closed // expect error: this comment has no end
b = 1;
