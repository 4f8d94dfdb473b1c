// vtu_read.c - reader of VTK XML unstructured grids (.vtu) in every encoding; vtu.c says what the arrays mean
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <math.h>
#include <strings.h>
#include <zlib.h>

#include "base/str.h"
#include "out/cells.h"
#include "out/out_int.h"

typedef Vec(unsigned char) Bytes;

typedef struct {
  Scan *s;
  Import *im;
  Cells c;
  Vec(int64_t) more[8];    // CellEntityIds2 ... 9
  const char *appended, *appended_end; // after the underscore
  bool base64, compressed, wide; // of appended data, of all data, of headers
  bool swap;
} Reader;

typedef struct {
  const char *name, *from, *to; // name of the tag; its attributes
  size_t len;
  bool closing, empty;
} Tag;

// The next tag; false at the end. Comments and declarations are stepped over.
static bool next_tag(Scan *s, Tag *t)
{
  for (;;) {
    const char *p = memchr(s->p, '<', scan_left(s));
    if (!p) return false;
    const char *q = memchr(p, '>', (size_t)(s->end - p));
    if (!q) return false;
    s->p = q + 1;
    if (p[1] == '?' || p[1] == '!') continue;
    t->closing = p[1] == '/';
    t->name = p + 1 + t->closing;
    t->len = strcspn(t->name, " \t\r\n/>");
    t->from = t->name + t->len;
    t->to = q;
    t->empty = q[-1] == '/';
    return true;
  }
}

static bool tag_is(const Tag *t, const char *name) { return t->len == strlen(name) && memcmp(t->name, name, t->len) == 0; }

