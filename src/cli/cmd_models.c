/* cli/cmd_models.c - ambulo models: what is shipped, in the files' own words; ambulo new: a shipped
 * file to start from, whole, with its comments.
 *
 * A file that is named in one by its name alone (model: lower_body_21.yaml) is found from anywhere;
 * what comments say about models/FILE is said of the new file, or of the name alone. */
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "cli/command.h"
#include "cli/output.h"
#include "cli/shipped.h"

/* ----------------------------------------------------------------------- models */

static const char *const file_kinds[] = {"problem", "model", "sweep", "fit", "muscles", "table"};
static const char *const titles[] = {"problems (ambulo solve NAME)",
                                     "models (ambulo info NAME)",
                                     "sweeps (ambulo batch NAME -o DIR)",
                                     "fits (ambulo fit NAME -o DIR)",
                                     "muscles (ambulo muscles BODY MOTION --muscles NAME)",
                                     "tables that problems name"};
enum { FILE_KINDS = sizeof file_kinds / sizeof file_kinds[0], PATH = 4096 };

/* its name without ".yaml", under which it is found, too */
static int stem(const ambulo__cli_entry *entry) {
  const char *dot = strstr(entry->file, ".yaml");
  return (int)(dot ? (size_t)(dot - entry->file) : strlen(entry->file));
}

static void print_kind(const ambulo__cli_entry *list, int count, int kind, int names) {
  int printed = 0;
  for (int i = 0; i < count; i++) {
    if (strcmp(list[i].kind, file_kinds[kind]) != 0) continue;
    if (!names && printed++ == 0) printf("%s\n", titles[kind]);
    if (names)
      printf("%.*s\n", stem(&list[i]), list[i].file);
    else
      printf("  %-24.*s %s\n", stem(&list[i]), list[i].file, list[i].about);
  }
  if (printed > 0) printf("\n");
}

static int list_models(const ambulo__cli_input *input) {
  const char *wanted = input->argument_count ? input->arguments[0] : NULL;
  int only = -1, names = ambulo__cli_flag(input, "names");
  for (int k = 0; wanted && k < FILE_KINDS; k++)
    if (strcmp(wanted, file_kinds[k]) == 0) only = k;
  if (wanted && only < 0)
    return ambulo__cli_usage_error(
        "models", NULL, "unknown kind '%s'; expected problem, model, sweep, fit, muscles or table",
        wanted);
  ambulo__cli_entry *list = NULL;
  int count = ambulo__cli_catalogue(&list);
  if (count < 0) return ambulo_status_exit_code(AMBULO_E_IO);
  for (int k = 0; k < FILE_KINDS; k++)
    if (only < 0 || k == only) print_kind(list, count, k, names);
  if (!names && only < 0) printf("'ambulo new NAME > my.yaml' copies one to start from.\n");
  free(list);
  return 0;
}

static const ambulo__cli_option models_options[] = {
    {"names", 0, NULL, "print names only, one a line"},
};

const ambulo__cli_command ambulo__cli_models = {
    .name = "models",
    .arguments = "[problem|model|sweep|fit|muscles|table]",
    .summary = "list the shipped models and problems",
    .description =
        "Lists the shipped files with the first sentence of their comments. Every command finds\n"
        "them by name, with or without .yaml, unless a file here has that name; so do problems,\n"
        "sweeps and fits that name them. 'ambulo --models' prints their folder. AMBULO_MODELS in\n"
        "the environment names another folder.",
    .example = "ambulo models\nambulo models sweep\nambulo solve pendulum_swing -o swing",
    .options = models_options,
    .option_count = sizeof models_options / sizeof models_options[0],
    .minimum = 0,
    .maximum = 1,
    .run = list_models,
};

/* -------------------------------------------------------------------------- new */

typedef struct kind {
  const char *name, *file;
} kind;

/* the short names; every other shipped file has its own */
static const kind kinds[] = {
    {"walk", "walk.yaml"},
    {"run", "run.yaml"},
    {"stairs", "stairs_up.yaml"},
    {"turn", "walk_turn.yaml"},
    {"arms", "walk_whole_body.yaml"},
    {"device", "walk_ankle_exoskeleton.yaml"},
    {"load", "walk_backpack.yaml"},
    {"obstacle", "step_over.yaml"},
    {"jump", "jump.yaml"},
    {"squat", "squat.yaml"},
    {"reach", "reach_standing.yaml"},
    {"lift", "lift.yaml"},
    {"tracking", "walk_tracking.yaml"},
    {"free", "walk_free_cadence.yaml"},
    {"model", "lower_body_21.yaml"},
    {"body", "whole_body_29.yaml"},
    {"batch", "sweep_walk.yaml"},
    {"front", "front_walk.yaml"},
    {"fit", "fit_start.yaml"},
    {"inverse", "walk_tracking_angles.csv"},
};
enum { KINDS = sizeof kinds / sizeof kinds[0] };

