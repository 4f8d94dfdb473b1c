// table.c - entities of one kind by tag; slots chained by a hash
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "model/model_int.h"

void table__init(Table *t, size_t size)
{
  *t = (Table){.size = size, .ordered = true};
}

void table__free(Table *t)
{
  for (size_t i = 0; i < t->chunks.len; i++) free(t->chunks.data[i]);
  vec_free(&t->chunks);
  vec_free(&t->vacant);
  vec_free(&t->dense);
  vec_free(&t->order);
  map_free(&t->sparse);
}

uint32_t table__find(const Table *t, int tag)
{
  if (tag < 0) return NONE;
  if ((size_t)tag < t->dense.len && t->dense.data[tag]) return t->dense.data[tag] - 1;
  return t->sparse.len ? map_get(&t->sparse, (uint64_t)tag) : NONE;
}

void *table__get(const Table *t, int tag)
{
  uint32_t s = table__find(t, tag);
  return s == NONE ? NULL : table__slot(t, s);
}

static int slot_tag(const Table *t, uint32_t s)
{
  int tag;
  memcpy(&tag, table__slot(t, s), sizeof tag);
  return tag;
}

static void index_tag(Table *t, int tag, uint32_t s)
{
  if ((size_t)tag >= t->dense.len && (size_t)tag < 4 * t->live + 4096) {
    size_t old = t->dense.len, want = MAX((size_t)tag + 1, MIN(2 * old, 4 * t->live + 4096));
    vec_resize(&t->dense, want);
    memset(t->dense.data + old, 0, (want - old) * sizeof *t->dense.data);
  }
  if ((size_t)tag < t->dense.len)
    t->dense.data[tag] = s + 1;
  else
    map_set(&t->sparse, (uint64_t)tag, s);
}

void *table__add(Table *t, int tag)
{
  uint32_t s;
  if (t->vacant.len) {
    s = vec_pop(&t->vacant);
  } else {
    s = t->used++;
    if (s % TABLE_CHUNK == 0) vec_push(&t->chunks, mem_alloc(TABLE_CHUNK * t->size));
  }
  void *item = table__slot(t, s);
  memset(item, 0, t->size);
  memcpy(item, &tag, sizeof tag);
  t->live++;
  index_tag(t, tag, s);
  if (t->ordered) {
    if (t->order.len && slot_tag(t, vec_last(&t->order)) > tag)
      t->ordered = false;
    else
      vec_push(&t->order, s);
  }
  return item;
}

void table__remove(Table *t, int tag)
{
  uint32_t s = table__find(t, tag);
  CHECK(s != NONE);
  if ((size_t)tag < t->dense.len && t->dense.data[tag])
    t->dense.data[tag] = 0;
  else
    map_remove(&t->sparse, (uint64_t)tag);
  int dead = DEAD_TAG;
  memcpy(table__slot(t, s), &dead, sizeof dead);
  vec_push(&t->vacant, s);
  t->live--;
  if (t->ordered && t->order.len && vec_last(&t->order) == s)
    (void)vec_pop(&t->order);
  else
    t->ordered = false;
}

typedef struct {
  int tag;
  uint32_t slot;
} TagSlot;

static int by_tag(const void *a, const void *b)
{
  const TagSlot *p = a, *q = b;
  return (p->tag > q->tag) - (p->tag < q->tag);
}

void table__sort(Table *t)
{
  if (t->ordered) return;
  Vec(TagSlot) all = {0};
  vec_reserve(&all, t->live);
  bool ascending = true;
  for (uint32_t s = 0; s < t->used; s++) {
    int tag = slot_tag(t, s);
    if (tag == DEAD_TAG) continue;
    if (all.len && vec_last(&all).tag > tag) ascending = false;
    TagSlot ts = {tag, s};
    vec_push(&all, ts);
  }
  if (!ascending && all.len) qsort(all.data, all.len, sizeof *all.data, by_tag);
  vec_resize(&t->order, all.len);
  for (size_t i = 0; i < all.len; i++) t->order.data[i] = all.data[i].slot;
  vec_free(&all);
  t->ordered = true;
}

void *table__at(const Table *t, size_t k)
{
  DCHECK(t->ordered && k < t->order.len);
  return table__slot(t, t->order.data[k]);
}

uint64_t hash__mix(uint64_t h, uint64_t v)
{
  h = (h ^ v) + 0x9e3779b97f4a7c15u; // the finalizer of splitmix64 between the words
  h = (h ^ h >> 30) * 0xbf58476d1ce4e5b9u;
  h = (h ^ h >> 27) * 0x94d049bb133111ebu;
  return h ^ h >> 31;
}

void chains__link(Chains *c, uint64_t hash, uint32_t slot)
{
  if (slot >= c->next.len) {
    size_t old = c->next.len;
    vec_resize(&c->next, MAX((size_t)slot + 1, old * 2));
    for (size_t i = old; i < c->next.len; i++) c->next.data[i] = NONE;
  }
  bool added;
  uint32_t *head = map_slot(&c->head, hash & ~(uint64_t)1, slot, &added);
  c->next.data[slot] = added ? NONE : *head;
  *head = slot;
}

void chains__unlink(Chains *c, uint64_t hash, uint32_t slot)
{
  hash &= ~(uint64_t)1;
  uint32_t head = map_get(&c->head, hash);
  if (head == slot) {
    if (c->next.data[slot] == NONE)
      map_remove(&c->head, hash);
    else
      map_set(&c->head, hash, c->next.data[slot]);
    return;
  }
  for (uint32_t s = head; s != NONE; s = c->next.data[s])
    if (c->next.data[s] == slot) {
      c->next.data[s] = c->next.data[slot];
      return;
    }
}

void chains__clear(Chains *c)
{
  map_free(&c->head);
  vec_free(&c->next);
  *c = (Chains){0};
}
