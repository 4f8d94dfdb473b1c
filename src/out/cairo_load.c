// cairo_load.c - the functions of cairo that pictures are drawn with, loaded when one is drawn
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "out/cairo_load.h"

#include <dlfcn.h>

typedef struct {
  const char *name;
  size_t at; // of its pointer in Cairo
} Entry;

static const Entry entry[] = {
#define CAIRO_ENTRY(name) {"cairo_" #name, offsetof(Cairo, name)},
    CAIRO_FUNCTIONS(CAIRO_ENTRY)
#undef CAIRO_ENTRY
};

bool cairo_load(Cairo *to)
{
  void *library = dlopen("libcairo.so.2", RTLD_LAZY | RTLD_LOCAL);
  for (size_t i = 0; library && i < ARRAY_LEN(entry); i++) {
    void *function = dlsym(library, entry[i].name);
    if (!function) return false;
    memcpy((char *)to + entry[i].at, &function, sizeof function);
  }
  return library != NULL;
}
