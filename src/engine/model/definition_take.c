/* model/definition_take.c - definitions of models by programs of older headers.
 *
 * Items of the size that this library knows stay where they are; shorter ones become longer, with
 * what ambulo_..._default() says behind (base/sized.h).
 */
#include "model/definition_take.h"
#include "base/alloc.h"
#include "base/sized.h"

#include <string.h>

ambulo_status ambulo__model_take(const ambulo_model_definition *given,
                                 const ambulo_allocator *allocator, ambulo__taken_model *taken) {
  *taken = (ambulo__taken_model){.definition = ambulo_model_definition_default(),
                                 .allocator = ambulo__allocator_or_default(allocator)};
  ambulo_model_definition *d = &taken->definition;
  if (!given || !ambulo__sized_take(d, sizeof *d, given)) return AMBULO_E_ARGUMENT;
  void **longer = taken->longer;
  int failed = 0;
#define TAKE(array, item, type)                                                                    \
  do {                                                                                             \
    if (!ambulo__sized_item(d->item##_size, sizeof(type))) return AMBULO_E_ARGUMENT;               \
    if (d->item##_size < sizeof(type) && d->array && d->item##_count > 0) {                        \
      *longer = ambulo__sized_items(&taken->allocator, d->array, d->item##_count, d->item##_size,  \
                                    sizeof(type), #type);                                          \
      failed = failed || !*longer;                                                                 \
      d->array = *longer++;                                                                        \
    }                                                                                              \
    d->item##_size = sizeof(type);                                                                 \
  } while (0)
  TAKE(links, link, ambulo_link);
  TAKE(coordinates, coordinate, ambulo_coordinate);
  TAKE(points, point, ambulo_point);
  TAKE(feet, foot, ambulo_foot);
  TAKE(patches, patch, ambulo_patch);
  TAKE(capsules, capsule, ambulo_capsule);
#undef TAKE
  return failed ? AMBULO_E_MEMORY : AMBULO_OK;
}

void ambulo__model_drop(ambulo__taken_model *taken) {
  for (int i = 0; i < AMBULO__MODEL_ARRAYS; i++) ambulo__free(&taken->allocator, taken->longer[i]);
}
