/* linear/parameters.h - constants of the linear algebra that shape the method. */
#ifndef AMBULO_LINEAR_PARAMETERS_H
#define AMBULO_LINEAR_PARAMETERS_H

#define AMBULO__KKT_PASSES 8
#define AMBULO__KKT_TOLERANCE 1e-11
#define AMBULO__KKT_PROGRESS 0.5
#define AMBULO__KKT_SLOW 1e-7
#define AMBULO__STIFFNESS_START 1e4
#define AMBULO__STIFFNESS_FACTOR 100.0
#define AMBULO__STIFFNESS_LARGEST 1e8
#define AMBULO__BORDER_SHIFT 1e-14
#define AMBULO__MIXING_REGULARIZATION 1e-12

#endif
