/* inverse_motion.c - joint torques of a measured motion, from the arrays that a program has.
 *
 *     cc inverse_motion.c $(pkg-config --cflags --libs ambulo) -lm -o inverse_motion
 *     ./inverse_motion
 *
 * The motion stands for what a laboratory measured: angles of a swinging rod at 100 Hz, with the
 * noise of markers. Rates come from the angles by a low-pass filter and a spline, which is what
 * ambulo_inverse_dynamics_motion does with a file; torques are set beside those of the swing that
 * the angles were made of. */
#include <ambulo/tools/tools.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROWS = 201 };
static const double rate = 100.0, amplitude = 0.6, omega = 4.0, noise = 0.002;

/* q, qd and qdd of the swing that is measured, rad and s */
static void swing(double t, double state[3]) {
  state[0] = amplitude * sin(omega * t);
  state[1] = amplitude * omega * cos(omega * t);
  state[2] = -omega * omega * state[0];
}

static double noise_of(int row) {
  return noise * sin(12.9898 * row * row);
}

/* the measured angles as a table in degrees, as motion capture has them */
static int write_motion(const char *path) {
  FILE *file = fopen(path, "w");
  if (!file) return 0;
  fprintf(file, "time,swing\n");
  for (int i = 0; i < ROWS; i++) {
    double state[3];
    swing(i / rate, state);
    fprintf(file, "%.4f,%.6f\n", i / rate, (state[0] + noise_of(i)) * 57.29577951308232);
  }
  return fclose(file) == 0;
}

/* the same angles and rates without noise, through the arrays: what the torques should be */
static ambulo_status exact(const ambulo_model *model, double *tau) {
  ambulo_mechanics *mechanics = NULL;
  static double q[ROWS], qd[ROWS], qdd[ROWS]; /* [nodes][coordinates] */
  for (int i = 0; i < ROWS; i++) {
    double state[3];
    swing(i / rate, state);
    q[i] = state[0];
    qd[i] = state[1];
    qdd[i] = state[2];
  }
  ambulo_outputs outputs = ambulo_outputs_default();
  outputs.tau = tau;
  ambulo_status status = ambulo_mechanics_create(model, NULL, &mechanics);
  if (!status) status = ambulo_mechanics_inverse_dynamics(mechanics, ROWS, q, qd, qdd, &outputs);
  ambulo_mechanics_free(mechanics);
  return status;
}

/* the column tau.swing of the table; the first of its rows is at *text */
static double difference(const char *text, const double *tau) {
  double sum = 0.0;
  int column = 4, row = 0; /* time, q, qd, qdd, tau */
  for (const char *line = text; line && *line; line = strchr(line, '\n')) {
    if (*line == '\n') line++;
    if (*line != '0' && *line != '1' && *line != '2') continue; /* a comment, or the names */
    const char *at = line;
    for (int i = 0; i < column; i++) at = strchr(at, ',') + 1;
    double d = strtod(at, NULL) - tau[row];
    if (row >= 20 && row < ROWS - 20) sum += d * d; /* filters are poor at the ends */
    row++;
  }
  return row == ROWS ? sqrt(sum / (ROWS - 40)) : (double)NAN;
}

int main(void) {
  ambulo_model *model = NULL;
  ambulo_diagnostics *messages = ambulo_diagnostics_create(NULL);
  static double tau[ROWS];
  char *text = NULL;
  ambulo_status status = ambulo_model_load("models/pendulum.yaml", NULL, NULL, messages, &model);
  if (!status && !write_motion("swing.csv")) status = AMBULO_E_IO;
  if (!status) status = exact(model, tau);

  const double cutoffs[2] = {AMBULO_OFF, 6.0}; /* Hz */
  ambulo_inverse_outputs outputs = ambulo_inverse_outputs_default();
  outputs.text = &text;
  for (int i = 0; i < 2 && !status; i++) {
    ambulo_inverse_options options = ambulo_inverse_options_default();
    options.angles = AMBULO_ANGLES_DEGREES;
    options.cutoff = cutoffs[i];
    status = ambulo_inverse_dynamics_motion(model, "swing.csv", NULL, &options, NULL, messages,
                                            &outputs);
    if (status) break;
    printf("%s: torque off by %.2f N m (root mean square)\n",
           isnan(cutoffs[i]) ? "no filter" : "cut-off 6 Hz", difference(text, tau));
    ambulo_text_free(text, NULL);
  }
  for (size_t i = 0; status && i < ambulo_diagnostics_count(messages); i++)
    fprintf(stderr, "%s\n", ambulo_diagnostics_get(messages, i)->message);
  ambulo_model_free(model);
  ambulo_diagnostics_free(messages);
  return ambulo_status_exit_code(status);
}
