// batch.c - several inputs in one call: over the threads, one line of summary each, one exit status
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include "cli/batch.h"

#include <math.h>
#include <pthread.h>

#include "base/str.h"
#include "base/thread.h"
#include "cli/pipeline.h"

// What an input said, kept until its turn to be printed comes.
typedef struct {
  bool done;
  ExitCode status;
  double seconds;
  Diag *diag;
  char *said, *printed;  // messages; what goes to standard output
  size_t nsaid, nprinted;
  JobSummary summary;
} Item;

typedef struct {
  const Cli *cli;
  Diag *diag;
  Item *item;
  size_t printed, ended; // items printed so far: a beginning of the list; items that ended
  size_t good;
  ExitCode worst;
  double began;
  pthread_mutex_t lock;
} Batch;

static void print_summary(const Batch *b, const char *input, const Item *it)
{
  FILE *f = b->cli->json ? stderr : stdout;
  if (diag_level(b->diag) == LOG_SILENT) return;
  fprintf(f, "%s: ", input);
  if (it->status != EXIT_GOOD) fprintf(f, "failed, exit status %d\n", it->status);
  if (it->status != EXIT_GOOD) return;
  const JobSummary *s = &it->summary;
  if (s->known) {
    fprintf(f, "%zu nodes, %zu lines, %zu triangles, %zu quadrangles", s->nodes, s->lines, s->triangles, s->quads);
    if (isfinite(s->min_gamma)) fprintf(f, ", gamma from %.3f", s->min_gamma);
  } else {
    fputs("good", f);
  }
  fprintf(f, ", %.3f s\n", it->seconds);
}

static void print_item(Batch *b, size_t i)
{
  Item *it = &b->item[i];
  diag_absorb(b->diag, it->diag, it->said);
  if (it->nprinted) fwrite(it->printed, 1, it->nprinted, stdout);
  print_summary(b, b->cli->inputs.data[i], it);
  if (it->status == EXIT_GOOD)
    b->good++;
  else if (b->worst == EXIT_GOOD || it->status < b->worst)
    b->worst = it->status;
  free(it->said);
  free(it->printed);
}

static void run_item(void *ctx, size_t i, int worker)
{
  (void)worker;
  Batch *b = ctx;
  Item *it = &b->item[i];
  FILE *said = open_memstream(&it->said, &it->nsaid), *out = open_memstream(&it->printed, &it->nprinted);
  CHECK(said && out);
  it->diag = diag_sibling(b->diag, said);
  it->summary.min_gamma = NAN;
  double began = time_wall();
  it->status = pipeline_run_one(b->cli, b->cli->inputs.data[i], it->diag, 1, out, &it->summary);
  it->seconds = time_wall() - began;
  fclose(said);
  fclose(out);
  pthread_mutex_lock(&b->lock);
  it->done = true;
  b->ended++;
  for (; b->printed < b->cli->inputs.len && b->item[b->printed].done; b->printed++) print_item(b, b->printed);
  log_progress(b->diag, "batch", (double)b->ended, (double)b->cli->inputs.len, "inputs", b->began);
  pthread_mutex_unlock(&b->lock);
}

ExitCode batch_run(const Cli *c, Diag *diag)
{
  size_t n = c->inputs.len;
  Batch b = {.cli = c, .diag = diag, .item = mem_zalloc(n * sizeof(Item)), .began = time_wall()};
  pthread_mutex_init(&b.lock, NULL);
  thread_for(n, c->options.General_NumThreads, run_item, &b);
  log_progress_end(diag);
  if (diag_level(diag) != LOG_SILENT) {
    double t = time_wall() - b.began;
    fprintf(c->json ? stderr : stdout, "%zu inputs: %zu good, %zu failed, %.3f s\n", n, b.good, n - b.good, t);
  }
  pthread_mutex_destroy(&b.lock);
  free(b.item);
  return b.worst;
}
