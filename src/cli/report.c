// report.c - what was made and how good it is: text for people, JSON for programs, conditions for CI
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "cli/report.h"

#include <math.h>

#include "base/json.h"
#include "base/number.h"
#include "mesh/mesh_hash.h"
#include "mesh/mesh_index.h"
#include "mesh/mesh_shapes.h"
#include "mesh/mesh_stats.h"
#include "mesh/partition_stats.h"

typedef struct {
  const Job *job;
  MeshStats stats;
  MeshShapes shapes; // empty where nothing asks for it
  MeshIndices indices;
  PartitionStats parts; // n = 0 if the mesh is not partitioned
  char hash[MESH_HASH_TEXT];
} Report;

// ---- the numbers that -require knows and JSON lists -----------------------------------------------------------------
typedef struct {
  const char *name;
  double value;
} Figure;
enum { FIGURES = 56 };

static double smallest_angle(const MeshStats *s) { return s->angle.n ? s->angle.min : NAN; }

static size_t figures(const Report *r, Figure f[FIGURES])
{
  const MeshStats *s = &r->stats;
  const double none = NAN;
  const MeshShapes *k = r->shapes.triangles ? &r->shapes : NULL;
  const PartitionStats *p = r->parts.n ? &r->parts : NULL;
  const Figure list[] = {
      {"nodes", (double)s->nodes},
      {"elements", (double)(s->triangles + s->quads)},
      {"points", (double)s->points},
      {"lines", (double)s->lines},
      {"triangles", (double)s->triangles},
      {"quads", (double)s->quads},
      {"length", s->length},
      {"area", s->area},
      {"min_gamma", s->gamma.n ? s->gamma.min : none},
      {"p5_gamma", s->gamma.n ? s->gamma.p5 : none},
      {"mean_gamma", s->gamma.n ? s->gamma.mean : none},
      {"min_eta", s->eta.n ? s->eta.min : none},
      {"p5_eta", s->eta.n ? s->eta.p5 : none},
      {"mean_eta", s->eta.n ? s->eta.mean : none},
      {"min_jacobian", s->jacobian.n ? s->jacobian.min : none},
      {"p5_jacobian", s->jacobian.n ? s->jacobian.p5 : none},
      {"mean_jacobian", s->jacobian.n ? s->jacobian.mean : none},
      {"min_angle", smallest_angle(s)},
      {"max_angle", s->angle.n ? s->angle_max : none},
      {"min_edge", s->edge_min},
      {"max_edge", s->edge_max},
      {"tau", s->tau},
      {"irregular", (double)s->irregular},
      {"index_sum", r->indices.faces ? 0.25 * (double)r->indices.sum4 : none},
      {"euler", r->indices.faces ? (double)r->indices.euler : none},
      {"matching_seconds", r->job->matching_seconds > 0 ? r->job->matching_seconds : none},
      {"min_kappa1", k ? k->min[0] : none},
      {"mean_kappa1", k ? k->mean[0] : none},
      {"min_kappa2", k ? k->min[1] : none},
      {"mean_kappa2", k ? k->mean[1] : none},
      {"min_kappa3", k ? k->min[2] : none},
      {"mean_kappa3", k ? k->mean[2] : none},
      {"min_kappa4", k ? k->min[3] : none},
      {"mean_kappa4", k ? k->mean[3] : none},
      {"min_kappa5", k ? k->min[4] : none},
      {"mean_kappa5", k ? k->mean[4] : none},
      {"max_principle_edges", k ? (double)k->obtuse : none},
      {"crossing_rounds", r->job->curves ? r->job->curves->rounds : none},
      {"halved_edges", r->job->curves ? r->job->curves->nsplit : none},
      {"parts", p ? p->n : none},
      {"part_imbalance", p ? p->imbalance : none},
      {"cut_edges", p ? (double)p->cut : none},
      {"part_neighbours", p ? p->neighbours : none},
      {"part_pieces", p ? p->pieces : none},
      {"warnings", diag_warnings(r->job->diag)},
  };
  CHECK(ARRAY_LEN(list) <= FIGURES);
  memcpy(f, list, sizeof list);
  return ARRAY_LEN(list);
}

