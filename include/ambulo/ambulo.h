/* ambulo/ambulo.h - Ambulo: prediction of human motion by optimization. The engine.
 *
 *     status.h       status codes, messages, allocator, structures that callers fill
 *     model.h        the skeleton (immutable)
 *     mechanics.h    inverse dynamics of given motions, in batches
 *     problem.h      what to minimize, subject to what (immutable)
 *     objective.h    parts of a problem: terms, functions of the caller
 *     ground.h       parts of a problem: the ground's force, feet in the air
 *     device.h       parts of a problem: springs, dampers and actuators that the body wears
 *     hold.h         parts of a problem: what hands hold or push
 *     collision.h    parts of a problem: capsules, obstacles, places to reach
 *     extend.h       terms and rows added to an existing problem
 *     evaluate.h     a problem at one point: values, gradients, the motion
 *     solve.h        the solver, the verdict and the audit
 *     again.h        solving again beside a solution
 *     sensitivity.h  derivatives of the optimum with respect to each number of a problem
 *     parameters.h   numbers of a problem that the solver chooses
 *
 * Stability: these headers are stable. A program that compiles and links with one release also does
 * so with every later release of the same major version (in 0.x: of the same minor version).
 * Files, results on disk, pictures, batches and imports are tools around the engine. Their headers,
 * ambulo/tools/tools.h and those it includes, are outside this promise.
 *
 * Lifecycle:  model/problem --load or create--> solve --> result --> free
 *
 * Threads: models and problems may be shared. Workspaces, diagnostics and results belong to one
 * thread at a time. The library has no global state, never prints and never exits.
 *
 * OpenBLAS starts a thread per core unless OPENBLAS_NUM_THREADS=1 is set before the process starts.
 * The matrices here are too small to gain from threads. Set the variable if the processor lacks
 * AVX2 or bodies have more than 21 coordinates; otherwise solves do not use those threads. The
 * library does not set it, because it applies to the whole process.
 */
#ifndef AMBULO_AMBULO_H
#define AMBULO_AMBULO_H

/* Version of these headers; ambulo_version() returns that of the running library. */
#define AMBULO_VERSION_MAJOR 0
#define AMBULO_VERSION_MINOR 2
#define AMBULO_VERSION_PATCH 0
#define AMBULO_VERSION_STRING "0.2.0"

#include "ambulo/again.h"
#include "ambulo/collision.h"
#include "ambulo/device.h"
#include "ambulo/evaluate.h"
#include "ambulo/extend.h"
#include "ambulo/ground.h"
#include "ambulo/hold.h"
#include "ambulo/mechanics.h"
#include "ambulo/model.h"
#include "ambulo/muscles.h"
#include "ambulo/objective.h"
#include "ambulo/parameters.h"
#include "ambulo/problem.h"
#include "ambulo/sensitivity.h"
#include "ambulo/solve.h"
#include "ambulo/status.h"

#ifdef __cplusplus
extern "C" {
#endif
/* The version of the running library, "MAJOR.MINOR.PATCH"; a static string. */
AMBULO_API const char *ambulo_version(void);
#ifdef __cplusplus
}
#endif
#endif
