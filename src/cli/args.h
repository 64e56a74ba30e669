/* cli/args.h - commands and options as tables; parsing and help come from the tables. */
#ifndef AMBULO_CLI_ARGS_H
#define AMBULO_CLI_ARGS_H

typedef struct ambulo__cli_option {
  const char *name;  /* without the dashes: "time-limit" */
  char letter;       /* 'o' for -o; 0: none */
  const char *value; /* what the value is called in the help; NULL: a flag */
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

/* A parsed command line. Strings are those of argv. */
struct ambulo__cli_input {
  const ambulo__cli_command *command;
  const char **arguments; /* [argument_count] */
  int argument_count;
  const int *options;  /* [given_count]: index into command->options */
  const char **values; /* [given_count]: NULL for flags */
  int given_count;
};

/* Value of an option (the last one given), or NULL; 1 if a flag was given. */
const char *ambulo__cli_value(const ambulo__cli_input *input, const char *name);
int ambulo__cli_flag(const ambulo__cli_input *input, const char *name);
/* The values of a repeatable option, in order: fills values[given_count], returns the number. */
int ambulo__cli_values(const ambulo__cli_input *input, const char *name, const char **values);
/* Number or whole number in [min, max] behind an option; 1 on success (also when it
 * was not given: *value stays), 0 after a message. */
int ambulo__cli_number(const ambulo__cli_input *input, const char *name, double min, double max,
                       double *value);
/* A limit in seconds: 0 is none. */
int ambulo__cli_limit(const ambulo__cli_input *input, const char *name, double *value);
int ambulo__cli_integer(const ambulo__cli_input *input, const char *name, int min, int max,
                        int *value);

/* Parses argv[2..argc) for a command and runs it. Returns the exit code. */
int ambulo__cli_run(const ambulo__cli_command *command, int argc, char **argv);

/* The nearest of `count` words; NULL if none is near. */
const char *ambulo__cli_nearest(const char *word, const char *const *words, int count);

/* help.c: the page of one command, on stdout. */
void ambulo__cli_print_help(const ambulo__cli_command *command);
/* --help, which every command has. */
extern const ambulo__cli_option ambulo__cli_help_option;

/* exit_codes.c: what the codes mean, in lines of "CODE", "meaning". */
typedef struct ambulo__cli_exit_code {
  const char *code, *meaning;
} ambulo__cli_exit_code;
enum { AMBULO__CLI_EXIT_CODES = 8 };
extern const ambulo__cli_exit_code ambulo__cli_exit_codes[AMBULO__CLI_EXIT_CODES];

#endif
