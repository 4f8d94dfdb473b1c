// msh2_part.c - elements of MSH 2.2 files of meshes in parts
// SPDX-License-Identifier: MIT
//
// After group and entity stand the number of parts, the element's own, and with a minus sign those that see
// it as a ghost cell.
#include "base/base.h"

#include "out/msh2_int.h"

// Item k of a run is copy k % copies of element k / copies; items are numbered from number.
typedef struct {
  const Selection *s;
  const Run *run;
  uint64_t number;
  const GhostCell *ghost; // those of the block
  size_t nghost;
} PartItems;

// The ghost cells of a block, which stand together.
static void find_ghosts(PartItems *t)
{
  const Ghosts *g = t->s->parts->ghosts;
  uint32_t block = (uint32_t)(t->run->block - t->s->mesh->block);
  size_t lo = 0, n = g ? g->cell.len : 0;
  while (n > 0) { // the first of the block or later
    size_t half = n / 2;
    bool before = g->cell.data[lo + half].block < block;
    lo += before ? half + 1 : 0;
    n = before ? n - half - 1 : half;
  }
  size_t end = lo;
  while (g && end < g->cell.len && g->cell.data[end].block == block) end++;
  t->ghost = g ? g->cell.data + lo : NULL;
  t->nghost = end - lo;
}

// Which of them is element i, or the first one after it.
static size_t ghost_from(const PartItems *t, size_t i)
{
  size_t lo = 0, n = t->nghost;
  while (n > 0) {
    size_t half = n / 2;
    bool before = t->ghost[lo + half].index < i;
    lo += before ? half + 1 : 0;
    n = before ? n - half - 1 : half;
  }
  return lo;
}

static const GhostCell *ghost_at(const PartItems *t, size_t *at, size_t i)
{
  while (*at < t->nghost && t->ghost[*at].index < i) ++*at;
  return *at < t->nghost && t->ghost[*at].index == i ? &t->ghost[*at] : NULL;
}

// An item: its element's nodes, the sign of its group included, part, and the ghosts it is in.
typedef struct {
  int physical;
  uint32_t part, nghost;
  const uint32_t *ghost;
  uint64_t node[ELEM_MAX_NODES];
} Item;

static void get_item(Item *item, const PartItems *t, size_t k, size_t *at)
{
  const Run *r = t->run;
  size_t i = k / (size_t)r->copies;
  const uint32_t *node = r->block->node + i * (size_t)r->nodes;
  const GhostCell *ghost = ghost_at(t, at, i);
  item->physical = physical_of(r, (int)(k % (size_t)r->copies));
  item->part = r->block->part[i];
  item->nghost = ghost ? ghost->n : 0;
  item->ghost = ghost ? t->s->parts->ghosts->part.data + ghost->first : NULL;
  for (int c = 0; c < r->nodes; c++)
    item->node[c] = t->s->number[node[item->physical < 0 ? r->reversed[c] : c]] + t->s->node0;
}

static char *put_elements(char *p, const void *ctx, size_t from, size_t to)
{
  const PartItems *t = ctx;
  const Run *r = t->run;
  size_t at = ghost_from(t, from / (size_t)r->copies);
  for (size_t k = from; k < to; k++) {
    Item item;
    get_item(&item, t, k, &at);
    p = put_u64(p, t->number + k);
    p = put_u64(put_char(p, ' '), r->block->type);
    p = put_u64(put_char(p, ' '), 4 + item.nghost);
    p = put_u64(put_char(p, ' '), (uint64_t)abs(item.physical));
    p = put_u64(put_char(p, ' '), (uint64_t)r->entity->tag);
    p = put_u64(put_char(p, ' '), 1 + item.nghost);
    p = put_u64(put_char(p, ' '), item.part);
    for (uint32_t g = 0; g < item.nghost; g++) p = put_u64((char *)memcpy(p, " -", 2) + 2, item.ghost[g]);
    for (int c = 0; c < r->nodes; c++) p = put_u64(put_char(p, ' '), item.node[c]);
    p = put_char(p, '\n');
  }
  return p;
}

static char *put32(char *p, int32_t v) { return (char *)memcpy(p, &v, sizeof v) + sizeof v; }

static char *put_binary_elements(char *p, const void *ctx, size_t from, size_t to)
{
  const PartItems *t = ctx;
  const Run *r = t->run;
  size_t at = ghost_from(t, from / (size_t)r->copies);
  for (size_t k = from; k < to; k++) {
    Item item;
    get_item(&item, t, k, &at);
    p = put32(p, (int32_t)(t->number + k));
    p = put32(p, abs(item.physical));
    p = put32(p, r->entity->tag);
    p = put32(p, (int32_t)(1 + item.nghost));
    p = put32(p, (int32_t)item.part);
    for (uint32_t g = 0; g < item.nghost; g++) p = put32(p, -(int32_t)item.ghost[g]);
    for (int c = 0; c < r->nodes; c++) p = put32(p, (int32_t)item.node[c]);
  }
  return p;
}

// Items from .. to-1, the number of ghosts not above `ghosts` in any.
static void write_items(Writer *w, PartItems *t, size_t from, size_t to, uint32_t ghosts, WriterPut put)
{
  enum { AT_ONCE = 4096 };
  size_t room = 22 * ((size_t)t->run->nodes + 8) + 12 * (size_t)ghosts;
  if (room <= AT_ONCE && from == 0) {
    writer_items(w, to, room, put, t);
    return;
  }
  char *item = mem_alloc(room);
  for (size_t k = from; k < to; k++) writer_bytes(w, item, (size_t)(put(item, t, k, k + 1) - item));
  free(item);
}

// In binary files elements of as many tags follow a header.
static void write_binary(Writer *w, PartItems *t)
{
  size_t n = t->run->block->n, copies = (size_t)t->run->copies, at = 0;
  for (size_t i = 0, j; i < n; i = j) {
    const GhostCell *ghost = ghost_at(t, &at, i), *next;
    uint32_t ghosts = ghost ? ghost->n : 0;
    for (j = i + 1; j < n && ((next = ghost_at(t, &at, j)) ? next->n : 0) == ghosts;) j++;
    const int32_t head[3] = {(int32_t)t->run->block->type, (int32_t)((j - i) * copies),
                             (int32_t)(4 + ghosts)};
    writer_bytes(w, head, sizeof head);
    write_items(w, t, i * copies, j * copies, ghosts, put_binary_elements);
  }
}

void msh2_part__write_run(Writer *w, const Selection *s, const Run *r, uint64_t number, bool binary)
{
  PartItems t = {.s = s, .run = r, .number = number};
  uint32_t most = 0;
  find_ghosts(&t);
  for (size_t i = 0; i < t.nghost; i++) most = MAX(most, t.ghost[i].n);
  if (binary)
    write_binary(w, &t);
  else
    write_items(w, &t, 0, r->block->n * (size_t)r->copies, most, put_elements);
}
