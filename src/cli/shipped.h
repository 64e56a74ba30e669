/* cli/shipped.h - the models and problems that come with the program: their folder, their names on
 * the command line, what each says it is. */
#ifndef AMBULO_CLI_SHIPPED_H
#define AMBULO_CLI_SHIPPED_H

#include <stddef.h>

/* Their folder in buffer[size]: what AMBULO_MODELS names, or else an absolute path, below the
 * prefix that the program is installed in (share/ambulo/models) or the source folder it was built
 * in. 0 when there is none. */
int ambulo__cli_shipped_folder(char *buffer, size_t size);

/* A file or folder in it, as buffer[size]; 0 when there is none. */
int ambulo__cli_shipped_file(const char *name, char *buffer, size_t size);

/* Tells the library where they are (AMBULO_MODELS), so that a problem finds a shipped model by its
 * name. Before any thread. */
void ambulo__cli_shipped_announce(void);

/* Where there is no file `word` of a command line: word.yaml, or the shipped file of that name,
 * with or without its ending, as buffer[size], which a line on stderr says. 0: `word` is to be
 * taken. */
int ambulo__cli_find_file(const char *word, char *buffer, size_t size);

/* A hint on stderr where `file` is not there, and one of its name is shipped. */
void ambulo__cli_shipped_hint(const char *file);

enum { AMBULO__CLI_NAME = 64, AMBULO__CLI_LINE = 84 };

typedef struct ambulo__cli_entry {
  char file[AMBULO__CLI_NAME];  /* "walk.yaml" */
  char kind[16];                /* "model", "problem", "sweep", "fit"; of a CSV "table" */
  char about[AMBULO__CLI_LINE]; /* the first sentence of its first comment, as long as it fits */
} ambulo__cli_entry;

/* The shipped files, sorted by name: *entries, to be freed with free(), and their number; -1 after
 * a message. */
int ambulo__cli_catalogue(ambulo__cli_entry **entries);

/* The whole text of a shipped file, to be freed with free(); NULL after a message. */
char *ambulo__cli_shipped_text(const char *file);

/* The first sentence of the comment that `text` begins with, of at most size - 1 bytes: a longer
 * one ends at its last colon, comma or space that fits. */
void ambulo__cli_first_sentence(const char *text, char *line, size_t size);

#endif
