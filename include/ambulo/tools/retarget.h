/* ambulo/tools/retarget.h - a motion of one body becomes a task for another
 * (docs/guide-retarget.md).
 *
 * The motion of a person, measured or predicted, is read as turns of body segments. Contacts with
 * the ground are found in it, footholds and times are scaled to the other body, and the angles with
 * which that would move alike become a reference. What comes out is a folder with an ordinary
 * problem file, to be edited and solved as any other.
 *
 * A tool around the engine: outside the promise of ambulo/ambulo.h. It may change with any release.
 */
#ifndef AMBULO_TOOLS_RETARGET_H
#define AMBULO_TOOLS_RETARGET_H

#include "ambulo/model.h"
#include "ambulo/solve.h"
#include "ambulo/tools/common.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How long the motion of the other body takes. */
typedef enum ambulo_times {
  AMBULO_TIMES_NOT_SET = 0, /* scaled where the motion flies, since gravity stays; else kept */
  AMBULO_TIMES_SCALED,      /* times the root of the ratio of lengths */
  AMBULO_TIMES_KEPT
} ambulo_times;

typedef struct ambulo_retarget_options {
  size_t size;              /* set by ambulo_retarget_options_default() */
  const ambulo_model *body; /* whose angles a CSV, STO or MOT holds; other files bring their own */
  const char *map;          /* file of segments and their coordinates; NULL: by names */
  double from, to;          /* part of the motion, s; all of it */
  double speed;             /* of a treadmill's belt, m/s: added to the way forward; 0 */
  ambulo_times times;
  int overwrite; /* 1: an earlier folder of this kind is replaced */
} ambulo_retarget_options;
AMBULO_TOOL_DEFAULT(ambulo_retarget_options);

/* Reads `motion` (CSV, STO, MOT; BVH; .npz of SMPL as AMASS has it) and writes `directory`, whole
 * or not at all: problem.yaml, reference.csv, model.yaml (a copy of `model_file`, the body that it
 * goes onto), map.yaml (segments as understood, in the form of options.map), and of a motion that
 * brings its skeleton source.yaml and source.csv. `allocator` and `diagnostics` may be NULL.
 * Errors: E_ARGUMENT, E_IO, E_PARSE, E_SCHEMA, E_MODEL (a body without legs or feet), E_LIMIT,
 * E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status
ambulo_retarget_write(const char *motion, const char *model_file, const char *directory,
                      const ambulo_retarget_options *options, const ambulo_allocator *allocator,
                      ambulo_diagnostics *diagnostics);

/* How well a result follows what its problem tracks, in words, a coordinate a line: rms distance,
 * and where it is more than 5 degrees the limits that the motion rests on. Then how far feet slip
 * and sink in. Free *text with ambulo_text_free. Errors: E_ARGUMENT, E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_retarget_report(const ambulo_problem *problem,
                                                                 const ambulo_result *result,
                                                                 const ambulo_allocator *allocator,
                                                                 char **text);

#ifdef __cplusplus
}
#endif
#endif
