/* cli/args.c - command lines: --name value, --name=value, -o value, -ovalue, -- ends options. */
#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/guard.h"
#include "cli/command.h"
#include "cli/output.h"
#include "cli/shipped.h"

/* ------------------------------------------------------------- nearest word */

enum { LONGEST_WORD = 40 };

static int smallest(int a, int b, int c) {
  int least = a < b ? a : b;
  return least < c ? least : c;
}

/* Levenshtein distance, one row at a time */
static int edit_distance(const char *a, const char *b) {
  int row[LONGEST_WORD + 1];
  int length = (int)strlen(b);
  if (length > LONGEST_WORD) return LONGEST_WORD;
  for (int j = 0; j <= length; j++) row[j] = j;
  for (int i = 1; a[i - 1]; i++) {
    int diagonal = row[0];
    row[0] = i;
    for (int j = 1; j <= length; j++) {
      int replaced = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = smallest(replaced, row[j] + 1, row[j - 1] + 1);
    }
  }
  return row[length];
}

const char *ambulo__cli_nearest(const char *word, const char *const *words, int count) {
  size_t length = strlen(word);
  if (length == 0 || length > LONGEST_WORD) return NULL;
  int best = (int)(length + 2) / 3 + 1;
  const char *nearest = NULL;
  for (int i = 0; i < count; i++) {
    int distance = edit_distance(word, words[i]);
    if (distance >= best) continue;
    best = distance;
    nearest = words[i];
  }
  return nearest;
}

/* ------------------------------------------------------------------ queries */

const char *const *ambulo__cli_values(const ambulo__cli_input *input, const char *name,
                                      int *count) {
  int first = 0;
  *count = 0;
  for (int i = 0; i < input->given_count; i++) {
    if (strcmp(input->command->options[input->options[i]].name, name) != 0) continue;
    if ((*count)++ == 0) first = i;
  }
  return input->values + first;
}

const char *ambulo__cli_value(const ambulo__cli_input *input, const char *name) {
  int count;
  const char *const *values = ambulo__cli_values(input, name, &count);
  return count ? values[count - 1] : NULL;
}

int ambulo__cli_flag(const ambulo__cli_input *input, const char *name) {
  int count;
  (void)ambulo__cli_values(input, name, &count);
  return count > 0;
}

const char *ambulo__cli_next_choice(const char **text, int *length) {
  while (**text) {
    const char *word = *text + strspn(*text, "[|]");
    size_t letters = strcspn(word, "|]"), small = 0;
    while (islower((unsigned char)word[small])) small++;
    *text = word + letters;
    *length = (int)letters;
    if (letters > 0 && small == letters) return word;
  }
  return NULL;
}

/* place of a word among the choices of a value; -1: it is none of them */
static int find_choice(const char *choices, const char *word) {
  int length, index = 0;
  for (const char *c; (c = ambulo__cli_next_choice(&choices, &length)); index++)
    if (strlen(word) == (size_t)length && strncmp(c, word, strlen(word)) == 0) return index;
  return -1;
}

int ambulo__cli_choice(const ambulo__cli_input *input, const char *name, int fallback) {
  const ambulo__cli_command *c = input->command;
  const char *word = ambulo__cli_value(input, name);
  for (int i = 0; word && i < c->option_count; i++)
    if (strcmp(c->options[i].name, name) == 0) return find_choice(c->options[i].value, word);
  return fallback;
}

int ambulo__cli_number(const ambulo__cli_input *input, const char *name, double min, double max,
                       double *value) {
  const char *text = ambulo__cli_value(input, name);
  if (!text) return 1;
  char *end = NULL;
  errno = 0;
  double number = strtod(text, &end);
  /* strtod also takes hexadecimal, "inf" and leading blanks; a plain number has none of these */
  int plain = text[0] && strspn(text, "0123456789.eE+-") == strlen(text) && !*end;
  if (!plain || !isfinite(number) || number < min || number > max) {
    ambulo__cli_usage_error(input->command->name, NULL,
                            "--%s is '%s'; expected a number from %g to %g", name, text, min, max);
    return 0;
  }
  *value = number;
  return 1;
}

int ambulo__cli_limit(const ambulo__cli_input *input, const char *name, double *value) {
  if (!ambulo__cli_number(input, name, 0.0, 1e9, value)) return 0;
  if (*value == 0.0) *value = AMBULO_OFF;
  return 1;
}

