/* cli/help.c - pages of commands and of the program, made from the tables of commands: --help as
 * plain text; manual pages in man(7), which man-db and mandoc read, with every text escaped so that
 * no character of it is a request. */
#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "ambulo/tools/tools.h"
#include "cli/command.h"

/* of the release, as in CITATION.cff (tests/package/long.sh compares them) */
static const char release_date[] = "2026-11-23";

/* columns of a line of source */
enum { WIDTH = 76 };

static const ambulo__cli_option help_option = {"help", 'h', NULL, "this page"};

static const struct {
  const char *code, *meaning;
} exit_codes[] = {
    {"0", "solved, or done"},
    {"1", "ended without a valid solution (the result is written and marked)"},
    {"2", "usage"},
    {"3", "invalid input"},
    {"4", "input/output"},
    {"5", "memory or size limit"},
    {"6", "internal error"},
    {"130/143", "interrupted by Ctrl-C or SIGTERM (the best point is saved)"},
};
enum { EXIT_CODES = sizeof exit_codes / sizeof exit_codes[0] };

/* ------------------------------------------------------------------- plain text */

static int option_label(const ambulo__cli_option *option, char *label, size_t size) {
  char letter[8] = "    ";
  if (option->letter) snprintf(letter, sizeof letter, "-%c, ", option->letter);
  return snprintf(label, size, "%s--%s%s%s", letter, option->name, option->value ? " " : "",
                  option->value ? option->value : "");
}

static void help_of_option(const ambulo__cli_option *option, int width) {
  char label[80];
  option_label(option, label, sizeof label);
  printf("  %-*s  ", width, label);
  /* further lines of the text are set below the first */
  for (const char *c = option->help; *c; c++) {
    putchar(*c);
    if (*c == '\n') printf("  %-*s  ", width, "");
  }
  putchar('\n');
}

static void print_indented(const char *text) {
  fputs("  ", stdout);
  for (const char *c = text; *c; c++) {
    putchar(*c);
    if (*c == '\n') fputs("  ", stdout);
  }
  putchar('\n');
}

void ambulo__cli_print_help(const ambulo__cli_command *command) {
  int width = 0;
  char label[80];
  for (int i = 0; i < command->option_count; i++) {
    int length = option_label(&command->options[i], label, sizeof label);
    if (length > width) width = length;
  }
  if (width < 10) width = 10;
  printf("ambulo %s - %s\n\n", command->name, command->summary);
  printf("usage: ambulo %s %s%s\n\n", command->name, command->arguments,
         command->option_count ? " [options]" : "");
  printf("%s\n\noptions:\n", command->description);
  for (int i = 0; i < command->option_count; i++) help_of_option(&command->options[i], width);
  help_of_option(&help_option, width);
  printf("\nexample:\n");
  print_indented(command->example);
}

void ambulo__cli_print_overview(const ambulo__cli_command *const *commands, int count) {
  printf("ambulo %s - predicts human motion by optimization\n\n", ambulo_version());
  printf("usage: ambulo COMMAND ARGUMENTS [options]\n\ncommands:\n");
  for (int i = 0; i < count; i++) printf("  %-10s %s\n", commands[i]->name, commands[i]->summary);
  printf("\n'ambulo COMMAND --help' explains a command, 'ambulo --version' names the libraries in "
         "use,\n"
         "'ambulo --models' prints the folder of the shipped files, which are found by name from\n"
         "anywhere. 'ambulo help --man COMMAND' prints a manual page, 'ambulo help --completion "
         "SHELL'\n"
         "a script for bash, zsh or fish.\n");
  printf("exit codes:\n");
  for (int i = 0; i < EXIT_CODES; i++)
    printf("  %-10s %s\n", exit_codes[i].code, exit_codes[i].meaning);
  printf("\nexample:\n  ambulo solve models/walk_normal.yaml -o walk\n");
}

/* ------------------------------------------------------------------- manual */

/* dashes are those of a command line */
static void print_letter(char c) {
  if (c == '\\')
    fputs("\\e", stdout);
  else if (c == '-')
    fputs("\\-", stdout);
  else
    putchar(c);
}

/* a dot or quote at the start of a line is a letter */
static void begin_line(const char *text) {
  if (*text == '.' || *text == '\'') fputs("\\&", stdout);
}

/* lines as they are */
static void print_text(const char *text) {
  begin_line(text);
  for (const char *c = text; *c; c++) {
    print_letter(*c);
    if (*c == '\n') begin_line(c + 1);
  }
}

