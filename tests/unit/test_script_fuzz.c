// test_script_fuzz.c - thousands of damaged scripts: the fuzz target of tests/fuzz run over mutations of tests/script
// SPDX-License-Identifier: MIT
//
// Usage: test_script_fuzz [SEED ROUNDS FILE...]. Without arguments a few fixed rounds over all script tests
// but those of limits.
#include "../fuzz/fuzz_script.c"

#include <dirent.h>
#include <unistd.h>

#include "base/file.h"
#include "base/rng.h"
#include "base/str.h"

static const char *const words[] = {
    "{",
    "}",
    "(",
    ")",
    "[",
    "]",
    ";",
    ",",
    ":",
    "{:}",
    "=",
    "+=",
    "-",
    "*",
    "/",
    "^",
    "~{1}",
    "#",
    "?",
    "\"",
    "/*",
    "//",
    "\n",
    "For i In {1:3}",
    "EndFor",
    "If (1)",
    "Else",
    "ElseIf (0)",
    "EndIf",
    "Macro m",
    "Return",
    "Call m;",
    "x",
    "x[]",
    "x[0]",
    "x = ",
    "Point",
    "Line",
    "Surface",
    "Volume",
    "Physical",
    "Curve Loop",
    "Plane Surface",
    "Duplicata",
    "Translate {1,0,0}",
    "Rotate {{0,0,1},{0,0,0},1}",
    "Symmetry {1,0,0,0}",
    "Dilate {{0,0,0},2}",
    "Extrude {1,0,0}",
    "Layers{3};",
    "Recombine;",
    "Boundary",
    "CombinedBoundary",
    "PointsOf",
    "Delete",
    "Recursive Delete",
    "Coherence;",
    "Transfinite Curve {:} = 5;",
    "Transfinite Surface {:};",
    "newp",
    "newl",
    "news",
    "newreg",
    "Point(newp) = {1,2,0};",
    "Line(newl) = {1,2};",
    "0",
    "1",
    "-1",
    "2",
    "3",
    "1e9",
    "1e300",
    "-2147483649",
    "0.5",
    "Sin(",
    "Sprintf(\"%g\",",
    "Str(",
    "StrCat(",
    "Abs(",
    "Unique(",
    "Printf(\"%g\",",
    "Field[1]",
    ".",
    "Mesh.Algorithm",
    "Background Field",
    "DefineConstant[",
    "Periodic Curve {1} = {2};",
    "Split Curve {1} Point {2};",
    "Circle(5) = {1,2,3};",
    "Compound Spline(9) = {1} Using 5;",
    "Delete Model;",
    "Physical Surface{1}",
    "In",
    "Surface{1};",
    "Geometry.AutoCoherence = 0;",
    "Geometry.OldNewReg = 0;",
    "SetFactory(\"OpenCASCADE\");",
    "Rectangle(1) = {0,0,0,1,1};",
};

static size_t below(Rng *r, size_t n) { return n ? rng_below(r, (uint32_t)n) : 0; }

// One change somewhere: a word in, a span out, twice, elsewhere, or a byte spoiled.
static void mutate(Str *s, Rng *r)
{
  size_t at = below(r, s->len + 1), n = below(r, 40);
  n = MIN(n, s->len - at);
  Str out = {0};
  str_append_n(&out, s->data, at);
  switch (below(r, 5)) {
  case 0:
    str_append(&out, words[below(r, ARRAY_LEN(words))]);
    n = 0;
    break;
  case 1: break;
  case 2:
    str_append_n(&out, s->data + at, n);
    n = 0;
    break;
  case 3: str_append_n(&out, s->data + below(r, s->len - n + 1), n); break;
  default: str_char(&out, (char)below(r, 256)); n = MIN((size_t)1, s->len - at);
  }
  str_append_n(&out, s->data + at + n, s->len - at - n);
  str_free(s);
  *s = out;
}

static size_t fuzz_text(const char *text, size_t len, uint64_t seed, int rounds)
{
  Rng r = {seed};
  size_t bytes = 0;
  for (int i = 0; i < rounds; i++) {
    Str s = {0};
    str_append_n(&s, text, len);
    for (size_t k = below(&r, 6) + 1; k > 0; k--) mutate(&s, &r);
    LLVMFuzzerTestOneInput((const uint8_t *)s.data, s.len);
    bytes += s.len;
    str_free(&s);
  }
  return bytes;
}

static bool fuzz_file(const char *path, uint64_t seed, int rounds)
{
  size_t len;
  char *text = file_read(path, &len);
  if (!text) return false;
  fuzz_text(text, len, seed, rounds);
  free(text);
  return true;
}

int main(int argc, char **argv)
{
  const char *root = getenv("ROOT");
  if (argc > 3) {
    for (int i = 3; i < argc; i++) {
      fprintf(stderr, "%s\n", argv[i]);
      fuzz_file(argv[i], strtoull(argv[1], NULL, 10), (int)strtol(argv[2], NULL, 10));
    }
    return 0;
  }
  static const char *const folders[] = {"lexical", "expression", "variable", "list",      "string",
                                        "control", "constant",   "entity",   "transform", "mesh",
                                        "field",   "option",     "command",  "error"};
  if (root && chdir(root) != 0) return 1;
  int n = 0;
  for (size_t f = 0; f < ARRAY_LEN(folders); f++) {
    Str dir = {0};
    str_printf(&dir, "tests/script/%s", folders[f]);
    struct dirent **entry;
    int files = scandir(str_text(&dir), &entry, NULL, alphasort);
    bool ok = files > 0;
    for (int i = 0; i < files; i++) {
      const char *dot = strrchr(entry[i]->d_name, '.');
      Str path = {0};
      str_printf(&path, "%s/%s", str_text(&dir), entry[i]->d_name);
      if (dot && !strcmp(dot, ".geo"))
        ok &= fuzz_file(str_text(&path), (uint64_t)(100 * f) + (uint64_t)i, 60);
      str_free(&path);
      free(entry[i]);
    }
    if (files >= 0) free(entry);
    printf("%s %d - damaged scripts of %s\n", ok ? "ok" : "not ok", ++n, str_text(&dir));
    str_free(&dir);
  }
  printf("1..%d\n", n);
  return 0;
}
