/* cli/main.c - the program: finds the command, runs it, and makes sure its output arrived.
 *
 * Reading order: main.c, command.h, args.c, body.h, cmd_solve.c, output.h, summary.h; the other
 * commands alike.
 */
#include <signal.h>
#include <stdio.h>
#include <string.h>

#include "cli/command.h"
#include "cli/output.h"
#include "cli/program.h"
#include "cli/shipped.h"

static const ambulo__cli_command *const commands[] = {
    &ambulo__cli_solve,   &ambulo__cli_evaluate, &ambulo__cli_check,    &ambulo__cli_info,
    &ambulo__cli_inverse, &ambulo__cli_muscles,  &ambulo__cli_compare,  &ambulo__cli_batch,
    &ambulo__cli_collect, &ambulo__cli_fit,      &ambulo__cli_report,   &ambulo__cli_models,
    &ambulo__cli_new,     &ambulo__cli_import,   &ambulo__cli_retarget, &ambulo__cli_draw,
    &ambulo__cli_film,    &ambulo__cli_export,
};
enum { COMMAND_COUNT = sizeof commands / sizeof commands[0] };

static void print_version(void) {
  ambulo_versions versions;
  ambulo_versions_get(&versions);
  printf("ambulo %s\n", versions.ambulo);
  printf("engine %s, NLopt %s, libyaml %s, %s, instruction set %s\n", versions.engine,
         versions.nlopt, versions.libyaml, versions.blas, versions.instruction_set);
}

static int print_models(void) {
  char folder[4096];
  if (ambulo__cli_shipped_folder(folder, sizeof folder)) {
    puts(folder);
    return 0;
  }
  ambulo__cli_error("E_IO", "'make install' installs them in share/ambulo/models",
                    "the shipped models are not found beside the program");
  return ambulo_status_exit_code(AMBULO_E_IO);
}

static int unknown_command(const char *word) {
  const char *names[COMMAND_COUNT];
  char hint[64];
  for (int i = 0; i < COMMAND_COUNT; i++) names[i] = commands[i]->name;
  const char *nearest = ambulo__cli_nearest(word, names, COMMAND_COUNT);
  if (nearest) ambulo__cli_format(hint, sizeof hint, "did you mean '%s'?", nearest);
  return ambulo__cli_usage_error(NULL, nearest ? hint : NULL, "unknown %s '%s'",
                                 word[0] == '-' ? "option" : "command", word);
}

/* "--man COMMAND", "--completion SHELL": what `make install` puts beside the program */
static int print_generated(const char *option, const char *word) {
  if (!strcmp(option, "--completion"))
    return ambulo__cli_print_completion(word, commands, COMMAND_COUNT);
  if (!word) {
    ambulo__cli_print_man_overview(commands, COMMAND_COUNT);
    return 0;
  }
  for (int i = 0; i < COMMAND_COUNT; i++) {
    if (strcmp(word, commands[i]->name) != 0) continue;
    ambulo__cli_print_man(commands[i]);
    return 0;
  }
  return unknown_command(word);
}

/* the overview, or the page of a command */
static int print_help(const char *word) {
  if (!word) ambulo__cli_print_overview(commands, COMMAND_COUNT);
  for (int i = 0; word && i < COMMAND_COUNT; i++) {
    if (strcmp(word, commands[i]->name) != 0) continue;
    ambulo__cli_print_help(commands[i]);
    return 0;
  }
  return word ? unknown_command(word) : 0;
}

static int dispatch(int argc, char **argv) {
  if (argc < 2) return ambulo__cli_usage_error(NULL, NULL, "no command given");
  const char *word = argv[1];
  if (!strcmp(word, "--help") || !strcmp(word, "-h") || !strcmp(word, "help"))
    return argc > 2 && (!strcmp(argv[2], "--man") || !strcmp(argv[2], "--completion"))
               ? print_generated(argv[2], argc > 3 ? argv[3] : NULL)
               : print_help(argc > 2 ? argv[2] : NULL);
  if (!strcmp(word, "--version") || !strcmp(word, "version")) {
    print_version();
    return 0;
  }
  if (!strcmp(word, "--models")) return print_models();
  for (int i = 0; i < COMMAND_COUNT; i++) {
    if (strcmp(word, commands[i]->name) != 0) continue;
    return ambulo__cli_blas_fits() ? ambulo__cli_run(commands[i], argc, argv)
                                   : ambulo_status_exit_code(AMBULO_E_MEMORY);
  }
  return unknown_command(word);
}

int main(int argc, char **argv) {
  if (!ambulo__cli_become_worker()) return 128 + SIGTERM;
  ambulo__cli_guard_streams();
  if (!ambulo__cli_worker_fits()) return ambulo_status_exit_code(AMBULO_E_IO);
  ambulo__cli_shipped_announce();
  ambulo__cli_single_threaded_blas(argv);
  /* a closed pipe and a file size limit show up as failed writes, so that files are whole */
  signal(SIGPIPE, SIG_IGN);
  signal(SIGXFSZ, SIG_IGN);
  return ambulo__cli_finish(dispatch(argc, argv));
}