static void append_unescaped(Str *out, const char *p, const char *end)
{
  static const struct { const char *code; char c; } codes[] = {{"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}};
  while (p < end) {
    size_t i = 0;
    while (i < ARRAY_LEN(codes) && strncmp(p, codes[i].code, strlen(codes[i].code)) != 0) i++;
    str_char(out, i < ARRAY_LEN(codes) ? codes[i].c : *p);
    p += i < ARRAY_LEN(codes) ? strlen(codes[i].code) : 1;
  }
}

// Value of an attribute into *out; false if it is not there.
static bool attribute(const Tag *t, const char *key, Str *out)
{
  size_t n = strlen(key);
  str_clear(out);
  for (const char *p = t->from; p + n + 2 < t->to; p++) {
    if (((unsigned char)p[-1] > ' ' && p != t->from) || strncmp(p, key, n) != 0 || p[n] != '=' || (p[n + 1] != '"' && p[n + 1] != '\'')) continue;
    const char *end = memchr(p + n + 2, p[n + 1], (size_t)(t->to - p - (ptrdiff_t)n - 2));
    if (!end) return false;
    append_unescaped(out, p + n + 2, end);
    return true;
  }
  return false;
}

static int64_t attribute_int(const Tag *t, const char *key, int64_t missing)
{
  Str v = {0};
  int64_t n = missing;
  if (attribute(t, key, &v)) number_read_i64(str_text(&v), str_text(&v) + v.len, &n);
  str_free(&v);
  return n;
}

// Decode base64 from p until padding ends a group or something else comes; at most `most` bytes. Returns where it stopped.
static const char *decode_base64(const char *p, const char *end, size_t most, Bytes *out)
{
  uint32_t acc = 0;
  int bits = 0, digits = 0;
  for (; p < end && out->len < most; p++) {
    char ch = *p;
    int v = ch >= 'A' && ch <= 'Z' ? ch - 'A' : ch >= 'a' && ch <= 'z' ? ch - 'a' + 26 : ch >= '0' && ch <= '9' ? ch - '0' + 52
            : ch == '+' ? 62 : ch == '/' ? 63 : -1;
    if ((unsigned char)ch <= ' ') continue;
    if (v < 0) break;
    acc = acc << 6 | (uint32_t)v;
    bits += 6;
    digits++;
    if (bits >= 8) {
      bits -= 8;
      vec_push(out, (unsigned char)(acc >> bits));
    }
  }
  // Step over the rest of the group of four digits.
  while (p < end && digits % 4 && (*p == '=' || (unsigned char)*p > ' ') && *p != '<') {
    p++;
    digits++;
  }
  return p;
}

static uint64_t header_word(const Reader *r, const unsigned char *p)
{
  uint64_t v = 0;
  uint32_t u = 0;
  memcpy(r->wide ? (void *)&v : (void *)&u, p, r->wide ? 8 : 4);
  if (!r->wide) return r->swap ? __builtin_bswap32(u) : u;
  return r->swap ? __builtin_bswap64(v) : v;
}

// Inflate blocks into out; the caller knows `data`, which begins after the header.
static void inflate_blocks(Reader *r, const unsigned char *head, size_t blocks, const unsigned char *data, size_t len, Bytes *out)
{
  size_t word = r->wide ? 8 : 4;
  uint64_t size = header_word(r, head + word), last = header_word(r, head + 2 * word);
  for (size_t b = 0; b < blocks && !r->s->failed; b++) {
    uint64_t packed = header_word(r, head + (3 + b) * word), full = b + 1 == blocks && last ? last : size;
    // zlib never packs better than 1 to 1032
    if (packed > len || full > packed * 1100 + 64) {
      scan_error(r->s, "a compressed block does not fit in the data");
      return;
    }
    vec_reserve(out, out->len + full + 1);
    uLongf room = full;
    if (uncompress(out->data + out->len, &room, data, packed) != Z_OK || room != full)
      scan_error(r->s, "a compressed block is damaged");
    else
      out->len += room;
    data += packed;
    len -= packed;
  }
}

// The bytes of an array that is not text: [p, end) holds it, in base64 or raw.
static void decode_array(Reader *r, const char *p, const char *end, bool base64, Bytes *out)
{
  size_t word = r->wide ? 8 : 4, head = r->compressed ? 3 * word : word;
  Bytes first = {0}, rest = {0};
  while (base64 && p < end && (unsigned char)*p <= ' ') p++;
  if (base64)
    decode_base64(p, end, head, &first);
  else
    for (size_t i = 0; i < head && p + i < end; i++) vec_push(&first, (unsigned char)p[i]);
  if (first.len < head) {
    scan_error(r->s, "an array ends within its header");
  } else if (!r->compressed) {
    uint64_t n = header_word(r, first.data);
    if (base64) {
      decode_base64(p, end, MIN((size_t)n, (size_t)(end - p)) + head, &rest); // header and data are one piece
      if (rest.len < head || rest.len - head < n) scan_error(r->s, "an array of %llu bytes is cut off", (unsigned long long)n);
    } else if (n > (uint64_t)(end - p) - head) {
      scan_error(r->s, "an array of %llu bytes is cut off", (unsigned long long)n);
    }
    if (!r->s->failed && n) {
      vec_resize(out, n);
      memcpy(out->data, base64 ? (const char *)rest.data + head : p + head, n);
    }
  } else {
    uint64_t blocks = header_word(r, first.data);
    if (blocks > (uint64_t)(end - p) / word) {
      scan_error(r->s, "%llu compressed blocks do not fit in the file", (unsigned long long)blocks);
    } else if (base64) { // the header is a piece of its own
      head = (3 + blocks) * word;
      vec_clear(&first);
      const char *q = decode_base64(p, end, head, &first);
      if (blocks) decode_base64(q, end, SIZE_MAX, &rest);
      if (first.len < head) scan_error(r->s, "an array ends within its header");
      else inflate_blocks(r, first.data, blocks, rest.data, rest.len, out);
    } else {
      head = (3 + blocks) * word;
      if (head > (size_t)(end - p)) scan_error(r->s, "an array ends within its header");
      else inflate_blocks(r, (const unsigned char *)p, blocks, (const unsigned char *)p + head, (size_t)(end - p) - head, out);
    }
  }
  vec_free(&first);
  vec_free(&rest);
}

static int type_size(const char *type, bool *real, bool *sign)
{
  const char *digits = type + strcspn(type, "0123456789");
  *real = strncasecmp(type, "Float", 5) == 0;
  *sign = type[0] == 'I' || type[0] == 'i';
  int bits = strcmp(digits, "8") == 0 ? 8 : strcmp(digits, "16") == 0 ? 16 : strcmp(digits, "32") == 0 ? 32 : strcmp(digits, "64") == 0 ? 64 : 0;
  return bits / 8;
}

typedef Vec(int64_t) Ints;

static void convert(Reader *r, const Bytes *b, int size, bool real, bool sign, Ints *ints, DoubleVec *reals)
{
  size_t n = b->len / (size_t)size;
  if (ints) vec_reserve(ints, ints->len + n);
  if (reals) vec_reserve(reals, reals->len + n);
  for (size_t i = 0; i < n; i++) {
    unsigned char v[8] = {0};
    for (int k = 0; k < size; k++) v[k] = b->data[i * (size_t)size + (size_t)(r->swap ? size - 1 - k : k)];
    uint64_t u;
    memcpy(&u, v, 8);
    int64_t s = sign ? (int64_t)(u << (64 - 8 * size)) >> (64 - 8 * size) : (int64_t)u;
    double d = (double)s;
    float f;
    if (real && size == 8) memcpy(&d, v, 8);
    if (real && size == 4) {
      memcpy(&f, v, 4);
      d = (double)f;
    }
    if (ints) vec_push(ints, real ? (fabs(d) < 1e15 ? (int64_t)d : 0) : s);
    if (reals) vec_push(reals, d);
  }
}

static void read_text(Reader *r, const char *end, Ints *ints, DoubleVec *reals)
{
  Scan sub = *r->s;
  sub.end = end;
  for (scan_space(&sub); sub.p < sub.end && !sub.failed; scan_space(&sub)) {
    double v = scan_double(&sub, "a number");
    if (reals) vec_push(reals, v);
    if (ints) vec_push(ints, fabs(v) < 1e15 ? (int64_t)v : 0);
  }
  r->s->failed = sub.failed;
}

// The array of a <DataArray> tag, which r->s stands behind.
static void read_array(Reader *r, const Tag *t, Ints *ints, DoubleVec *reals)
{
  Str v = {0};
  bool real, sign;
  attribute(t, "type", &v);
  int size = type_size(str_text(&v), &real, &sign);
  attribute(t, "format", &v);
  const char *format = str_text(&v);
  const char *end = memchr(r->s->p, '<', scan_left(r->s));
  if (!end) end = r->s->end;
  Bytes bytes = {0};
  if (!size || (real && size < 4)) {
    scan_error(r->s, "an array of a type that is not read");
  } else if (strcmp(format, "ascii") == 0) {
    read_text(r, end, ints, reals);
  } else if (strcmp(format, "binary") == 0) {
    decode_array(r, r->s->p, end, true, &bytes);
  } else if (strcmp(format, "appended") == 0 && r->appended) {
    int64_t offset = attribute_int(t, "offset", -1);
    if (offset < 0 || offset > r->appended_end - r->appended)
      scan_error(r->s, "an array at offset %lld, which the file does not have", (long long)offset);
    else
      decode_array(r, r->appended + offset, r->appended_end, r->base64, &bytes);
  } else {
    scan_error(r->s, "an array of format '%s'", format);
  }
  if (!r->s->failed && bytes.len) convert(r, &bytes, size, real, sign, ints, reals);
  vec_free(&bytes);
  str_free(&v);
}

// Offsets count from 0 and lack the first one.
static void read_offsets(Reader *r, const Tag *t)
{
  Ints v = {0};
  read_array(r, t, &v, NULL);
  vec_push(&r->c.offset, 0);
  for (size_t i = 0; i < v.len; i++) vec_push(&r->c.offset, v.data[i]);
  vec_free(&v);
}

#define AS_INTS(v) ((Ints *)(void *)(v))

static void read_data_array(Reader *r, const Tag *t, const Tag *within)
{
  Str name = {0};
  attribute(t, "Name", &name);
  const char *n = str_text(&name);
  if (tag_is(within, "Points") && !r->c.point.len)
    read_array(r, t, NULL, &r->c.point);
  else if (tag_is(within, "Cells") && strcmp(n, "connectivity") == 0)
    read_array(r, t, AS_INTS(&r->c.connectivity), NULL);
  else if (tag_is(within, "Cells") && strcmp(n, "offsets") == 0 && !r->c.offset.len)
    read_offsets(r, t);
  else if (tag_is(within, "Cells") && strcmp(n, "types") == 0)
    read_array(r, t, AS_INTS(&r->c.type), NULL);
  else if (tag_is(within, "CellData") && cells_array_kind(n) == 1 && !r->c.group.len)
    read_array(r, t, AS_INTS(&r->c.group), NULL);
  else if (tag_is(within, "CellData") && cells_array_kind(n) == 2 && !r->c.entity.len)
    read_array(r, t, AS_INTS(&r->c.entity), NULL);
  else if (tag_is(within, "CellData") && cells_array_kind(n) == 3 && !r->c.part.len)
    read_array(r, t, AS_INTS(&r->c.part), NULL);
  else if (tag_is(within, "CellData") && strncmp(n, "CellEntityIds", 13) == 0 && n[13] >= '2' && n[13] <= '9' && !n[14])
    read_array(r, t, AS_INTS(&r->more[n[13] - '2']), NULL);
  else if (tag_is(within, "FieldData")) {
    Ints v = {0};
    Str type = {0};
    attribute(t, "type", &type);
    if (strcmp(str_text(&type), "String") != 0) read_array(r, t, &v, NULL);
    if (v.len == 2 && v.data[0] > 0 && v.data[0] <= INT32_MAX && v.data[1] >= 0 && v.data[1] <= 2)
      import_group(r->im, (int)v.data[1], (int)v.data[0], n);
    vec_free(&v);
    str_free(&type);
  }
  str_free(&name);
}

static void read_file_tag(Reader *r, const Tag *t)
{
  Str v = {0};
  if (attribute(t, "type", &v) && strcmp(str_text(&v), "UnstructuredGrid") != 0)
    scan_error(r->s, "VTK data of type '%s' are not read (UnstructuredGrid is)", str_text(&v));
  r->swap = attribute(t, "byte_order", &v) && strcmp(str_text(&v), "BigEndian") == 0;
  r->wide = attribute(t, "header_type", &v) && strcmp(str_text(&v), "UInt64") == 0;
  r->compressed = attribute(t, "compressor", &v) && v.len;
  if (r->compressed && strcmp(str_text(&v), "vtkZLibDataCompressor") != 0) scan_error(r->s, "compressor '%s' is not read", str_text(&v));
  str_free(&v);
}

static void find_appended(Reader *r)
{
  Scan s = *r->s;
  const char *at = memmem(s.p, scan_left(&s), "<AppendedData", 13);
  Tag t;
  if (!at) return;
  s.p = at;
  if (!next_tag(&s, &t)) return;
  Str v = {0};
  r->base64 = attribute(&t, "encoding", &v) && strcmp(str_text(&v), "base64") == 0;
  str_free(&v);
  const char *under = memchr(s.p, '_', scan_left(&s));
  if (!under) return;
  r->appended = under + 1;
  r->appended_end = s.end;
}

// Elements of several groups are given once for each.
static void import_more(Reader *r, Cells *copy, size_t which)
{
  Ints *more = AS_INTS(&r->more[which]);
  if (r->s->failed || more->len != r->c.type.len) return;
  for (size_t i = 0; i < more->len; i++) {
    if (more->data[i] <= 0) continue;
    for (int64_t k = r->c.offset.data[i]; k < r->c.offset.data[i + 1]; k++) vec_push(&copy->connectivity, r->c.connectivity.data[k]);
    vec_push(&copy->offset, (int64_t)copy->connectivity.len);
    vec_push(&copy->type, r->c.type.data[i]);
    vec_push(&copy->group, more->data[i]);
    vec_push(&copy->entity, i < r->c.entity.len ? r->c.entity.data[i] : 0);
    if (i < r->c.part.len) vec_push(&copy->part, r->c.part.data[i]);
  }
}

static bool offsets_sound(const Reader *r)
{
  if (r->c.offset.len != r->c.type.len + 1) return false;
  for (size_t i = 0; i + 1 < r->c.offset.len; i++)
    if (r->c.offset.data[i] < 0 || r->c.offset.data[i + 1] < r->c.offset.data[i] ||
        (uint64_t)r->c.offset.data[i + 1] > r->c.connectivity.len)
      return false;
  return true;
}

Mesh *vtu__read(Scan s)
{
  Import im;
  Reader r = {.s = &s, .im = &im};
  Tag t, within = {.name = "", .len = 0};
  bool file = false;
  size_t pieces = 0;
  import_begin(&im, &s);
  while (!s.failed && next_tag(&s, &t)) {
    if (tag_is(&t, "AppendedData")) break;
    if (tag_is(&t, "VTKFile") && !t.closing) {
      file = true;
      read_file_tag(&r, &t);
      find_appended(&r);
    } else if (tag_is(&t, "Piece") && !t.closing) {
      if (pieces++) scan_error(&s, "a file of several pieces is not read");
    } else if (tag_is(&t, "DataArray") && !t.closing)
      read_data_array(&r, &t, &within);
    else if (!t.empty && !t.closing)
      within = t;
  }
  if (!s.failed && !file) scan_error(&s, "this is no VTK XML file");
  if (!s.failed && !offsets_sound(&r)) scan_error(&s, "the cells' arrays do not agree");
  Cells copy = {0};
  vec_push(&copy.offset, 0);
  for (size_t k = 0; k < ARRAY_LEN(r.more); k++) import_more(&r, &copy, k);
  if (!s.failed) cells_import(&r.c, &im);
  if (!s.failed && copy.type.len) cells_import(&copy, &im); // no points: those of the first call are meant
  cells_free(&r.c);
  cells_free(&copy);
  for (size_t k = 0; k < ARRAY_LEN(r.more); k++) vec_free(&r.more[k]);
  return import_finish(&im);
}