/* words, which man fills into lines anew */
static void print_prose(const char *text) {
  size_t column = 0;
  for (const char *word = text + strspn(text, " \n"); *word; word += strspn(word, " \n")) {
    size_t length = strcspn(word, " \n"), wide = 1;
    for (size_t i = 0; i < length; i++) wide += word[i] == '-' || word[i] == '\\' ? 2 : 1;
    int breaks = column + wide > WIDTH;
    if (column > 0) putchar(breaks ? '\n' : ' ');
    if (breaks) column = 0;
    if (column == 0) begin_line(word);
    for (size_t i = 0; i < length; i++) print_letter(word[i]);
    column += wide;
    word += length;
  }
  putchar('\n');
}

static void print_title(const char *name, const char *summary) {
  fputs(".TH ", stdout);
  for (const char *c = name; *c; c++) putchar(toupper((unsigned char)*c));
  printf(" 1 %s \"ambulo %s\" Ambulo\n.SH NAME\n", release_date, ambulo_version());
  print_text(name);
  fputs(" \\-\n", stdout);
  print_prose(summary);
}

static void man_of_option(const ambulo__cli_option *option) {
  fputs(".TP\n", stdout);
  if (option->letter) printf("\\fB\\-%c\\fR, ", option->letter);
  fputs("\\fB\\-\\-", stdout);
  print_text(option->name);
  fputs("\\fR", stdout);
  if (option->value) {
    fputs(" \\fI", stdout);
    print_text(option->value);
    fputs("\\fR", stdout);
  }
  putchar('\n');
  print_prose(option->help);
}

static void print_lines(const char *section, const char *text) {
  printf(".SH %s\n.nf\n", section);
  print_text(text);
  fputs("\n.fi\n", stdout);
}

static void print_exit_codes(void) {
  fputs(".SH EXIT STATUS\n", stdout);
  for (int i = 0; i < EXIT_CODES; i++) {
    printf(".TP\n%s\n", exit_codes[i].code);
    print_prose(exit_codes[i].meaning);
  }
}

static void print_formats(void) {
  fputs(".BR ambulo\\-problem (5),\n.BR ambulo\\-model (5),\n.BR ambulo\\-batch (5),\n"
        ".BR ambulo\\-results (5)\n",
        stdout);
}

void ambulo__cli_print_man(const ambulo__cli_command *command) {
  char name[64];
  snprintf(name, sizeof name, "ambulo-%s", command->name);
  print_title(name, command->summary);
  printf(".SH SYNOPSIS\n.B ambulo %s\n", command->name);
  print_text(command->arguments);
  printf("\n%s.SH DESCRIPTION\n", command->option_count ? "[\\fIoptions\\fR]\n" : "");
  print_prose(command->description);
  fputs(".SH OPTIONS\n", stdout);
  for (int i = 0; i < command->option_count; i++) man_of_option(&command->options[i]);
  man_of_option(&help_option);
  print_lines("EXAMPLES", command->example);
  print_exit_codes();
  fputs(".SH SEE ALSO\n.BR ambulo (1),\n", stdout);
  print_formats();
}

void ambulo__cli_print_man_overview(const ambulo__cli_command *const *commands, int count) {
  print_title("ambulo", "predicts human motion by optimization");
  fputs(".SH SYNOPSIS\n.B ambulo\n.I COMMAND ARGUMENTS\n[\\fIoptions\\fR]\n.SH DESCRIPTION\n",
        stdout);
  print_prose("Finds the motion of a skeleton that performs a task, obeys the equations of motion, "
              "keeps the feet on the ground and minimizes effort. Each command has a page:");
  for (int i = 0; i < count; i++) {
    printf(".TP\n.BR ambulo\\-%s (1)\n", commands[i]->name);
    print_prose(commands[i]->summary);
  }
  fputs(".SH OPTIONS\n.TP\n.B \\-\\-version\nnames the libraries in use\n.TP\n.B \\-\\-models\n"
        "prints the folder of the shipped models and problems\n.TP\n.B \\-\\-help\nlists the "
        "commands\n",
        stdout);
  print_exit_codes();
  fputs(".SH ENVIRONMENT\n.TP\n.B AMBULO_MODELS\n", stdout);
  print_prose(
      "The folder in which shipped files are found by name (default: that of the program).");
  fputs(".SH SEE ALSO\n", stdout);
  print_formats();
}
