// check.h - assertions with levels, and the abort that says where
// SPDX-License-Identifier: MIT
#ifndef BASE_CHECK_H
#define BASE_CHECK_H

// Levels, fixed at compile time: 0 only CHECK; 1 also DCHECK (cheap, debug builds); 3 full O(n) validators after every mutation (stress
// build).
#ifndef CHECK_LEVEL
#define CHECK_LEVEL 0
#endif

#ifdef __cplusplus
extern "C" {
#endif

// Report a bug of ours on stderr (file, line, condition, the stage and entity last announced) and abort().
__attribute__((noreturn)) void check_failed(const char *file, int line, const char *cond);

// Remember what is being worked on, for check_failed. `stage` must outlive the call; thread-local.
void check_context(const char *stage, long entity);

#ifdef __cplusplus
}
#endif

#define CHECK(cond) ((cond) ? (void)0 : check_failed(__FILE__, __LINE__, #cond))
#if CHECK_LEVEL >= 1
#define DCHECK(cond) CHECK(cond)
#else
#define DCHECK(cond) ((void)sizeof(!(cond)))
#endif
#define UNREACHABLE() check_failed(__FILE__, __LINE__, "unreachable")

#endif
