/* cli/catalogue.h - what is in the folder of the shipped files, and what each file says it is. */
#ifndef AMBULO_CLI_CATALOGUE_H
#define AMBULO_CLI_CATALOGUE_H

#include <stddef.h>

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
