// banned.h - libc functions that have bitten others become compile errors
// SPDX-License-Identifier: MIT
#ifndef BASE_BANNED_H
#define BASE_BANNED_H

// The headers that declare them must come first, or their declarations would be poisoned too.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#ifndef __cplusplus
#pragma GCC poison strcpy strcat strncpy strncat sprintf vsprintf strtok atoi atof atol rand srand gets tmpnam
#endif

#endif
