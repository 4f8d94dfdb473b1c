// main.c - the program: a table of contents
// SPDX-License-Identifier: MIT
#include "base/base.h"

#include <errno.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include "base/file.h"
#include "cli/delaunay.h"
#include "cli/pipeline.h"
#include "cli/subcommand.h"

// Killed or out of time: leave no temporary behind.
static void on_signal(int sig)
{
  static const char late[] = "meshgen: error: stopped by -time_limit\n";
  static const char gone[] = "meshgen: error: a file became shorter while it was read\n";
  file_remove_temporaries();
  if (sig == SIGALRM || sig == SIGBUS) {
    const char *text = sig == SIGALRM ? late : gone;
    (void)!write(2, text, strlen(text));
    _exit(EXIT_ENVIRONMENT);
  }
  signal(sig, SIG_DFL);
  raise(sig);
}

static void set_limits(const Cli *c)
{
  static const int signals[] = {SIGINT, SIGTERM, SIGHUP, SIGALRM, SIGXCPU, SIGBUS};
  for (size_t i = 0; i < ARRAY_LEN(signals); i++) signal(signals[i], on_signal);
  signal(SIGPIPE, SIG_IGN); // a closed pipe is a write error like others,
  signal(SIGXFSZ, SIG_IGN); // and so is a file that may not grow
  if (c->max_memory > 0) {
    struct rlimit r = {(rlim_t)c->max_memory, (rlim_t)c->max_memory};
    setrlimit(RLIMIT_AS, &r);
  }
  if (c->time_limit > 0) {
    struct itimerval t = {.it_value = {.tv_sec = (time_t)c->time_limit,
                                       .tv_usec = (suseconds_t)(1e6 * (c->time_limit - (double)(time_t)c->time_limit)) + 1}};
    setitimer(ITIMER_REAL, &t, NULL);
  }
}

static ExitCode run(const Cli *c, Diag *diag)
{
  FILE *log = NULL;
  if (c->log && !(log = fopen(c->log, "w"))) {
    diag_error(diag, NO_LOC, "%s: %s", c->log, strerror(errno));
    return EXIT_ENVIRONMENT;
  }
  diag_set_log(diag, log);
  set_limits(c);
  ExitCode status = c->action == CMD_DELAUNAY ? delaunay_run(c, diag) : pipeline_run(c, diag);
  diag_set_log(diag, NULL);
  if (log) fclose(log);
  return status;
}

static ExitCode act(const Cli *c, Diag *diag)
{
  switch (c->action) {
  case CMD_HELP: help_print(stdout); return EXIT_GOOD;
  case CMD_HELP_OPTIONS: help_print_options(stdout, &c->options); return EXIT_GOOD;
  case CMD_LIST_FORMATS: help_print_formats(stdout); return EXIT_GOOD;
  case CMD_DUMP_MAN: help_print_man(stdout); return EXIT_GOOD;
  case CMD_VERSION: printf("%s\n", meshgen_version); return EXIT_GOOD;
  case CMD_INFO: printf("meshgen %s, compiled with %s\n", meshgen_version, __VERSION__); return EXIT_GOOD;
  case CMD_COMPLETION:
    if (help_print_completion(stdout, c->shell)) return EXIT_GOOD;
    diag_error(diag, NO_LOC, "no completion for '%s'; there is one for bash, zsh and fish", c->shell);
    return EXIT_USAGE;
  default: return run(c, diag);
  }
}

static bool terminal_has_color(void)
{
  const char *no_color = getenv("NO_COLOR"), *term = getenv("TERM");
  return !(no_color && no_color[0]) && isatty(2) && !(term && strcmp(term, "dumb") == 0);
}

static ExitCode run_command_line(int argc, char **argv, Diag *diag)
{
  Cli c;
  ExitCode status = cli_parse(&c, argc, argv, diag);
  diag_set_color(diag, c.color == 1 || (c.color == 2 && terminal_has_color()));
  diag_set_level(diag, c.options.General_Verbosity);
  diag_set_warnings_are_errors(diag, c.werror);
  if (status == EXIT_GOOD) status = act(&c, diag);
  if (status == EXIT_GOOD && diag_errors(diag)) status = EXIT_INPUT;
  cli_free(&c);
  return status;
}

int main(int argc, char **argv)
{
  Diag *diag = diag_new(true);
  diag_set_color(diag, terminal_has_color());
  int status = EXIT_USAGE;
  if (argc <= 1)
    help_print_usage(stderr), fputs("\nAll switches: meshgen -help\n", stderr);
  else if (!subcommand_run(argc, argv, diag, &status)) status = run_command_line(argc, argv, diag);
  diag_free(diag);
  if (fflush(stdout) != 0 && status == EXIT_GOOD) status = EXIT_ENVIRONMENT;
  return status;
}