// "min_gamma>0.3": name, one of < <= > >= = ==, number.
static ExitCode check_condition(const Report *r, const char *text, Diag *diag)
{
  size_t n = strcspn(text, "<>=");
  const char *op = text + n;
  size_t k = strspn(op, "<>=");
  const char *end = text + strlen(text), *num = op + k;
  while (n && text[n - 1] == ' ') n--;
  while (*num == ' ') num++;
  double want = 0;
  Figure f[FIGURES];
  size_t count = figures(r, f), i = 0;
  while (i < count && !(strlen(f[i].name) == n && memcmp(f[i].name, text, n) == 0)) i++;
  if (!k || k > 2 || num == end || number_read(num, end, &want) != end || i == count) {
    diag_error(diag, NO_LOC, "-require \"%s\": not a condition such as \"min_gamma>0.3\" on a figure of the report", text);
    return EXIT_USAGE;
  }
  double v = f[i].value;
  if (isnan(v)) {
    diag_error(diag, NO_LOC, "-require \"%s\" does not hold: this mesh has no such figure", text);
    return EXIT_INPUT;
  }
  bool equal = op[k - 1] == '=';
  bool holds = op[0] == '<' ? v < want || (equal && v == want) : op[0] == '>' ? v > want || (equal && v == want) : v == want;
  if (holds) return EXIT_GOOD;
  diag_error(diag, NO_LOC, "-require \"%s\" does not hold: %s is %g", text, f[i].name, v);
  return EXIT_INPUT;
}

// Was the option changed, and can it change a result?
static bool option_differs(const Options *o, const OptRow *row)
{
  if (row->kind != OPT_NUM && row->kind != OPT_INT && row->kind != OPT_BOOL) return false;
  return strcmp(row->key, "NumThreads") != 0 && options_get_number(o, row) != row->def;
}

// ---- text ---------------------------------------------------------------------------------------------------------------
static void text_time(FILE *f, const Stats *s)
{
  fprintf(f, "  %-16s %9s %9s %10s\n", "stage", "wall s", "cpu s", "peak MB");
  for (int i = 0; i < s->n; i++)
    fprintf(f, "  %*s%-*s %9.4f %9.4f %10.1f\n", 2 * s->stage[i].depth, "", 16 - 2 * s->stage[i].depth, s->stage[i].name,
            s->stage[i].wall, s->stage[i].cpu, (double)s->stage[i].peak / 1048576);
}

static void text_measure(FILE *f, const char *name, const MeasureStats *m)
{
  if (m->n) fprintf(f, "  %-16s min %.4f   5%% %.4f   mean %.4f\n", name, m->min, m->p5, m->mean);
}

static const char *const dim_name[] = {"point", "curve", "surface"};

static void text_groups(FILE *f, const MeshStats *s)
{
  if (!s->group.len) return;
  fprintf(f, "  %-8s %6s  %-24s %10s  %s\n", "group", "tag", "name", "elements", "length or area");
  for (size_t i = 0; i < s->group.len; i++) {
    const PartStats *p = &s->group.data[i];
    fprintf(f, "  %-8s %6d  %-24s %10zu", dim_name[p->dim], p->tag, p->name ? p->name : "", p->elements);
    if (p->dim) fprintf(f, "  %.9g", p->size);
    fputc('\n', f);
  }
}

static void text_options(FILE *f, const Options *o)
{
  size_t n;
  const OptRow *rows = options_rows(&n);
  for (size_t i = 0; i < n; i++)
    if (option_differs(o, &rows[i]))
      fprintf(f, "  %-16s %s.%s = %.9g\n", "option", rows[i].category, rows[i].key, options_get_number(o, &rows[i]));
}

static void text_entities(FILE *f, const MeshStats *s)
{
  fprintf(f, "  %-8s %6s %10s  %s\n", "entity", "tag", "elements", "length or area");
  for (size_t i = 0; i < s->entity.len; i++) {
    const PartStats *p = &s->entity.data[i];
    fprintf(f, "  %-8s %6d %10zu", dim_name[p->dim], p->tag, p->elements);
    if (p->dim) fprintf(f, "  %.9g", p->size);
    fputc('\n', f);
  }
}

// One row per bin that is not empty, with a bar.
static void text_histogram(FILE *f, const char *name, const MeasureStats *m)
{
  enum { BAR = 50 };
  size_t most = 1;
  for (int i = 0; i < STATS_BINS; i++) most = MAX(most, m->bin[i]);
  for (int i = 0; i < STATS_BINS && m->n; i++) {
    if (!m->bin[i]) continue;
    int bar = (int)((BAR * m->bin[i] + most - 1) / most);
    fprintf(f, "  %-11s %5.4g to %5.4g %10zu %.*s\n", name, m->range * i / STATS_BINS, m->range * (i + 1) / STATS_BINS, m->bin[i], bar,
            "##################################################");
  }
}

