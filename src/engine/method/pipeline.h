/* method/pipeline.h - the method on one grid, from a start to a solution. */
#ifndef AMBULO_METHOD_PIPELINE_H
#define AMBULO_METHOD_PIPELINE_H

#include "method/engine.h"

typedef enum ambulo__stage {
  AMBULO__COARSE, /* a coarse grid whose solution only starts the next one: wide tolerances */
  AMBULO__FAR,    /* from anywhere */
  AMBULO__NEAR    /* from a point that nearly satisfies the rows, and stays in its valley */
} ambulo__stage;

/* From x (in and out); run->ending says why it ended. The last multipliers stay in the engine's
 * iterate, the last point of AUGLAG in engine->reached. */
ambulo_status ambulo__pipeline(ambulo__engine *engine, ambulo__stage stage, double *x);

#endif
