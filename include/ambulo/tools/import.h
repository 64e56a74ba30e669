/* ambulo/tools/import.h - models of other programs: OpenSim (.osim), URDF and MuJoCo (.xml) to
 * YAML.
 *
 * What comes out is the text of a model file (docs/model-format.md) that loads, with comments that
 * say where it came from and what could not be carried over (docs/guide-import.md). Files are XML
 * and read with expat, an optional library: without it every file is E_IO.
 *
 * A tool around the engine: outside the promise of ambulo/ambulo.h. It may change with any release.
 */
#ifndef AMBULO_TOOLS_IMPORT_H
#define AMBULO_TOOLS_IMPORT_H

#include "ambulo/model.h"
#include "ambulo/tools/common.h"

#ifdef __cplusplus
extern "C" {
#endif

/* How the root of a body without a joint to the world hangs on it. OpenSim and MuJoCo models say
 * it themselves; a URDF does not. */
typedef enum ambulo_import_root {
  AMBULO_ROOT_AS_IS = 0, /* as the source says; of a URDF: free, unless its root is named `world` */
  AMBULO_ROOT_FREE,      /* on three sliders and three hinges */
  AMBULO_ROOT_FIXED
} ambulo_import_root;

typedef struct ambulo_import_options {
  size_t size;      /* set by ambulo_import_options_default() */
  const char *name; /* of the model; NULL: as the source */
  ambulo_import_root root;
  /* "COORDINATE=VALUE", rad or m: where coordinates that drive a spline, that others follow or that
   * are held stand; elsewhere the source's default value, or 0. */
  const char *const *pose;
  int pose_count;
  /* "FOOT=LINK": a foot, whose corners come from the geometry of a link. None: links whose names
   * say so, else the lowest of each leg. */
  const char *const *feet;
  int foot_count;
  /* "FOOT=LINK:X,Y,Z" or, with two corners, "FOOT=LINK:X,Y,Z:X,Y,Z", m: corners by hand. */
  const char *const *heels;
  int heel_count;
  const char *const *toes;
  int toe_count;
  int unlock;         /* 1: coordinates that the source locks become coordinates all the same */
  int repair_inertia; /* 1: an inertia that no body can have is raised to the nearest possible */
  int overwrite;      /* 1: `output` may be a file that is there and not empty */
  /* Where the body goes, in the source's world: "x", "-x", "y", ... or "X,Y,Z". NULL: as names of
   * left and right say, else heels and toes. */
  const char *forward;
  int symmetrize; /* 1: left and right become exact images, where they nearly are */
} ambulo_import_options;
AMBULO_TOOL_DEFAULT(ambulo_import_options);

/* Reads a model file of another program, whose format its root element tells, and writes a model
 * file to `output` (whole or not at all), or returns its text in *text, to be freed with
 * ambulo_text_free, when output is NULL. What was left out or changed is a warning each, and a
 * comment in the file. `options` (NULL: defaults), `allocator`, `diagnostics` and `text` (with an
 * output) may be NULL. What the body looks like is written beside an output that ends in .yaml: the
 * triangles of robot.yaml to robot.meshes, which only a page shows; with `overwrite` it takes the
 * place of a file that is there.
 * Errors: E_ARGUMENT, E_IO (also: built without expat), E_PARSE, E_SCHEMA, E_MODEL, E_LIMIT,
 * E_MEMORY. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_import_model(const char *path, const char *output,
                                                              const ambulo_import_options *options,
                                                              const ambulo_allocator *allocator,
                                                              ambulo_diagnostics *diagnostics,
                                                              char **text);

typedef struct ambulo_walk_options {
  size_t size;         /* set by ambulo_walk_options_default() */
  double speed;        /* m/s; AMBULO_OFF: by the legs, or by the step */
  double step_length;  /* m; AMBULO_OFF: by the legs, or by the speed. On four feet: of a stride */
  const char *model;   /* how the problem names the model; NULL: by its file's name */
  const char *shipped; /* folder of the shipped problems: models of people, by the names of their
                          coordinates, take the weights of walk.yaml or walk_whole_body.yaml there;
                          NULL: they walk as robots do */
  const char *gait;    /* of a body with four feet: "walk", "trot" or "bound"; NULL: "walk" */
} ambulo_walk_options;
AMBULO_TOOL_DEFAULT(ambulo_walk_options);

/* The text of a problem file, with comments, in which the body of a model file walks: one step and
 * its mirror image, or two where the sides differ; on four feet half a stride, or a whole one. Its
 * numbers follow from the mass, the legs and the feet. To be freed with ambulo_text_free. `options`
 * (NULL: defaults), `allocator` and `diagnostics` may be NULL. Errors: as ambulo_model_load;
 * E_MODEL too: not two or four feet, no legs, fixed to the world. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_walk_for(const char *model,
                                                          const ambulo_walk_options *options,
                                                          const ambulo_allocator *allocator,
                                                          ambulo_diagnostics *diagnostics,
                                                          char **text);

/* Reads an OpenSim file of external loads (<ExternalLoads>, versions 3 and 4): *forces becomes the
 * path of its table, as seen from here, *columns what of it acts on which foot of `model`, in the
 * form of ambulo_inverse_options.force_columns; both to be freed with ambulo_text_free. A force
 * belongs to the foot on whose link, or on a link fixed to it, it is applied, or, where the model
 * has no such link, to the one foot of the side that the name of a calcn, foot or toes says. Forces
 * on other bodies and those switched off are left out, with a warning. `allocator`, `diagnostics`
 * may be NULL.
 * Errors: E_ARGUMENT, E_IO (also: built without expat), E_PARSE, E_SCHEMA (also: expressed in
 * another body than ground), E_MEMORY; outputs are then untouched. */
AMBULO_NODISCARD AMBULO_API ambulo_status ambulo_import_external_loads(
    const char *path, const ambulo_model *model, const ambulo_allocator *allocator,
    ambulo_diagnostics *diagnostics, char **forces, char **columns);

#ifdef __cplusplus
}
#endif
#endif
