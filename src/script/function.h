// function.h - the table of functions: what they take and give
// SPDX-License-Identifier: MIT
#ifndef SCRIPT_FUNCTION_H
#define SCRIPT_FUNCTION_H

#include "script/token.h"

typedef enum {
  FUNCTION_NUMBER,
  FUNCTION_LIST,
  FUNCTION_TEXT,
  FUNCTION_TEXTS, // a list of texts; as one text, joined by newlines
  FUNCTION_SAME,  // a number of a number, a list of a list
} FunctionType;

enum { FUNCTION_ANY = 1000000 };

typedef struct {
  uint32_t word;
  FunctionType type;
  int min_args, max_args;
  bool takes_name, takes_lists; // the first argument is a name; braced lists are arguments too
  double (*f1)(double);         // numbers to numbers: one of these, or neither
  double (*f2)(double, double);
} FunctionRow;

// NULL for a word that is no function. O(1).
const FunctionRow *function_find(uint32_t word);
int function_index(const FunctionRow *f); // its place in the table
const FunctionRow *function_at(int index);
// The function, constant or other word of the language that `word` is probably a misspelling of, or NULL.
const char *function_nearest(const char *word);

#endif
