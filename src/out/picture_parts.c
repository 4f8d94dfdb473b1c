// picture_parts.c - parts in colours that differ between neighbours, and the edges between them
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "mesh/edge_uses.h"
#include "mesh/part_nodes.h"
#include "out/picture_int.h"

// A color for each part (index part - 1) that no neighbour of lower number has, or fewest have, and of those
// the one least used. The caller frees.
static uint8_t *choose_colors(const Mesh *m)
{
  PartNodes nodes;
  part_nodes_make(&nodes, m);
  uint8_t *color = mem_zalloc(m->nparts);
  uint32_t(*taken)[PICTURE_COLORS] = mem_zalloc(m->nparts * sizeof *taken); // how often, by lower neighbours
  Vec(uint64_t) pair = {0}; // of neighbours, the lower first; some several times
  for (size_t i = 0; i < nodes.list.len; i += 1 + nodes.list.data[i])
    for (uint32_t a = 1; a <= nodes.list.data[i]; a++)
      for (uint32_t b = a + 1; b <= nodes.list.data[i]; b++)
        vec_push(&pair, (uint64_t)(nodes.list.data[i + a] - 1) << 32 | (nodes.list.data[i + b] - 1));
  uint32_t *first = mem_alloc(m->nparts * sizeof *first), *next = mem_alloc(pair.len * sizeof *next);
  memset(first, 0xff, m->nparts * sizeof *first);
  for (size_t k = pair.len; k-- > 0;) {
    next[k] = first[pair.data[k] >> 32];
    first[pair.data[k] >> 32] = (uint32_t)k;
  }
  uint32_t used[PICTURE_COLORS] = {0};
  for (uint32_t part = 0; part < m->nparts; part++) {
    const uint32_t *t = taken[part];
    int best = 0;
    for (int c = 1; c < PICTURE_COLORS; c++)
      if (t[c] < t[best] || (t[c] == t[best] && used[c] < used[best])) best = c;
    color[part] = (uint8_t)best;
    used[best]++;
    for (uint32_t k = first[part]; k != NONE; k = next[k]) taken[(uint32_t)pair.data[k]][color[part]]++;
  }
  free(first);
  free(next);
  vec_free(&pair);
  free(taken);
  part_nodes_free(&nodes);
  return color;
}

void picture__fill_by_part(Picture *p)
{
  const Mesh *m = p->mesh;
  uint8_t *color = choose_colors(m);
  for (int c = 0; c < PICTURE_COLORS; c++) {
    picture__begin_polygons(p);
    for (size_t b = 0; b < m->nblock; b++)
      for (size_t i = 0; elem_dim(m->block[b].type) == 2 && i < m->block[b].n; i++)
        if (color[m->block[b].part[i] - 1] == c) picture__push_element(p, &m->block[b], i);
    picture__fill(p, picture__face_colors[c], false);
  }
  free(color);
}

static uint32_t part_at(const Mesh *m, const ElemIds *ids, uint32_t elem)
{
  uint32_t b = elem_ids_block(ids, m, elem);
  return m->block[b].part[elem - ids->base[b]];
}

void picture__draw_seams(Picture *p)
{
  const Mesh *m = p->mesh;
  ElemIds ids;
  EdgeUses uses;
  elem_ids_make(&ids, m);
  edge_uses_make(&uses, m, &ids);
  vec_clear(&p->pts);
  for (size_t i = 0, j; i < uses.n; i = j) {
    j = edge_uses_end(&uses, i);
    size_t k = i;
    while (k < j && uses.use[k].elem < ids.surface0) k++;
    if (j - k < 2 || part_at(m, &ids, uses.use[k].elem) == part_at(m, &ids, uses.use[j - 1].elem)) continue;
    const double *a = p->xy + 2 * (size_t)uses.use[i].lower, *b = p->xy + 2 * (size_t)uses.use[i].upper;
    for (int c = 0; c < 2; c++) vec_push(&p->pts, a[c]);
    for (int c = 0; c < 2; c++) vec_push(&p->pts, b[c]);
  }
  canvas_segments(p->canvas, ink, 2.2, p->pts.data, p->pts.len / 4);
  edge_uses_free(&uses);
  elem_ids_free(&ids);
}

void picture__legend_parts(Picture *p)
{
  const Mesh *m = p->mesh;
  uint8_t *color = choose_colors(m);
  size_t *count = mem_zalloc(m->nparts * sizeof *count), left_out = 0;
  for (size_t b = 0; b < m->nblock; b++)
    for (size_t i = 0; elem_dim(m->block[b].type) == 2 && i < m->block[b].n; i++)
      count[m->block[b].part[i] - 1]++;
  canvas_text(p->canvas, ink, p->legend_x, p->y + 20, 14, 0, true, "Parts");
  p->y += 24;
  for (uint32_t k = 0; k < m->nparts; k++) {
    char line[64], elements[40];
    picture__print_count(elements, sizeof elements, count[k], "element");
    snprintf(line, sizeof line, "%u: %s", k + 1, elements);
    if (!picture__legend_row(p, 2, picture__face_colors[color[k]], line)) left_out++;
  }
  if (left_out) {
    char line[60];
    snprintf(line, sizeof line, "and %zu more", left_out);
    picture__legend_text(p, gray, 13, false, line);
  }
  p->y += 14;
  free(color);
  free(count);
}