int ambulo__cli_integer(const ambulo__cli_input *input, const char *name, int min, int max,
                        int *value) {
  const char *text = ambulo__cli_value(input, name);
  if (!text) return 1;
  char *end = NULL;
  errno = 0;
  long number = strtol(text, &end, 10);
  int plain = text[0] && strspn(text, "0123456789-") == strlen(text) && !*end && !errno;
  if (!plain || number < min || number > max) {
    ambulo__cli_usage_error(input->command->name, NULL,
                            "--%s is '%s'; expected a whole number from %d to %d", name, text, min,
                            max);
    return 0;
  }
  *value = (int)number;
  return 1;
}

/* ------------------------------------------------------------------ parsing */

typedef struct parser {
  const ambulo__cli_command *command;
  int argc, next;
  char **argv;
  const char **arguments, **values;
  int *options;
  int argument_count, given_count;
} parser;

static int unknown_option(const parser *p, const char *text, size_t length) {
  const ambulo__cli_command *command = p->command;
  char word[LONGEST_WORD + 1] = "", hint[LONGEST_WORD + 32];
  const char *names[64];
  int count = 0;
  for (; count < command->option_count && count < 63; count++)
    names[count] = command->options[count].name;
  names[count++] = "help";
  if (length <= LONGEST_WORD) memcpy(word, text, length);
  const char *nearest = ambulo__cli_nearest(word, names, count);
  if (nearest) ambulo__cli_format(hint, sizeof hint, "did you mean '--%s'?", nearest);
  for (const char *const *former = command->former; former && *former; former += 2)
    if (!strcmp(word, former[0]))
      return ambulo__cli_usage_error(command->name, former[1], "'--%s' is no longer an option",
                                     word);
  return ambulo__cli_usage_error(command->name, nearest ? hint : NULL, "unknown option '%s'",
                                 p->argv[p->next]);
}

/* index of the option that argv[next] names, with the value attached to it (or NULL) */
static int find_option(const parser *p, const char **attached) {
  const char *text = p->argv[p->next];
  int by_name = text[1] == '-';
  const char *name = text + (by_name ? 2 : 1);
  size_t length = by_name ? strcspn(name, "=") : 1;
  *attached = NULL;
  if (by_name && name[length] == '=') *attached = name + length + 1;
  if (!by_name && name[1]) *attached = name + 1;
  for (int i = 0; i < p->command->option_count; i++) {
    const ambulo__cli_option *option = &p->command->options[i];
    int match = by_name ? strlen(option->name) == length && !strncmp(option->name, name, length)
                        : option->letter == name[0];
    if (match) return i;
  }
  unknown_option(p, name, length);
  return -1;
}

/* "free|fixed", and not "zero|FILE" */
static int takes_choices(const char *value) {
  for (const char *c = value; *c; c++)
    if (!islower((unsigned char)*c) && *c != '|') return 0;
  return strchr(value, '|') != NULL;
}

static int wrong_choice(const parser *p, const ambulo__cli_option *option, const char *value) {
  char list[128] = "";
  int length, count = 0, k = 0;
  const char *rest = option->value;
  while (ambulo__cli_next_choice(&rest, &length)) count++;
  rest = option->value;
  for (const char *c; (c = ambulo__cli_next_choice(&rest, &length)); k++) {
    size_t used = strlen(list);
    ambulo__cli_format(list + used, sizeof list - used, "%s%.*s",
                       k == 0          ? ""
                       : k + 1 < count ? ", "
                                       : " or ",
                       length, c);
  }
  return ambulo__cli_usage_error(p->command->name, NULL, "--%s is '%s'; expected %s", option->name,
                                 value, list);
}

/* behind those of the same option, so that its values are one piece */
static void give(parser *p, int option, const char *value) {
  int at = p->given_count++;
  for (; at > 0 && p->options[at - 1] > option; at--) {
    p->options[at] = p->options[at - 1];
    p->values[at] = p->values[at - 1];
  }
  p->options[at] = option;
  p->values[at] = value;
}

