/* cli/completion.c - completion scripts for bash, zsh and fish.
 *
 * What may follow is in the tables: the commands, the options of each, and of an option's value its
 * name in the help: words in small letters between bars are choices (mirrored|periodic), DIR is a
 * folder, FILE a file; of others nothing is known. Arguments are files, and the words that the
 * command's own `words` lists when the key is pressed. */
#include <stdio.h>
#include <string.h>

#include "cli/command.h"
#include "cli/output.h"

/* ------------------------------------------------------------ what follows */

/* the choices of a value or of arguments, with blanks between them */
static void print_choices(const char *value) {
  const char *blank = "", *word;
  int length;
  if (!strchr(value, '|')) return;
  for (; (word = ambulo__cli_next_choice(&value, &length)); blank = " ")
    printf("%s%.*s", blank, length, word);
}

/* what the arguments of a command may be besides files, as words of a shell */
static void print_words(const ambulo__cli_command *c) {
  if (c->words)
    printf("$(%s 2>/dev/null)", c->words);
  else
    print_choices(c->arguments);
}

static int is_folder(const char *value) {
  return strstr(value, "DIR") != NULL;
}
/* arguments that are folders, and nothing else: "DIR [DIR...]" */
static int takes_folders(const ambulo__cli_command *c) {
  return is_folder(c->arguments) && !strchr(c->arguments, '|') && !c->words;
}
static int is_file(const char *value) {
  return strstr(value, "FILE") != NULL;
}

/* text within single quotes, on one line; `special` characters get a backslash */
static void quote(const char *text, const char *special) {
  for (const char *c = text; *c; c++) {
    if (*c == '\'') {
      fputs("'\\''", stdout);
      continue;
    }
    if (strchr(special, *c)) putchar('\\');
    putchar(*c == '\n' ? ' ' : *c);
  }
}

/* ------------------------------------------------------------------- bash */

static void bash_value(const ambulo__cli_option *option) {
  printf("        --%s", option->name);
  if (option->letter) printf("|-%c", option->letter);
  printf(") _ambulo_reply%s%s -W '", is_folder(option->value) ? " -d" : "",
         is_file(option->value) ? " -f" : "");
  print_choices(option->value);
  printf("' -- \"$cur\"; return ;;\n");
}

static void bash_command(const ambulo__cli_command *c) {
  int valued = 0;
  for (int i = 0; i < c->option_count; i++) valued += c->options[i].value != NULL;
  printf("    %s)\n", c->name);
  if (valued > 0) printf("      case $prev in\n");
  for (int i = 0; i < c->option_count; i++)
    if (c->options[i].value) bash_value(&c->options[i]);
  if (valued > 0) printf("      esac\n");
  printf("      options='");
  for (int i = 0; i < c->option_count; i++) printf("--%s ", c->options[i].name);
  printf("--help'\n");
  printf("      words=\"");
  print_words(c);
  printf("\"\n%s      ;;\n", takes_folders(c) ? "      kind=-d\n" : "");
}

/* a loop, not mapfile: macOS has bash 3.2; names with blanks stay whole */
static const char bash_head[] =
    "# bash completion of ambulo; made by 'ambulo help --completion bash'\n"
    "_ambulo_reply() {\n"
    "  local word\n"
    "  while IFS= read -r word; do COMPREPLY+=(\"$word\"); done < <(compgen \"$@\")\n"
    "}\n"
    "_ambulo() {\n"
    "  local cur=${COMP_WORDS[COMP_CWORD]} prev=${COMP_WORDS[COMP_CWORD-1]}\n"
    "  local options='' words='' kind=-f\n"
    "  COMPREPLY=()\n"
    "  if [ \"$COMP_CWORD\" = 1 ]; then\n"
    "    _ambulo_reply -W '";
static const char bash_tail[] = "  esac\n"
                                "  case $cur in\n"
                                "    -*) _ambulo_reply -W \"$options\" -- \"$cur\" ;;\n"
                                "    *) _ambulo_reply $kind -W \"$words\" -- \"$cur\" ;;\n"
                                "  esac\n"
                                "}\n"
                                "complete -o filenames -F _ambulo ambulo\n";

static void print_bash(const ambulo__cli_command *const *commands, int count) {
  fputs(bash_head, stdout);
  for (int i = 0; i < count; i++) printf("%s ", commands[i]->name);
  printf("help --help --version --models' -- \"$cur\"\n    return\n  fi\n"
         "  case ${COMP_WORDS[1]} in\n    help) _ambulo_reply -W '");
  for (int i = 0; i < count; i++) printf("%s%s", i ? " " : "", commands[i]->name);
  printf("' -- \"$cur\"; return ;;\n");
  for (int i = 0; i < count; i++) bash_command(commands[i]);
  fputs(bash_tail, stdout);
}

