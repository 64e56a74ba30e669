/* model/model_query.h - a model whose capsules have their ends among its points.
 *
 * What the mechanics knows of a body's shape are its points, and each costs: three numbers with
 * their derivatives at every node. So a model as it is loaded has none for its capsules, and a
 * problem with rows about some of them works with a copy that has two more points for each of
 * these, behind the model's own: "NAME.from" and "NAME.to". */
#ifndef AMBULO_MODEL_MODEL_QUERY_H
#define AMBULO_MODEL_MODEL_QUERY_H

#include "base/diagnostics.h"
#include "model/model.h"

/* The copy, with points for capsule i where used[i] (and those that had them before); free it too.
 * Errors: E_LIMIT (more points than a model may have), E_MODEL (a point of its own has such a
 * name), E_MEMORY. */
ambulo_status ambulo__model_with_capsule_points(const ambulo_model *model, const int *used,
                                                const ambulo_allocator *allocator,
                                                ambulo_diagnostics *diagnostics,
                                                ambulo_model **extended);

/* 1 if one of two links hangs on the other by nothing but joints: no other link with a mass lies
 * between; and for parts of one rigid body. What joints join touches where it is joined. */
int ambulo__links_are_neighbours(const ambulo_model *model, int one, int other);

#endif
