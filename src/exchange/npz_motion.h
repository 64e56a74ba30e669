/* exchange/npz_motion.h - a motion as arrays of NumPy, in the coordinates of Pinocchio and MuJoCo.
 */
#ifndef AMBULO_EXCHANGE_NPZ_MOTION_H
#define AMBULO_EXCHANGE_NPZ_MOTION_H

#include "base/text_buffer.h"
#include "exchange/bodies.h"
#include "exchange/loads.h"

/* The archive. `bodies`: ambulo__bodies_single with a free root, where the model has one; names of
 * links are those of its URDF. Errors: E_LIMIT, E_MEMORY. */
ambulo_status ambulo__npz_motion(const ambulo__bodies *bodies, const ambulo__source *source,
                                 const ambulo__loads *loads, ambulo__text_buffer *text);

#endif
