/* study/units.h - units of outputs and axes, for the labels of drawings. */
#ifndef AMBULO_STUDY_UNITS_H
#define AMBULO_STUDY_UNITS_H

#include "ambulo/model.h"

/* Of "max(tau.knee_angle_r)" or "duration"; whether a coordinate is an angle or a length is seen
 * from the model. "": none, or not known. */
const char *ambulo__unit_of_output(const char *output, const ambulo_model *model);
/* Of a key of the problem such as "subject.mass". */
const char *ambulo__unit_of_key(const char *key);

#endif
