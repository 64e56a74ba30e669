/* cli/shipped.h - the models and problems that come with the program. */
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

#endif