static void text_worst(FILE *f, const MeshStats *s, size_t n)
{
  for (size_t i = 0; i < MIN(n, s->nworst); i++) {
    const WorstElement *w = &s->worst[i];
    fprintf(f, "  %-16s %s %llu of surface %d at (%.6g, %.6g), %.4f\n", i ? "" : "worst element", elem_name(w->type),
            (unsigned long long)w->element, w->tag, w->at.x, w->at.y, w->value);
  }
}

static void text_shapes(FILE *f, const MeshShapes *k)
{
  if (!k->triangles) return;
  for (int i = 0; i < SHAPES; i++) fprintf(f, "  kappa %-10d min %.4f   mean %.4f\n", i + 1, k->min[i], k->mean[i]);
  fprintf(f, "  %-16s %zu of %zu edges with opposite angles of more than 180 degrees together\n", "max principle", k->obtuse,
          k->inner_edges);
}

static void text_indices(FILE *f, const MeshIndices *s)
{
  if (!s->faces) return;
  fprintf(f, "  %-16s", "indices (quads)");
  for (int i = INDEX_MOST; i >= INDEX_LEAST; i--) {
    size_t in = s->inside[i - INDEX_LEAST], on = s->boundary[i - INDEX_LEAST];
    if (i && in + on) fprintf(f, " %+g: %zu inside, %zu on boundaries;", 0.25 * i, in, on);
  }
  fprintf(f, " sum %g, Euler characteristic %ld\n", 0.25 * (double)s->sum4, s->euler);
}

static void text_parts(FILE *f, const PartitionStats *s, bool full)
{
  if (!s->n) return;
  fprintf(f, "  %-16s %u of %zu to %zu elements, %.2f %% over the mean, %zu edges cut, %u neighbours at most%s\n",
          "parts", s->n, s->least, s->most, 100 * s->imbalance, s->cut, s->neighbours,
          s->pieces > s->n ? "" : ", each in one piece");
  if (s->pieces > s->n) fprintf(f, "  %-16s %u parts are in %u pieces\n", "", s->n, s->pieces);
  if (!full) return;
  fprintf(f, "  %-8s %10s %10s %10s %10s %10s\n", "part", "elements", "cut edges", "ghosts", "neighbours",
          "pieces");
  for (uint32_t k = 0; k < s->n; k++) {
    const PartInfo *p = &s->part[k];
    fprintf(f, "  %-8u %10zu %10zu %10zu %10u %10u\n", k + 1, p->elements, p->cut, p->ghosts, p->neighbours,
            p->pieces);
  }
}

static void print_text(const Report *r, FILE *f)
{
  const MeshStats *s = &r->stats;
  bool full = r->job->cli->full_report;
  if (full) fprintf(f, "meshgen %s\n", meshgen_version);
  fprintf(f, "%s: %zu nodes, %zu lines, %zu triangles, %zu quadrangles\n", r->job->input, s->nodes, s->lines,
          s->triangles, s->quads);
  if (full) text_options(f, &r->job->options);
  if (full) text_entities(f, s);
  text_groups(f, s);
  text_measure(f, "gamma", &s->gamma);
  text_measure(f, "eta (quads)", &s->eta);
  text_measure(f, "scaled Jacobian", &s->jacobian);
  if (s->angle.n) fprintf(f, "  %-16s %.2f to %.2f degrees\n", "angles", s->angle.min, s->angle_max);
  text_worst(f, s, full ? STATS_WORST : 1);
  if (full) text_shapes(f, &r->shapes);
  if (full) text_histogram(f, "gamma", &s->gamma);
  if (full) text_histogram(f, "eta", &s->eta);
  if (full) text_histogram(f, "angle", &s->angle);
  text_indices(f, &r->indices);
  text_parts(f, &r->parts, full);
  if (r->job->matching_seconds > 0) fprintf(f, "  %-16s %.4f s\n", "matching", r->job->matching_seconds);
  if (isfinite(s->tau)) fprintf(f, "  %-16s %.4f\n", "efficiency tau", s->tau);
  fprintf(f, "  %-16s %s\n", "hash", r->hash);
  text_time(f, &r->job->stats);
}

// ---- JSON ---------------------------------------------------------------------------------------------------------------
static void json_vec(Json *j, const char *name, Vec3 p)
{
  json_begin(j, name, '[');
  json_number(j, NULL, p.x);
  json_number(j, NULL, p.y);
  json_number(j, NULL, p.z);
  json_end(j, ']');
}

