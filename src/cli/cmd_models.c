/* cli/cmd_models.c - ambulo models: what is shipped, in the files' own words. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "cli/catalogue.h"
#include "cli/commands.h"
#include "cli/output.h"

static const char *const kinds[] = {"problem", "model", "sweep", "fit", "table"};
static const char *const titles[] = {"problems (ambulo solve NAME)", "models (ambulo info NAME)",
                                     "sweeps (ambulo batch NAME -o DIR)",
                                     "fits (ambulo fit NAME -o DIR)", "tables that problems name"};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

/* its name without ".yaml", under which it is found, too */
static int stem(const ambulo__cli_entry *entry) {
  const char *dot = strstr(entry->file, ".yaml");
  return (int)(dot ? (size_t)(dot - entry->file) : strlen(entry->file));
}

static void print_kind(const ambulo__cli_entry *list, int count, int kind, int names) {
  int printed = 0;
  for (int i = 0; i < count; i++) {
    if (strcmp(list[i].kind, kinds[kind]) != 0) continue;
    if (!names && printed++ == 0) printf("%s\n", titles[kind]);
    if (names)
      printf("%.*s\n", stem(&list[i]), list[i].file);
    else
      printf("  %-24.*s %s\n", stem(&list[i]), list[i].file, list[i].about);
  }
  if (printed > 0) printf("\n");
}

static int run(const ambulo__cli_input *input) {
  const char *wanted = input->argument_count ? input->arguments[0] : NULL;
  int only = -1, names = ambulo__cli_flag(input, "names");
  for (int k = 0; wanted && k < KINDS; k++)
    if (strcmp(wanted, kinds[k]) == 0) only = k;
  if (wanted && only < 0)
    return ambulo__cli_usage_error(
        "models", NULL, "unknown kind '%s'; expected problem, model, sweep, fit or table", wanted);
  ambulo__cli_entry *list = NULL;
  int count = ambulo__cli_catalogue(&list);
  if (count < 0) return ambulo_status_exit_code(AMBULO_E_IO);
  for (int k = 0; k < KINDS; k++)
    if (only < 0 || k == only) print_kind(list, count, k, names);
  if (!names && only < 0) printf("'ambulo new NAME > my.yaml' copies one to start from.\n");
  free(list);
  return 0;
}

static const ambulo__cli_option options[] = {
    {"names", 0, NULL, "names alone, one a line"},
};

const ambulo__cli_command ambulo__cli_models = {
    .name = "models",
    .arguments = "[problem|model|sweep|fit|table]",
    .summary = "list the shipped models and problems",
    .description =
        "Lists the files that come with the program, each with the first sentence of its own\n"
        "comment. Every command takes their names from anywhere, with or without .yaml, where no\n"
        "file here is called so; problems, sweeps and fits find them, too. 'ambulo --models' "
        "names\n"
        "their folder; the environment's AMBULO_MODELS, if set, is another one.",
    .example = "ambulo models\nambulo models sweep\nambulo solve pendulum_swing -o swing",
    .options = options,
    .option_count = sizeof options / sizeof options[0],
    .minimum = 0,
    .maximum = 1,
    .run = run,
};
