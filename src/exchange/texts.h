/* exchange/texts.h - models as text: OpenSim (version 4) and URDF; what of a motion stands beside.
 */
#ifndef AMBULO_EXCHANGE_TEXTS_H
#define AMBULO_EXCHANGE_TEXTS_H

#include "base/text_buffer.h"
#include "exchange/bodies.h"
#include "exchange/loads.h"
#include "exchange/motion_source.h"

/* First characters of an OpenSim model and of a URDF that ambulo wrote, behind the declaration. */
#define AMBULO__XML_MARK "<!-- ambulo "

/* <OpenSimDocument> of ambulo__bodies_merged (osim_text.c). */
void ambulo__export_osim(const ambulo__bodies *bodies, ambulo__text_buffer *text);
/* <robot> of ambulo__bodies_single. */
void ambulo__export_urdf(const ambulo__bodies *bodies, ambulo__text_buffer *text);
/* The name of a body in the file: the ground's is the program's own. */
const char *ambulo__export_name(const ambulo__bodies *bodies, int body);

/* opensim_motion.c: motion.mot, grf.mot, external_loads.xml. */
void ambulo__mot_text(const ambulo__bodies *bodies, const ambulo__source *source,
                      ambulo__text_buffer *text);
void ambulo__grf_text(const ambulo__bodies *bodies, const double *time, const ambulo__loads *loads,
                      ambulo__text_buffer *text);
void ambulo__external_loads_text(const ambulo__bodies *bodies, const ambulo__loads *loads,
                                 ambulo__text_buffer *text);

#endif
