/* cli/guard.c - see guard.h. What functions of the library know of their inputs they guard
 * themselves; they do not know the files of a model, nor which other words name one. */
#include "cli/guard.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "cli/output.h"

/* the file that the command would write over, and what it is; NULL: none */
static const char *find_output(const ambulo__cli_input *input, struct stat *there) {
  const char *output = NULL;
  for (int i = 0; i < input->given_count; i++) {
    const char *name = input->command->options[input->options[i]].name;
    if (strcmp(name, "force") == 0) return NULL;
    if (strcmp(name, "output") == 0 || strcmp(name, "cycles") == 0) output = input->values[i];
  }
  return output && stat(output, there) == 0 && S_ISREG(there->st_mode) ? output : NULL;
}

static int refuse(const char *output, const struct stat *there, const char *word) {
  struct stat entry;
  if (!word || word == output || stat(word, &entry) != 0) return 0;
  if (entry.st_dev != there->st_dev || entry.st_ino != there->st_ino) return 0;
  fprintf(stderr,
          "%s: error[E_IO]: the output is the input '%s' itself; it is not written over\n"
          "  hint: give another name, or --force\n",
          output, word);
  return ambulo_status_exit_code(AMBULO_E_IO);
}

int ambulo__cli_guard_words(const ambulo__cli_input *input) {
  struct stat there;
  const char *output = find_output(input, &there);
  int code = 0;
  for (int i = 0; output && i < input->argument_count && !code; i++)
    code = refuse(output, &there, input->arguments[i]);
  for (int i = 0; output && i < input->given_count && !code; i++)
    code = refuse(output, &there, input->values[i]);
  return code;
}

int ambulo__cli_guard_files(const ambulo__cli_input *input, const char *files) {
  enum { BEFORE = 66 }; /* "<SHA-256>  " */
  struct stat there;
  const char *output = find_output(input, &there);
  int code = 0;
  while (output && !code && strlen(files) > BEFORE) {
    size_t length = strcspn(files + BEFORE, "\n");
    char *path = malloc(length + 1);
    if (!path) return ambulo__cli_diagnostics(NULL, AMBULO_E_MEMORY, output);
    memcpy(path, files + BEFORE, length);
    path[length] = '\0';
    code = refuse(output, &there, path);
    free(path);
    files += BEFORE + length;
    files += *files == '\n';
  }
  return code;
}
