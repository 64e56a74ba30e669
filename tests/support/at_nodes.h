/* tests/support/at_nodes.h - the verdict at the nodes alone: for small problems whose grids are too
 * coarse for the motion to hold between them. */
#ifndef AMBULO_TESTS_AT_NODES_H
#define AMBULO_TESTS_AT_NODES_H

#include "solver/result.h"

static inline ambulo_verdict verdict_at_nodes(const ambulo_result *result) {
  return ambulo__verdict_at_nodes(ambulo_result_verdict(result));
}

#endif
