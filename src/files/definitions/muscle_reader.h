/* definitions/muscle_reader.h - a file of muscles on its way to a definition. */
#ifndef AMBULO_DEFINITIONS_MUSCLE_READER_H
#define AMBULO_DEFINITIONS_MUSCLE_READER_H

#include "definitions/model_reader.h"
#include "formats/arena.h"
#include "muscle/muscles.h"

enum { AMBULO__MOST_MUSCLE_JOINTS = 8 };

typedef struct ambulo__muscle_joint {
  const char *name;
  int link, axes;
} ambulo__muscle_joint;

typedef struct ambulo__muscle_range {
  int coordinate;
  double ends[2]; /* rad */
} ambulo__muscle_range;

typedef struct ambulo__muscle_reader {
  ambulo__arena arena;
  const ambulo_model *model;
  double length, force;  /* factors */
  const char *suffix[2]; /* of the file's side and of the other; NULL: no mirror images */
  ambulo__muscle_joint joints[AMBULO__MOST_MUSCLE_JOINTS];
  int joint_count;
  ambulo__muscle_range *ranges;
  int range_count;
  ambulo_muscle *muscles; /* [2 count]: the file's, then their mirror images */
  ambulo__place *places;
  unsigned char *fixed; /* [2 count] AMBULO__FIXED_FORCE | ... */
  int count;
} ambulo__muscle_reader;

/* The mirror image's name; NULL: not of the file's side. */
const char *ambulo__muscle_other_side(ambulo__muscle_reader *reader, const char *name);
/* The mirror image of muscle `index`, which stands at `item`, behind those of the file. */
void ambulo__muscle_mirror(ambulo__muscle_reader *reader, const ambulo__yaml_node *item, int index);
/* Of `muscles` in a problem file (NULL: none): multiplies forces by its `strength`; takes its
 * numbers by muscle in place of what they are. Each says there what is wrong. */
void ambulo__muscle_strength(ambulo__muscle_reader *reader, const ambulo__yaml_node *section);
void ambulo__muscle_numbers(ambulo__muscle_reader *reader, const ambulo__yaml_node *section);

#endif
