// function.c - the table of functions
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "script/function.h"

#include <math.h>

#include "base/str.h"

static double round_half_up(double x) { return floor(x + 0.5); }
static double step(double x) { return x < 0 ? 0 : 1; }
static double sign(double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; }
static double smaller(double a, double b) { return b < a ? b : a; }
static double larger(double a, double b) { return b > a ? b : a; }

#define ANY FUNCTION_ANY
static const FunctionRow rows[] = {
  {KW_Sin, FUNCTION_NUMBER, 1, 1, false, false, sin, NULL},
  {KW_Cos, FUNCTION_NUMBER, 1, 1, false, false, cos, NULL},
  {KW_Tan, FUNCTION_NUMBER, 1, 1, false, false, tan, NULL},
  {KW_Asin, FUNCTION_NUMBER, 1, 1, false, false, asin, NULL},
  {KW_Acos, FUNCTION_NUMBER, 1, 1, false, false, acos, NULL},
  {KW_Atan, FUNCTION_NUMBER, 1, 1, false, false, atan, NULL},
  {KW_Sinh, FUNCTION_NUMBER, 1, 1, false, false, sinh, NULL},
  {KW_Cosh, FUNCTION_NUMBER, 1, 1, false, false, cosh, NULL},
  {KW_Tanh, FUNCTION_NUMBER, 1, 1, false, false, tanh, NULL},
  {KW_Asinh, FUNCTION_NUMBER, 1, 1, false, false, asinh, NULL},
  {KW_Acosh, FUNCTION_NUMBER, 1, 1, false, false, acosh, NULL},
  {KW_Atanh, FUNCTION_NUMBER, 1, 1, false, false, atanh, NULL},
  {KW_Exp, FUNCTION_NUMBER, 1, 1, false, false, exp, NULL},
  {KW_Log, FUNCTION_NUMBER, 1, 1, false, false, log, NULL},
  {KW_Log10, FUNCTION_NUMBER, 1, 1, false, false, log10, NULL},
  {KW_Sqrt, FUNCTION_NUMBER, 1, 1, false, false, sqrt, NULL},
  {KW_Fabs, FUNCTION_SAME, 1, 1, false, false, fabs, NULL},
  {KW_Abs, FUNCTION_SAME, 1, 1, false, false, fabs, NULL},
  {KW_Floor, FUNCTION_NUMBER, 1, 1, false, false, floor, NULL},
  {KW_Ceil, FUNCTION_NUMBER, 1, 1, false, false, ceil, NULL},
  {KW_Round, FUNCTION_NUMBER, 1, 1, false, false, round_half_up, NULL},
  {KW_Sign, FUNCTION_NUMBER, 1, 1, false, false, sign, NULL},
  {KW_Step, FUNCTION_NUMBER, 1, 1, false, false, step, NULL},
  {KW_Rand, FUNCTION_NUMBER, 1, 1, false, false, NULL, NULL},
  {KW_Atan2, FUNCTION_NUMBER, 2, 2, false, false, NULL, atan2},
  {KW_Fmod, FUNCTION_NUMBER, 2, 2, false, false, NULL, fmod},
  {KW_Modulo, FUNCTION_NUMBER, 2, 2, false, false, NULL, fmod},
  {KW_Hypot, FUNCTION_NUMBER, 2, 2, false, false, NULL, hypot},
  {KW_Min, FUNCTION_NUMBER, 2, 2, false, false, NULL, smaller},
  {KW_Max, FUNCTION_NUMBER, 2, 2, false, false, NULL, larger},
  {KW_Exists, FUNCTION_NUMBER, 1, 1, true, false, NULL, NULL},
  {KW_GetForced, FUNCTION_NUMBER, 1, 2, true, false, NULL, NULL},
  {KW_FileExists, FUNCTION_NUMBER, 1, 1, false, false, NULL, NULL},
  {KW_GetNumber, FUNCTION_NUMBER, 1, 2, false, false, NULL, NULL},
  {KW_GetValue, FUNCTION_NUMBER, 2, 2, false, false, NULL, NULL},
  {KW_Find, FUNCTION_NUMBER, 2, 2, false, true, NULL, NULL},
  {KW_StrFind, FUNCTION_NUMBER, 2, 2, false, false, NULL, NULL},
  {KW_StrLen, FUNCTION_NUMBER, 1, 1, false, false, NULL, NULL},
  {KW_StrCmp, FUNCTION_NUMBER, 2, 2, false, false, NULL, NULL},
  {KW_TextAttributes, FUNCTION_NUMBER, 0, ANY, false, false, NULL, NULL},
  {KW_List, FUNCTION_LIST, 0, ANY, false, true, NULL, NULL},
  {KW_ListFromFile, FUNCTION_LIST, 1, 1, false, false, NULL, NULL},
  {KW_LinSpace, FUNCTION_LIST, 3, 3, false, false, NULL, NULL},
  {KW_LogSpace, FUNCTION_LIST, 3, 3, false, false, NULL, NULL},
  {KW_Unique, FUNCTION_LIST, 1, 1, false, true, NULL, NULL},
  {KW_Catenary, FUNCTION_LIST, 6, 6, false, false, NULL, NULL},
  {KW_Str, FUNCTION_TEXTS, 0, ANY, false, true, NULL, NULL},
  {KW_StrCat, FUNCTION_TEXT, 0, ANY, false, false, NULL, NULL},
  {KW_StrPrefix, FUNCTION_TEXT, 1, 1, false, false, NULL, NULL},
  {KW_StrRelative, FUNCTION_TEXT, 1, 1, false, false, NULL, NULL},
  {KW_StrReplace, FUNCTION_TEXT, 3, 3, false, false, NULL, NULL},
  {KW_StrSub, FUNCTION_TEXT, 2, 3, false, false, NULL, NULL},
  {KW_StrChoice, FUNCTION_TEXT, 3, 3, false, false, NULL, NULL},
  {KW_Sprintf, FUNCTION_TEXT, 1, ANY, false, false, NULL, NULL},
  {KW_UpperCase, FUNCTION_TEXT, 1, 1, false, false, NULL, NULL},
  {KW_LowerCase, FUNCTION_TEXT, 1, 1, false, false, NULL, NULL},
  {KW_LowerCaseIn, FUNCTION_TEXT, 1, 1, false, false, NULL, NULL},
  {KW_GetEnv, FUNCTION_TEXT, 1, 1, false, false, NULL, NULL},
  {KW_GetString, FUNCTION_TEXT, 1, 2, false, false, NULL, NULL},
  {KW_GetForcedStr, FUNCTION_TEXT, 1, 2, true, false, NULL, NULL},
  {KW_GetStringValue, FUNCTION_TEXT, 2, 2, false, false, NULL, NULL},
  {KW_NameToString, FUNCTION_TEXT, 1, 1, true, false, NULL, NULL},
  {KW_DirName, FUNCTION_TEXT, 1, 1, false, false, NULL, NULL},
  {KW_AbsolutePath, FUNCTION_TEXT, 1, 1, false, false, NULL, NULL},
  {KW_FixRelativePath, FUNCTION_TEXT, 1, 1, false, false, NULL, NULL},
  {KW_CurrentDirectory, FUNCTION_TEXT, 0, 0, false, false, NULL, NULL},
  {KW_CurrentFileName, FUNCTION_TEXT, 0, 0, false, false, NULL, NULL},
  {KW_Today, FUNCTION_TEXT, 0, 0, false, false, NULL, NULL},
  {KW_OnelabAction, FUNCTION_TEXT, 0, 0, false, false, NULL, NULL},
  {KW_GmshExecutableName, FUNCTION_TEXT, 0, 0, false, false, NULL, NULL},
};

const FunctionRow *function_find(uint32_t word)
{
  for (size_t i = 0; i < ARRAY_LEN(rows); i++)
    if (rows[i].word == word) return &rows[i];
  return NULL;
}

int function_index(const FunctionRow *f)
{
  return (int)(f - rows);
}

const FunctionRow *function_at(int index)
{
  return &rows[index];
}

const char *function_nearest(const char *word)
{
  static const char *const names[] = {
#define RESERVED(w) #w,
#define SOFT(w) #w,
#define SYNONYM(w, meaning) #w,
#include "script/keywords.def"
#undef RESERVED
#undef SOFT
#undef SYNONYM
  };
  return str_nearest(word, names, ARRAY_LEN(names));
}