static void json_options(Json *j, const Options *o)
{
  size_t n;
  const OptRow *rows = options_rows(&n);
  json_begin(j, "options", '{');
  for (size_t i = 0; i < n; i++) {
    const OptRow *row = &rows[i];
    if (!option_differs(o, row)) continue;
    char name[128];
    snprintf(name, sizeof name, "%s.%s", row->category, row->key);
    json_number(j, name, options_get_number(o, row));
  }
  json_end(j, '}');
}

static void json_parts(Json *j, const char *title, const PartStats *p, size_t n, bool named)
{
  json_begin(j, title, '[');
  for (size_t i = 0; i < n; i++) {
    json_begin(j, NULL, '{');
    json_integer(j, "dim", p[i].dim);
    json_integer(j, "tag", p[i].tag);
    if (named) json_string(j, "name", p[i].name);
    json_integer(j, "elements", (long long)p[i].elements);
    if (p[i].dim == 1) json_number(j, "length", p[i].size);
    if (p[i].dim == 2) json_number(j, "area", p[i].size);
    json_end(j, '}');
  }
  json_end(j, ']');
}

static void json_histogram(Json *j, const char *name, const MeasureStats *m)
{
  if (!m->n) return;
  json_begin(j, name, '{');
  json_number(j, "from", 0);
  json_number(j, "to", m->range);
  json_begin(j, "count", '[');
  for (int i = 0; i < STATS_BINS; i++) json_integer(j, NULL, (long long)m->bin[i]);
  json_end(j, ']');
  json_end(j, '}');
}

static void json_indices(Json *j, const MeshIndices *s)
{
  json_begin(j, "indices", '[');
  for (int i = INDEX_LEAST; i <= INDEX_MOST; i++) {
    size_t in = s->inside[i - INDEX_LEAST], on = s->boundary[i - INDEX_LEAST];
    if (!in && !on) continue;
    json_begin(j, NULL, '{');
    json_number(j, "index", 0.25 * i);
    json_integer(j, "inside", (long long)in);
    json_integer(j, "boundary", (long long)on);
    json_end(j, '}');
  }
  json_end(j, ']');
}

static void json_worst(Json *j, const MeshStats *s)
{
  json_begin(j, "worst", '[');
  for (size_t i = 0; i < s->nworst; i++) {
    json_begin(j, NULL, '{');
    json_string(j, "type", elem_name(s->worst[i].type));
    json_integer(j, "element", (long long)s->worst[i].element);
    json_integer(j, "surface", s->worst[i].tag);
    json_vec(j, "center", s->worst[i].at);
    json_number(j, "quality", s->worst[i].value);
    json_end(j, '}');
  }
  json_end(j, ']');
}

static void json_messages(Json *j, const Diag *d)
{
  json_begin(j, "messages", '[');
  for (size_t i = 0; i < diag_count(d); i++) {
    static const char *const kinds[] = {"note", "warning", "error"};
    const DiagMessage *m = diag_get(d, i);
    json_begin(j, NULL, '{');
    json_string(j, "kind", kinds[m->kind]);
    if (m->loc.line) {
      json_string(j, "file", diag_file_name(d, m->loc.file));
      json_integer(j, "line", m->loc.line);
      json_integer(j, "column", m->loc.col);
    }
    json_string(j, "text", m->text);
    json_end(j, '}');
  }
  json_end(j, ']');
}

static void json_stages(Json *j, const Stats *s)
{
  json_begin(j, "stages", '[');
  for (int i = 0; i < s->n; i++) {
    json_begin(j, NULL, '{');
    json_string(j, "name", s->stage[i].name);
    json_integer(j, "depth", s->stage[i].depth);
    json_number(j, "wall_seconds", s->stage[i].wall);
    json_number(j, "cpu_seconds", s->stage[i].cpu);
    json_integer(j, "peak_bytes", (long long)s->stage[i].peak);
    json_end(j, '}');
  }
  json_end(j, ']');
}

static void json_partition(Json *j, const PartitionStats *s)
{
  json_begin(j, "partition", '[');
  for (uint32_t k = 0; k < s->n; k++) {
    const PartInfo *p = &s->part[k];
    json_begin(j, NULL, '{');
    json_integer(j, "part", k + 1);
    json_integer(j, "lines", (long long)p->lines);
    json_integer(j, "triangles", (long long)p->triangles);
    json_integer(j, "quads", (long long)p->quads);
    json_integer(j, "cut_edges", (long long)p->cut);
    json_integer(j, "ghosts", (long long)p->ghosts);
    json_integer(j, "neighbours", p->neighbours);
    json_integer(j, "pieces", p->pieces);
    json_end(j, '}');
  }
  json_end(j, ']');
}