/* -------------------------------------------------------------- which file */

static int list_kinds(int names) {
  for (int i = 0; i < KINDS && names; i++) printf("%s\n", kinds[i].name);
  if (names) return 0;
  printf("kinds (ambulo new KIND > my.yaml)\n");
  for (int i = 0; i < KINDS; i++) {
    char line[AMBULO__CLI_LINE];
    char *text = ambulo__cli_shipped_text(kinds[i].file);
    if (!text) return ambulo_status_exit_code(AMBULO_E_IO);
    ambulo__cli_first_sentence(text, line, sizeof line);
    printf("  %-10s %-28s %s\n", kinds[i].name, kinds[i].file, line);
    free(text);
  }
  printf("\nAny name of 'ambulo models' works, too.\n");
  return 0;
}

/* the shipped file of a word; NULL after a message */
static const char *file_of(const char *word, const ambulo__cli_entry *list, int count) {
  const char *names[KINDS];
  for (int i = 0; i < KINDS; i++) {
    names[i] = kinds[i].name;
    if (strcmp(word, kinds[i].name) == 0) return kinds[i].file;
  }
  for (int i = 0; i < count; i++) {
    size_t length = strcspn(list[i].file, ".");
    int stem = strlen(word) == length && strncmp(word, list[i].file, length) == 0;
    if (stem || strcmp(word, list[i].file) == 0) return list[i].file;
  }
  char hint[128];
  const char *nearest = ambulo__cli_nearest(word, names, KINDS);
  ambulo__cli_format(hint, sizeof hint, nearest ? "did you mean '%s'?" : "'ambulo new' lists them",
                     nearest);
  ambulo__cli_usage_error("new", hint, "unknown kind '%s'; expected a kind or a shipped file",
                          word);
  return NULL;
}

/* ------------------------------------------------------------- the new text */

/* where a name of a file ends */
static size_t name_length(const char *text) {
  return strspn(text, "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./");
}

/* models/FILE, of the file itself: its new name; of another: FILE. `file` NULL: as it is */
static int write_text(FILE *out, const char *text, const char *file, const char *name) {
  static const char folder[] = "models/";
  const char *from = text;
  for (const char *at = file ? strstr(text, folder) : NULL; at; at = strstr(at + 1, folder)) {
    const char *what = at + sizeof folder - 1;
    size_t length = name_length(what), own = strlen(file);
    if (length == 0 || (at > text && name_length(at - 1) > name_length(at))) continue;
    fwrite(from, 1, (size_t)(at - from), out);
    int itself = length >= own && strncmp(what, file, own) == 0;
    if (itself) fputs(name, out);
    from = itself ? what + own : what;
  }
  fputs(from, out);
  return !ferror(out);
}

static const char *base_of(const char *path) {
  const char *slash = strrchr(path, '/');
  return slash ? slash + 1 : path;
}

/* whole or not at all: a file beside it that takes its name */
static int write_file(const char *path, const char *text, const char *file, int force) {
  char other[PATH];
  struct stat there;
  if (!force && stat(path, &there) == 0) {
    ambulo__cli_error("E_IO", "--force overwrites it", "%s exists already", path);
    return ambulo_status_exit_code(AMBULO_E_IO);
  }
  ambulo__cli_format(other, sizeof other, "%s.%ld.part", path, (long)getpid());
  int descriptor = open(other, O_WRONLY | O_CREAT | O_EXCL, 0666);
  FILE *out = descriptor >= 0 ? fdopen(descriptor, "wb") : NULL;
  int good = out && write_text(out, text, file, base_of(path)) && fflush(out) == 0 &&
             fsync(descriptor) == 0;
  int fault = good ? 0 : errno;
  if (out && fclose(out) != 0 && good) good = 0, fault = errno;
  if (good && rename(other, path) != 0) good = 0, fault = errno;
  if (good) return 0;
  if (descriptor >= 0) (void)unlink(other);
  ambulo__cli_error("E_IO", NULL, "%s cannot be written: %s", path, strerror(fault));
  return ambulo_status_exit_code(AMBULO_E_IO);
}

/* A model's file as a problem at `output` (NULL: here) names it: as it is from here, its name alone
 * beside it, or else its whole path. */
static const char *model_from(const char *model, const char *output, char whole[PATH]) {
  size_t of_model = (size_t)(base_of(model) - model);
  size_t of_output = output ? (size_t)(base_of(output) - output) : 0;
  if (of_output == 0 || model[0] == '/') return model;
  if (of_model == of_output && strncmp(model, output, of_model) == 0) return model + of_model;
  return realpath(model, whole) ? whole : model;
}

