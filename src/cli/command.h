/* cli/command.h - commands and options as tables: parsing, help, manual pages and completions all
 * come from them. */
#ifndef AMBULO_CLI_COMMAND_H
#define AMBULO_CLI_COMMAND_H

typedef struct ambulo__cli_option {
  const char *name;  /* without the dashes: "time-limit" */
  char letter;       /* 'o' for -o; 0: none */
  const char *value; /* its name in the help: "DIR"; NULL: a flag. Words in small letters between
                        bars ("free|fixed") are the only values that are taken. */
  const char *help;
} ambulo__cli_option;

typedef struct ambulo__cli_input ambulo__cli_input;

typedef struct ambulo__cli_command {
  const char *name;
  const char *arguments;   /* "PROBLEM.yaml" */
  const char *summary;     /* one line */
  const char *description; /* a paragraph, lines already broken */
  const char *example;     /* lines to paste */
  const ambulo__cli_option *options;
  int option_count;
  int minimum, maximum; /* number of positional arguments; maximum < 0: any */
  int files;            /* so many of the first may be names of shipped files; < 0: all of them */
  const char *const *former; /* options of earlier versions and what to write instead, in pairs,
                                then NULL; NULL: none */
  const char *words; /* a shell command that lists what the arguments may be; NULL: only files */
  int (*run)(const ambulo__cli_input *input); /* returns the exit code */
} ambulo__cli_command;

/* The commands; main.c has them in a list. */
extern const ambulo__cli_command ambulo__cli_solve, ambulo__cli_evaluate, ambulo__cli_check,
    ambulo__cli_info, ambulo__cli_inverse, ambulo__cli_muscles, ambulo__cli_compare,
    ambulo__cli_batch, ambulo__cli_collect, ambulo__cli_fit, ambulo__cli_report, ambulo__cli_models,
    ambulo__cli_new, ambulo__cli_import, ambulo__cli_retarget, ambulo__cli_draw, ambulo__cli_film,
    ambulo__cli_export;

/* A parsed command line. Strings are those of argv. */
struct ambulo__cli_input {
  const ambulo__cli_command *command;
  const char **arguments; /* [argument_count] */
  int argument_count;
  int *options;        /* [given_count]: index into command->options, in their order */
  const char **values; /* [given_count]: NULL for flags; of one option in the order given */
  int given_count;
};

/* Value of an option (the last one given), or NULL; 1 if a flag was given. */
const char *ambulo__cli_value(const ambulo__cli_input *input, const char *name);
int ambulo__cli_flag(const ambulo__cli_input *input, const char *name);
/* The values of a repeatable option, in order, and their *count. */
const char *const *ambulo__cli_values(const ambulo__cli_input *input, const char *name, int *count);
/* Which of the words of its value ("free|fixed") was given; `fallback` without the option. */
int ambulo__cli_choice(const ambulo__cli_input *input, const char *name, int fallback);
/* Number or whole number in [min, max] behind an option; 1 on success (also when it
 * was not given: *value stays), 0 after a message. */
int ambulo__cli_number(const ambulo__cli_input *input, const char *name, double min, double max,
                       double *value);
int ambulo__cli_integer(const ambulo__cli_input *input, const char *name, int min, int max,
                        int *value);
/* A limit in seconds: 0 is none. */
int ambulo__cli_limit(const ambulo__cli_input *input, const char *name, double *value);

/* Parses argv[2..argc) for a command and runs it. Returns the exit code. */
int ambulo__cli_run(const ambulo__cli_command *command, int argc, char **argv);

/* The nearest of `count` words; NULL if none is near. */
const char *ambulo__cli_nearest(const char *word, const char *const *words, int count);
/* The next of the words between bars at *text, which moves on, and its *length; NULL: none is left.
 * Only words in small letters count. */
const char *ambulo__cli_next_choice(const char **text, int *length);

/* help.c: a command's page and its manual page, the overviews of both: on stdout. */
void ambulo__cli_print_help(const ambulo__cli_command *command);
void ambulo__cli_print_overview(const ambulo__cli_command *const *commands, int count);
void ambulo__cli_print_man(const ambulo__cli_command *command);
void ambulo__cli_print_man_overview(const ambulo__cli_command *const *commands, int count);
/* completion.c: the script for "bash", "zsh" or "fish" on stdout. Exit code. */
int ambulo__cli_print_completion(const char *shell, const ambulo__cli_command *const *commands,
                                 int count);

#endif
