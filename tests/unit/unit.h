// unit.h - what every unit test includes first: cmocka, and TAP output for tests/run.sh
// SPDX-License-Identifier: MIT
#ifndef UNIT_H
#define UNIT_H

#include "base/base.h"

#include <setjmp.h>
#include <stdarg.h>

#ifdef __cplusplus
extern "C" {
#endif
#include <cmocka.h>
#ifdef __cplusplus
}
#endif

// Run a table of tests, printing TAP ("ok 1 - name"). Returns the number of failures, for main().
#define unit_run(tests) (cmocka_set_message_output(CM_OUTPUT_TAP), cmocka_run_group_tests(tests, NULL, NULL))

#endif
