/* cli/shipped.h - the models and problems that come with the program. */
#ifndef AMBULO_CLI_SHIPPED_H
#define AMBULO_CLI_SHIPPED_H

#include <stddef.h>

/* Their folder, an absolute path in buffer[size]: below the prefix that the program is installed in
 * (share/ambulo/models), or the source folder it was built in. 0 when there is none. */
int ambulo__cli_shipped_folder(char *buffer, size_t size);

/* A file or folder in it, as buffer[size]; 0 when there is none. */
int ambulo__cli_shipped_file(const char *name, char *buffer, size_t size);

/* A hint on stderr where `file` is not there, and one of its name is shipped. */
void ambulo__cli_shipped_hint(const char *file);

#endif
