/* ambulo/ambulo.h - Ambulo: prediction of human motion by optimization.
 *
 *     model.h      the skeleton (immutable)
 *     mechanics.h  inverse dynamics of given motions, in batches
 *     problem.h    what to minimize, subject to what (immutable)
 *     extend.h     terms and rows added to a problem, one of a file too
 *     evaluate.h   what a problem says of one point: values, gradients, the motion
 *     solve.h      the solver, the verdict and the audit
 *     sensitivity.h  what each number of a problem costs
 *     parameters.h   numbers of a problem that the solver chooses
 *     objective.h  parts of a problem: terms, functions of the caller
 *     ground.h     parts of a problem: the ground's force, feet in the air
 *     hold.h       parts of a problem: what hands hold or push
 *     collision.h  parts of a problem: capsules, obstacles, places to reach
 *     report.h     results on disk, comparison with people
 *     page.h       results to watch, as one HTML file
 *     picture.h    results as pictures: SVG, PDF, PNG
 *     inverse.h    inverse dynamics of motions in files
 *     batch.h      many problems: sweeps
 *     export.h     models and motions for OpenSim, URDF and NumPy
 *     import.h     models of OpenSim, URDF and MuJoCo
 *     status.h     status codes, messages, allocator
 *
 * Lifecycle:  model/problem --load or create--> solve --> result --> report --> free
 *
 * Threads: models and problems may be shared; workspaces, diagnostics and results
 * belong to one thread at a time. The library has no global state, never prints and
 * never exits. OpenBLAS starts a thread per core unless OPENBLAS_NUM_THREADS=1 is set
 * before the process starts. The matrices here are too small to gain from them: set it
 * where AVX2 is missing or bodies have more than 21 coordinates, otherwise solves do not
 * wake them. The library does not change it, for it is a setting of the whole process.
 */
#ifndef AMBULO_AMBULO_H
#define AMBULO_AMBULO_H

/* Of these headers; ambulo_version() is that of the library that is running. */
#define AMBULO_VERSION_MAJOR 0
#define AMBULO_VERSION_MINOR 2
#define AMBULO_VERSION_PATCH 0
#define AMBULO_VERSION_STRING "0.2.0"

#include "ambulo/batch.h"
#include "ambulo/collision.h"
#include "ambulo/device.h"
#include "ambulo/evaluate.h"
#include "ambulo/extend.h"
#include "ambulo/fit.h"
#include "ambulo/ground.h"
#include "ambulo/hold.h"
#include "ambulo/export.h"
#include "ambulo/import.h"
#include "ambulo/inverse.h"
#include "ambulo/mechanics.h"
#include "ambulo/model.h"
#include "ambulo/objective.h"
#include "ambulo/page.h"
#include "ambulo/parameters.h"
#include "ambulo/picture.h"
#include "ambulo/problem.h"
#include "ambulo/report.h"
#include "ambulo/sensitivity.h"
#include "ambulo/solve.h"
#include "ambulo/status.h"

#ifdef __cplusplus
extern "C" {
#endif
/* The version of the library that is running. */
AMBULO_API const char *ambulo_version(void);
#ifdef __cplusplus
}
#endif
#endif
