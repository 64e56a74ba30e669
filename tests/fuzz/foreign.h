/* tests/fuzz/foreign.h - targets: files of other programs, and tables. */
#ifndef AMBULO_TESTS_FUZZ_FOREIGN_H
#define AMBULO_TESTS_FUZZ_FOREIGN_H

#include "texts.h"

/* OpenSim, URDF or MuJoCo, as the first element says */
static void fuzz_import(unsigned choice, const char *bytes, size_t length) {
  static const ambulo_import_root roots[] = {AMBULO_ROOT_AS_IS, AMBULO_ROOT_FREE,
                                             AMBULO_ROOT_FIXED};
  fuzz_call call = fuzz_begin();
  char *text = NULL;
  ambulo_model *model = NULL;
  ambulo_import_options options = ambulo_import_options_default();
  options.root = roots[choice % 3];
  options.unlock = choice >> 2 & 1;
  options.repair_inertia = choice >> 3 & 1;
  ambulo_status status = ambulo_import_model(fuzz_put("m.xml", bytes, length), NULL, &options,
                                             &fuzz_memory, call.list, &text);
  fuzz_status(&call, status);
  if (!status)
    status =
        ambulo_model_load_text(text, strlen(text), "i.yaml", NULL, &fuzz_memory, call.list, &model);
  fuzz_status(&call, status); /* what the body lacks may still be refused there, in words */
  if (model) fuzz_move(model);
  ambulo_model_free(model);
  fuzz_free_text(text);
  fuzz_end(&call);
}

static void fuzz_mesh(unsigned choice, const char *bytes, size_t length) {
  static const char robot[] =
      "<robot name='r'><link name='base'><inertial><mass value='1'/><inertia ixx='1' iyy='1' "
      "izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link><link name='left_foot'><inertial><mass "
      "value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial><collision>"
      "<geometry><mesh filename='m.stl'/></geometry></collision></link><joint name='j' "
      "type='revolute'><parent link='base'/><child link='left_foot'/><axis xyz='0 1 0'/><limit "
      "lower='-1' upper='1' effort='1' velocity='1'/></joint></robot>";
  fuzz_call call = fuzz_begin();
  char *text = NULL;
  (void)choice;
  (void)fuzz_put("m.stl", bytes, length);
  ambulo_status status = ambulo_import_model(fuzz_put("mesh.urdf", robot, sizeof robot - 1), NULL,
                                             NULL, &fuzz_memory, call.list, &text);
  fuzz_status(&call, status);
  fuzz_free_text(text);
  fuzz_end(&call);
}

/* -------------------------------------------------------------- tables of motions */

static ambulo_model *fuzz_body;

static void fuzz_open_body(void) {
  fuzz_open_rod();
  if (ambulo_model_load(fuzz_path("walker_2d.yaml"), NULL, NULL, NULL, &fuzz_body))
    fuzz_fault("walker_2d.yaml", "not read");
}

static const char *fuzz_table(unsigned choice, const char *bytes, size_t length) {
  static const char *const names[] = {"m.csv", "m.sto", "m.mot"};
  return fuzz_put(names[choice % 3], bytes, length);
}

static void fuzz_motion(unsigned choice, const char *bytes, size_t length) {
  fuzz_call call = fuzz_begin();
  char *text = NULL;
  ambulo_ground_residual residual;
  ambulo_inverse_options options = ambulo_inverse_options_default();
  ambulo_inverse_outputs outputs = ambulo_inverse_outputs_default();
  const char *path = fuzz_table(choice, bytes, length);
  options.recompute_rates = choice >> 2 & 1;
  if (choice & 8) options.cutoff = 6.0;
  if (choice & 16) {
    options.forces = path;
    outputs.residual = &residual;
  }
  outputs.text = &text;
  ambulo_status status = ambulo_inverse_dynamics_motion(fuzz_body, path, NULL, &options,
                                                        &fuzz_memory, call.list, &outputs);
  fuzz_status(&call, status);
  fuzz_free_text(text);
  fuzz_end(&call);
}

static void fuzz_export(unsigned choice, const char *bytes, size_t length) {
  fuzz_call call = fuzz_begin();
  ambulo_export_options options = ambulo_export_options_default();
  int npz = choice >> 2 & 1;
  options.overwrite = 1;
  options.format = npz ? AMBULO_EXPORT_NPZ : AMBULO_EXPORT_OPENSIM;
  ambulo_status status =
      ambulo_export(fuzz_body, fuzz_table(choice, bytes, length), fuzz_path(npz ? "o.npz" : "o"),
                    &options, &fuzz_memory, call.list);
  fuzz_status(&call, status);
  fuzz_end(&call);
}

static void fuzz_loads(unsigned choice, const char *bytes, size_t length) {
  fuzz_call call = fuzz_begin();
  char *forces = NULL, *columns = NULL;
  (void)choice;
  ambulo_status status = ambulo_import_external_loads(fuzz_put("l.xml", bytes, length), fuzz_body,
                                                      &fuzz_memory, call.list, &forces, &columns);
  fuzz_status(&call, status);
  fuzz_free_text(forces);
  fuzz_free_text(columns);
  fuzz_end(&call);
}

#endif
