/* definitions/model_file.h - a model file with some of its values replaced. */
#ifndef AMBULO_DEFINITIONS_MODEL_FILE_H
#define AMBULO_DEFINITIONS_MODEL_FILE_H

#include "ambulo/model.h"
#include "ambulo/tools/load.h"

/* One value of the model file, replaced before it is read: "links[shank_r].body.mass". */
typedef struct ambulo__model_setting {
  const char *path, *value;
} ambulo__model_setting;
/* ambulo_model_load with such settings; messages call them "--set model.PATH". */
ambulo_status ambulo__model_load_with(const char *path, const ambulo_subject *subject,
                                      const ambulo__model_setting *setting, int settings,
                                      const ambulo_allocator *allocator,
                                      ambulo_diagnostics *diagnostics, ambulo_model **model);

#endif
