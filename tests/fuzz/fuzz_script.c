// fuzz_script.c - any bytes are a script: no crash, no hang, no writing, bounded memory
// SPDX-License-Identifier: MIT
//
// With clang: CONFIG=fuzz and -fsanitize=fuzzer. Without, tests/unit/test_script_fuzz.c runs it over mutations of scripts.
#include "base/base.h"

#include "model/model_edit.h"
#include "script/script.h"
#include "size/field.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static bool refuse(void *ctx, const char *path)
{
  (void)ctx;
  (void)path;
  return false;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
  Model *model = model_new();
  Options options;
  options_init(&options);
  FieldSet *fields = fields_new();
  Diag *diag = diag_new(false);
  ScriptHost host = {.may_write = refuse};
  Script *s = script_new(model, &options, fields, diag, &host);
  script_run_text(s, "fuzz", (const char *)data, size);
  model_prepare(model, 1e-8, diag);
  script_free(s);
  diag_free(diag);
  fields_free(fields);
  options_free(&options);
  model_free(model);
  return 0;
}