/* 0, or the exit code of a usage error */
static int parse_option(parser *p) {
  const char *attached;
  int index = find_option(p, &attached);
  if (index < 0) return 2;
  const ambulo__cli_option *option = &p->command->options[index];
  const char *value = attached;
  if (!option->value && attached)
    return ambulo__cli_usage_error(p->command->name, NULL, "--%s takes no value (got '%s')",
                                   option->name, attached);
  if (option->value && !attached) {
    if (p->next + 1 >= p->argc)
      return ambulo__cli_usage_error(p->command->name, NULL, "--%s needs a value: %s", option->name,
                                     option->value);
    value = p->argv[++p->next];
  }
  if (value && !value[0])
    return ambulo__cli_usage_error(p->command->name, NULL, "--%s is empty; expected %s",
                                   option->name, option->value);
  if (value && takes_choices(option->value) && find_choice(option->value, value) < 0)
    return wrong_choice(p, option, value);
  give(p, index, value);
  return 0;
}

/* an empty one is what a variable of the shell that is not set leaves */
static int check_arguments(const parser *p) {
  const ambulo__cli_command *c = p->command;
  for (int i = 0; i < p->argument_count; i++) {
    if (!p->arguments[i][0])
      return ambulo__cli_usage_error(c->name, NULL, "argument %d is empty; expected %s", i + 1,
                                     c->arguments);
  }
  if (p->argument_count < c->minimum)
    return ambulo__cli_usage_error(c->name, NULL, "missing argument; expected %s", c->arguments);
  if (c->maximum >= 0 && p->argument_count > c->maximum)
    return ambulo__cli_usage_error(c->name, NULL, "unexpected argument '%s'; expected %s",
                                   p->arguments[c->maximum], c->arguments);
  return 0;
}

static int parse(parser *p, int *help) {
  int options_ended = 0;
  for (; p->next < p->argc; p->next++) {
    const char *text = p->argv[p->next];
    if (options_ended || text[0] != '-' || !text[1]) {
      p->arguments[p->argument_count++] = text;
    } else if (!strcmp(text, "--")) {
      options_ended = 1;
    } else if (!strcmp(text, "--help") || !strcmp(text, "-h")) {
      *help = 1;
      return 0;
    } else {
      int code = parse_option(p);
      if (code) return code;
    }
  }
  return check_arguments(p);
}

enum { PATH = 4096 };

/* puts paths of shipped files in the place of their names; 0: no memory */
static int find_files(parser *p, char **paths) {
  int most = p->command->files;
  for (int i = 0; i < p->argument_count && (most < 0 || i < most); i++) {
    char path[PATH];
    if (!ambulo__cli_find_file(p->arguments[i], path, sizeof path)) continue;
    size_t size = strlen(path) + 1;
    paths[i] = malloc(size);
    if (!paths[i]) return 0;
    memcpy(paths[i], path, size);
    p->arguments[i] = paths[i];
  }
  return 1;
}

static int run_command(parser *p, char **paths) {
  int help = 0, code = parse(p, &help);
  if (help) ambulo__cli_print_help(p->command);
  if (help || code) return code;
  if (!find_files(p, paths)) {
    ambulo__cli_error("E_MEMORY", NULL, "not enough memory for the names of files");
    return 5;
  }
  ambulo__cli_input input = {p->command, p->arguments, p->argument_count,
                             p->options, p->values,    p->given_count};
  code = ambulo__cli_guard_words(&input);
  if (!code) code = p->command->run(&input);
  int most = p->command->files, is_lost = code == ambulo_status_exit_code(AMBULO_E_IO);
  for (int i = 0; is_lost && i < p->argument_count && (most < 0 || i < most); i++)
    ambulo__cli_shipped_hint(p->arguments[i]);
  return code;
}

int ambulo__cli_run(const ambulo__cli_command *command, int argc, char **argv) {
  size_t room = (size_t)argc + 1;
  parser p = {.command = command, .argc = argc, .next = 2, .argv = argv};
  p.arguments = calloc(room, sizeof *p.arguments);
  p.values = calloc(room, sizeof *p.values);
  p.options = calloc(room, sizeof *p.options);
  char **paths = calloc(room, sizeof *paths);
  int code = 5;
  if (p.arguments && p.values && p.options && paths) {
    code = run_command(&p, paths);
  } else {
    ambulo__cli_error("E_MEMORY", NULL, "not enough memory for the command line");
  }
  for (size_t i = 0; paths && i < room; i++) free(paths[i]);
  free(paths);
  free(p.arguments);
  free(p.values);
  free(p.options);
  return code;
}
