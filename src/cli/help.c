/* cli/help.c - the help page of a command, made from its table. */
#include <stdio.h>
#include <string.h>

#include "cli/args.h"

static int option_label(const ambulo__cli_option *option, char *label, size_t size) {
  char letter[8] = "    ";
  if (option->letter) snprintf(letter, sizeof letter, "-%c, ", option->letter);
  return snprintf(label, size, "%s--%s%s%s", letter, option->name, option->value ? " " : "",
                  option->value ? option->value : "");
}

static void print_option(const ambulo__cli_option *option, int width) {
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

const ambulo__cli_option ambulo__cli_help_option = {"help", 'h', NULL, "this page"};

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
  for (int i = 0; i < command->option_count; i++) print_option(&command->options[i], width);
  print_option(&ambulo__cli_help_option, width);
  printf("\nexample:\n");
  print_indented(command->example);
}
