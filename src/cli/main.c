// main.c - the program: a table of contents
// SPDX-License-Identifier: MIT
#include "base/base.h"

int main(void)
{
  return EXIT_USAGE;
}
