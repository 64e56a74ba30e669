/* ambulo/tools/export.h - models and motions for other programs: OpenSim, URDF, NumPy's .npz.
 *
 * What comes out moves as the model does: the same mass matrix, coordinates of the same names
 * (docs/guide-export.md). The world is turned to the other program's axes: OpenSim's ground has y
 * up, a URDF's world z up, both x near forward.
 *
 * A tool around the engine: outside the promise of ambulo/ambulo.h. It may change with any release.
 */
#ifndef AMBULO_TOOLS_EXPORT_H
#define AMBULO_TOOLS_EXPORT_H

#include "ambulo/tools/inverse.h"
#include "ambulo/problem.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum ambulo_export_format {
  AMBULO_EXPORT_FORMAT_NOT_SET = 0, /* refused */
  AMBULO_EXPORT_OPENSIM, /* without a motion the file .osim; with one a folder: model.osim,
                            motion.mot and, where there are forces, grf.mot and
                            external_loads.xml */
  AMBULO_EXPORT_URDF,    /* a file; no motion */
  AMBULO_EXPORT_NPZ      /* a file: the motion in the coordinates of Pinocchio and MuJoCo, whose
                            root is one free joint */
} ambulo_export_format;

typedef struct ambulo_export_options {
  size_t size; /* set by ambulo_export_options_default() */
  ambulo_export_format format;
  int free_root; /* URDF: 1: without the coordinates that carry the root, for programs that give it
                    a free joint of their own (as the motion of an .npz has it) */
  int overwrite; /* 1: `output` may be any file, or a folder that an export made */
  const ambulo_inverse_options *inverse; /* how the motion is read; NULL: the defaults */
  /* What the motion is a solution of: forces of patches, of hands that hold something and of
   * devices are read from the motion's columns, exported with those of the feet, and taken off the
   * torques. Its body must have the model's links. NULL: those of the feet alone, with a warning
   * where the motion has others */
  const ambulo_problem *problem;
} ambulo_export_options;
AMBULO_TOOL_DEFAULT(ambulo_export_options); /* OpenSim */

/* Writes `output`, whole or not at all. `motion`: a table as of ambulo_inverse_dynamics_motion, or
 * a result folder, whose motion.csv is taken; NULL: the model alone (not with NPZ). `options`,
 * `allocator`, `diagnostics` may be NULL. Errors: E_ARGUMENT, E_IO, E_PARSE, E_SCHEMA, E_MODEL (a
 * name that the other program has for itself; of a URDF's free root: there is none), E_LIMIT,
 * E_NUMERIC, E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_export(const ambulo_model *model,
                                                        const char *motion, const char *output,
                                                        const ambulo_export_options *options,
                                                        const ambulo_allocator *allocator,
                                                        ambulo_diagnostics *diagnostics);

#ifdef __cplusplus
}
#endif
#endif
