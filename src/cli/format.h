/* cli/format.h - text into a buffer. */
#ifndef AMBULO_CLI_FORMAT_H
#define AMBULO_CLI_FORMAT_H

#include <stddef.h>

/* snprintf that always terminates and says nothing about truncation */
void ambulo__cli_format(char *buffer, size_t size, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

#endif