/* a walk for a model that is there: its text, to be freed with ambulo_text_free, and the exit code
 */
static int walk_for(const ambulo__cli_input *input, const char *model, char **text) {
  char folder[PATH], whole[PATH];
  ambulo_walk_options options = ambulo_walk_options_default();
  static const char *const gaits[] = {"walk", "trot", "bound"};
  for (int i = 0; i < 3; i++)
    if (strcmp(input->arguments[0], gaits[i]) == 0) options.gait = gaits[i];
  if (!options.gait)
    return ambulo__cli_usage_error("new", NULL,
                                   "--for is of 'walk', 'trot' and 'bound' alone (got '%s')",
                                   input->arguments[0]);
  if (!ambulo__cli_number(input, "speed", 1e-3, 100.0, &options.speed) ||
      !ambulo__cli_number(input, "step-length", 1e-3, 100.0, &options.step_length))
    return ambulo_status_exit_code(AMBULO_E_ARGUMENT);
  if (ambulo__cli_shipped_folder(folder, sizeof folder)) options.shipped = folder;
  options.model = model_from(model, ambulo__cli_value(input, "output"), whole);
  ambulo_diagnostics *diagnostics = ambulo_diagnostics_create(NULL);
  ambulo_status status = ambulo_walk_for(model, &options, NULL, diagnostics, text);
  int code = ambulo__cli_diagnostics(diagnostics, status, model);
  ambulo_diagnostics_free(diagnostics);
  return code;
}

static int write_walk(const ambulo__cli_input *input, const char *model) {
  const char *path = ambulo__cli_value(input, "output");
  char *text = NULL;
  int code = walk_for(input, model, &text);
  if (code == 0 && path)
    code = write_file(path, text, NULL, ambulo__cli_flag(input, "force"));
  else if (code == 0)
    fputs(text, stdout);
  ambulo_text_free(text, NULL);
  return code;
}

static int write_new(const ambulo__cli_input *input) {
  const char *path = ambulo__cli_value(input, "output");
  const char *model = ambulo__cli_value(input, "for");
  if (input->argument_count == 0) return list_kinds(ambulo__cli_flag(input, "names"));
  if (model) return write_walk(input, model);
  ambulo__cli_entry *list = NULL;
  int count = ambulo__cli_catalogue(&list), code = 0;
  if (count < 0) return ambulo_status_exit_code(AMBULO_E_IO);
  const char *file = file_of(input->arguments[0], list, count);
  char *text = file ? ambulo__cli_shipped_text(file) : NULL;
  if (!file)
    code = ambulo_status_exit_code(AMBULO_E_ARGUMENT);
  else if (!text)
    code = ambulo_status_exit_code(AMBULO_E_IO);
  else if (path)
    code = write_file(path, text, file, ambulo__cli_flag(input, "force"));
  else
    write_text(stdout, text, file, strstr(file, ".csv") ? "my.csv" : "my.yaml");
  free(text);
  free(list);
  return code;
}

static const ambulo__cli_option new_options[] = {
    {"output", 'o', "FILE", "write it there (default: standard output)"},
    {"for", 0, "MODEL.yaml",
     "with 'walk': a problem in which this model walks; of four legs also "
     "with\n'trot' and 'bound'"},
    {"speed", 0, "M/S", "with --for: its speed (default: by the length of the legs)"},
    {"step-length", 0, "M", "with --for: its step (default: by legs and speed)"},
    {"force", 0, NULL, "replace a file that is there"},
    {"names", 0, NULL, "the names of the kinds, one a line"},
};

const ambulo__cli_command ambulo__cli_new = {
    .name = "new",
    .arguments = "[KIND]",
    .summary = "write a commented file to start from",
    .description =
        "Writes a shipped file with its comments; it solves as it is. KIND is one of the kinds "
        "that\n"
        "'ambulo new' lists, or any name that 'ambulo models' lists. The models and tables that "
        "it\n"
        "names are found from anywhere; a file of that name beside it takes precedence. Comments\n"
        "call the file by the name of -o, or my.yaml.\n"
        "With --for, the walk is made for a model of two or four legs, such as 'ambulo import' "
        "gives: its\n"
        "speed, steps, weights and rows follow from mass, legs and feet.",
    .example = "ambulo new\nambulo new walk > my.yaml\nambulo new walk --for robot.yaml -o "
               "robot_walk.yaml\nambulo new device -o exoskeleton.yaml",
    .options = new_options,
    .option_count = sizeof new_options / sizeof new_options[0],
    .minimum = 0,
    .maximum = 1,
    .words = "ambulo new --names",
    .run = write_new,
};