// What every report begins with, whether there is a mesh or not.
static void json_head(Json *j, const Job *job, ExitCode status)
{
  json_begin(j, NULL, '{');
  json_integer(j, "report_version", REPORT_VERSION);
  json_string(j, "meshgen", meshgen_version);
  json_string(j, "input", job->input);
  json_integer(j, "exit_status", status);
  json_options(j, &job->options);
}

static void json_tail(Json *j, const Job *job, FILE *f)
{
  json_stages(j, &job->stats);
  json_messages(j, job->diag);
  json_end(j, '}');
  fprintf(f, "%s\n", str_text(&j->out));
  str_free(&j->out);
}

static void json_conditions(Json *j, const Report *r, const ExitCode *verdict)
{
  const Cli *c = r->job->cli;
  json_begin(j, "require", '[');
  for (size_t i = 0; i < c->require.len; i++) {
    json_begin(j, NULL, '{');
    json_string(j, "condition", c->require.data[i]);
    json_bool(j, "holds", verdict[i] == EXIT_GOOD);
    json_end(j, '}');
  }
  json_end(j, ']');
}

static void print_json(const Report *r, ExitCode status, const ExitCode *verdict, FILE *f)
{
  const MeshStats *s = &r->stats;
  Json j = {0};
  json_head(&j, r->job, status);
  Figure list[FIGURES];
  size_t n = figures(r, list);
  json_begin(&j, "mesh", '{');
  for (size_t i = 0; i < n; i++) json_number(&j, list[i].name, list[i].value);
  json_integer(&j, "order", s->order);
  json_vec(&j, "box_min", s->lo);
  json_vec(&j, "box_max", s->hi);
  json_string(&j, "hash", r->hash);
  json_end(&j, '}');
  json_conditions(&j, r, verdict);
  json_parts(&j, "groups", s->group.data, s->group.len, true);
  json_parts(&j, "entities", s->entity.data, s->entity.len, false);
  json_begin(&j, "histograms", '{');
  json_histogram(&j, "gamma", &s->gamma);
  json_histogram(&j, "eta", &s->eta);
  json_histogram(&j, "angle", &s->angle);
  json_end(&j, '}');
  json_indices(&j, &r->indices);
  json_worst(&j, s);
  json_partition(&j, &r->parts);
  json_tail(&j, r->job, f);
}

void report_failure(const Job *job, ExitCode status, FILE *f)
{
  Json j = {0};
  json_head(&j, job, status);
  json_string(&j, "mesh", NULL);
  json_tail(&j, job, f);
}

static void summarize(const Report *r, JobSummary *to)
{
  const MeshStats *s = &r->stats;
  *to = (JobSummary){true, s->nodes, s->lines, s->triangles, s->quads, s->gamma.n ? s->gamma.min : NAN};
}

ExitCode report_print(Job *j, const double *node_size, FILE *f)
{
  Report r = {.job = j};
  const Cli *c = j->cli;
  diag_flush(j->diag);
  mesh_stats_make(&r.stats, j->mesh, node_size);
  if (c->json || c->full_report || c->require.len || c->report) mesh_indices_make(&r.indices, j->mesh);
  if (c->json || c->full_report || c->require.len) mesh_shapes_make(&r.shapes, j->mesh);
  if (j->mesh->nparts) partition_stats_make(&r.parts, j->mesh);
  MeshHash h = mesh_hash(j->mesh, j->options.Mesh_SaveAll);
  mesh_hash_print(h.full, r.hash);
  ExitCode status = EXIT_GOOD, *verdict = mem_alloc(c->require.len * sizeof *verdict);
  for (size_t i = 0; i < c->require.len; i++) {
    verdict[i] = check_condition(&r, c->require.data[i], j->diag);
    if (verdict[i] != EXIT_GOOD && status != EXIT_USAGE) status = verdict[i];
  }
  if (j->summary) summarize(&r, j->summary);
  if (c->json)
    print_json(&r, status, verdict, f);
  else if (c->report && !j->summary && diag_level(j->diag) > LOG_SILENT)
    print_text(&r, f);
  j->reported = true;
  free(verdict);
  mesh_stats_free(&r.stats);
  if (r.parts.n) partition_stats_free(&r.parts);
  return status;
}
