/* cli/foot_list.h - feet that a source does not tell, asked for in a terminal. */
#ifndef AMBULO_CLI_FOOT_LIST_H
#define AMBULO_CLI_FOOT_LIST_H

#include "ambulo/tools/import.h"

enum { AMBULO__CLI_FEET = 2, AMBULO__CLI_FOOT_TEXT = 400 };

/* Answers, in the form of options of the import. */
typedef struct ambulo__cli_feet {
  char foot_text[AMBULO__CLI_FEET][AMBULO__CLI_FOOT_TEXT];
  char heel_text[AMBULO__CLI_FEET][AMBULO__CLI_FOOT_TEXT];
  char toe_text[AMBULO__CLI_FEET][AMBULO__CLI_FOOT_TEXT];
  const char *foot[AMBULO__CLI_FEET], *heel[AMBULO__CLI_FEET], *toe[AMBULO__CLI_FEET];
} ambulo__cli_feet;

/* Where stdin and stderr are terminals, the options name no feet, the source has none and `output`
 * (may be NULL) could be written: lists the links at the ends of the body and asks which are feet,
 * and, where those have no geometry, where heel and toe are. The answers become `options`, which
 * point to *feet. The end of the input is an answer: none. */
void ambulo__cli_ask_feet(const char *source, const char *output, ambulo_import_options *options,
                          ambulo__cli_feet *feet);

#endif
