// limits.h - caps on what a script may use; each has a message and a test
// SPDX-License-Identifier: MIT
#ifndef SCRIPT_LIMITS_H
#define SCRIPT_LIMITS_H

enum {
  LIMIT_NESTING = 100, // For, If and Macro blocks, braces and brackets inside one another
  LIMIT_EXPRESSION =
      2000,            // height of an expression's tree; a chain of a + b + c ... is as high as it is long
  LIMIT_CALLS = 200,   // macro calls inside one another
  LIMIT_INCLUDES = 50, // files inside one another
  LIMIT_LIST = 10 * 1000 * 1000,   // members of one list or range
  LIMIT_STRING = 1000 * 1000,      // bytes of one string
  LIMIT_NAME = 1000,               // bytes of one identifier
  LIMIT_SYMBOLS = 2 * 1000 * 1000, // different identifiers
  LIMIT_WORK =
      100 * 1000 * 1000, // statements run inside loops and macros, list members copied there, and so on
  LIMIT_ITERATIONS = 50 * 1000 * 1000, // of one For
  COST_ENTITY = 16,                    // work of a statement that makes an entity: about 300 bytes and 300 ns
  COST_GROUP = 8 * COST_ENTITY,
  COST_FIELD = 64 * COST_ENTITY,
};
#define LIMIT_MEMORY ((size_t)1 << 29) // bytes held by variables

#endif