/* -------------------------------------------------------------------- zsh */

static void zsh_option(const ambulo__cli_option *option, int letter) {
  printf("        '*%s", letter ? "-" : "--");
  if (letter)
    putchar(option->letter);
  else
    fputs(option->name, stdout);
  putchar('[');
  quote(option->help, "[]:\\");
  putchar(']');
  if (option->value) {
    putchar(':');
    quote(option->value, "[]:\\");
    fputs(is_folder(option->value) ? ":_files -/"
          : is_file(option->value) ? ":_files"
                                   : ":(",
          stdout);
    if (!is_folder(option->value) && !is_file(option->value)) {
      print_choices(option->value);
      putchar(')');
    }
  }
  fputs("' \\\n", stdout);
}

static void zsh_command(const ambulo__cli_command *c) {
  printf("    %s)\n      _arguments -s \\\n", c->name);
  for (int i = 0; i < c->option_count; i++) {
    zsh_option(&c->options[i], 0);
    if (c->options[i].letter) zsh_option(&c->options[i], 1);
  }
  printf("        '--help[this page]' \\\n        '*:");
  quote(c->arguments, "[]:\\");
  printf(":{ _alternative \"words:name:(");
  print_words(c);
  printf(")\" \"files:file:_files%s\" }' ;;\n", takes_folders(c) ? " -/" : "");
}

static void print_zsh(const ambulo__cli_command *const *commands, int count) {
  printf("#compdef ambulo\n# zsh completion of ambulo; made by 'ambulo help --completion zsh'\n"
         "_ambulo() {\n"
         "  local -a commands\n"
         "  commands=(\n");
  for (int i = 0; i < count; i++) {
    printf("    '%s:", commands[i]->name);
    quote(commands[i]->summary, ":\\");
    printf("'\n");
  }
  printf("    'help:the page of a command'\n  )\n"
         "  if (( CURRENT == 2 )); then\n    _describe command commands\n    return\n  fi\n"
         "  local command=$words[2]\n"
         "  shift words\n  (( CURRENT-- ))\n"
         "  case $command in\n    help) _describe command commands ;;\n");
  for (int i = 0; i < count; i++) zsh_command(commands[i]);
  printf("    *) _files ;;\n  esac\n}\n_ambulo \"$@\"\n");
}

/* ------------------------------------------------------------------- fish */

static void fish_option(const ambulo__cli_command *c, const ambulo__cli_option *option) {
  printf("complete -c ambulo -n '__fish_seen_subcommand_from %s' -l %s", c->name, option->name);
  if (option->letter) printf(" -s %c", option->letter);
  if (option->value) {
    printf(" %s -a '", is_folder(option->value) || is_file(option->value) ? "-rF" : "-x");
    print_choices(option->value);
    putchar('\'');
  }
  printf(" -d '");
  quote(option->help, "\\");
  printf("'\n");
}

static void print_fish(const ambulo__cli_command *const *commands, int count) {
  printf("# fish completion of ambulo; made by 'ambulo help --completion fish'\n");
  for (int i = 0; i < count; i++) {
    const ambulo__cli_command *c = commands[i];
    printf("complete -c ambulo -n __fish_use_subcommand -f -a %s -d '", c->name);
    quote(c->summary, "\\");
    printf("'\n");
    for (int k = 0; k < c->option_count; k++) fish_option(c, &c->options[k]);
    printf("complete -c ambulo -n '__fish_seen_subcommand_from %s' -a '", c->name);
    if (c->words)
      printf("(%s 2>/dev/null)", c->words);
    else
      print_choices(c->arguments);
    printf("'\n");
  }
}

int ambulo__cli_print_completion(const char *shell, const ambulo__cli_command *const *commands,
                                 int count) {
  if (shell && strcmp(shell, "bash") == 0) {
    print_bash(commands, count);
  } else if (shell && strcmp(shell, "zsh") == 0) {
    print_zsh(commands, count);
  } else if (shell && strcmp(shell, "fish") == 0) {
    print_fish(commands, count);
  } else {
    return ambulo__cli_usage_error(NULL, NULL, "--completion '%s'; expected bash, zsh or fish",
                                   shell ? shell : "");
  }
  return 0;
}
