/* show/gait_bars.c - which part of which foot is on the ground, which patch is in contact, and
 * the time axis. */
#include <string.h>

#include "contact/effector.h"
#include "model/neutral_pose.h"
#include "show/gait_svg.h"
#include "show/skeleton.h"
#include "show/svg.h"

enum { BAR_SAMPLES = 2400 };
static const double bar_height = 14.0, bar_pitch = 19.0;

static const char *const side_bar[] = {"trunk-bar", "left-bar", "right-bar"};
static const char *const side_partial[] = {"trunk-bar partial", "left-bar partial",
                                           "right-bar partial"};
static const char *const side_text[] = {"panel end", "left-text end", "right-text end"};
static const char *const mode_words[] = {"", "heel", "flat", "toe", "down"};
static const double in_the_middle = 1e-3; /* m */

/* -1 in the air */
static int mode_at(const ambulo__stride *stride, int effector, double t) {
  const ambulo_contact *contact = ambulo__stride_contact(stride, effector, t);
  return contact ? (int)contact->mode : -1;
}

static void draw_span(const ambulo__panel *panel, double y, double from, double to, int mode,
                      ambulo__side side, ambulo__text_buffer *text) {
  double x = ambulo__panel_time(panel, from), width = ambulo__panel_time(panel, to) - x;
  int whole = mode == AMBULO_CONTACT_FLAT || mode == AMBULO_CONTACT_PATCH;
  ambulo__svg_rectangle(text, whole ? side_bar[side] : side_partial[side], x, y, width, bar_height);
  if (width > 30.0)
    ambulo__svg_label(text, "inbar", x + width / 2.0, y + bar_height - 3.5, mode_words[mode]);
}

static void draw_bar(const ambulo__stride *stride, int effector, ambulo__side side, double y,
                     const ambulo__panel *panel, ambulo__text_buffer *text) {
  ambulo__svg_rectangle(text, "lane", panel->x, y, panel->width, bar_height);
  int mode = mode_at(stride, effector, 0.0);
  double from = 0.0;
  for (int k = 1; k <= BAR_SAMPLES; k++) {
    double t = stride->duration * (double)k / (double)BAR_SAMPLES;
    int now = k == BAR_SAMPLES ? -2 : mode_at(stride, effector, t);
    if (now == mode) continue;
    if (mode >= 0) draw_span(panel, y, from, t, mode, side, text);
    mode = now;
    from = t;
  }
}

int ambulo__gait_shows(const ambulo__stride *stride, int effector) {
  int patch = ambulo__effector_patch(stride->model, effector);
  return patch < 0 || ambulo__patch_is_used(&stride->problem->definition, patch);
}

/* a foot's by its name, a patch's by where its middle is at q = 0 */
static ambulo__side side_of(const ambulo_model *model, int effector) {
  const char *name = ambulo__effector_name(model, effector);
  int patch = ambulo__effector_patch(model, effector);
  if (patch >= 0) return ambulo__gait_patch_side(model, patch);
  if (strstr(name, "right") || !strcmp(name, "r")) return AMBULO__RIGHT;
  return strstr(name, "left") || !strcmp(name, "l") ? AMBULO__LEFT : AMBULO__MIDDLE;
}

ambulo__side ambulo__gait_patch_side(const ambulo_model *model, int patch) {
  double r[3];
  ambulo__neutral_point(model, model->patches[patch].point, r);
  double aside = r[0] * model->left[0] + r[1] * model->left[1] + r[2] * model->left[2];
  if (aside > in_the_middle) return AMBULO__LEFT;
  return aside < -in_the_middle ? AMBULO__RIGHT : AMBULO__MIDDLE;
}

double ambulo__gait_bars(const ambulo__stride *stride, const ambulo__panel *panel,
                         ambulo__text_buffer *text) {
  const ambulo_model *model = stride->model;
  if (ambulo_problem_contact_count(stride->problem) == 0) return 0.0;
  double y = panel->y;
  for (int e = 0; e < ambulo__effector_count(model); e++) {
    if (!ambulo__gait_shows(stride, e)) continue;
    ambulo__side side = side_of(model, e);
    draw_bar(stride, e, side, y, panel, text);
    ambulo__svg_label_within(text, side_text[side], panel->x - 10.0, y + bar_height - 3.0,
                             panel->x - 14.0, 12.0, ambulo__effector_name(model, e));
    y += bar_pitch;
  }
  return y - panel->y;
}

void ambulo__time_axis(const ambulo__panel *panel, int parts, const char *unit,
                       ambulo__text_buffer *text) {
  int decimals;
  double step = ambulo__nice_step(panel->duration, parts, &decimals);
  ambulo__text_buffer label;
  ambulo__text_init_part(&label, text);
  ambulo__svg_line(text, "axis", panel->x, panel->y, panel->x + panel->width, panel->y);
  int last = (int)(panel->duration / step + 1e-6);
  for (int i = 0; i <= last; i++) {
    double t = (double)i * step, x = ambulo__panel_time(panel, t);
    ambulo__svg_line(text, "axis", x, panel->y, x, panel->y + 4.0);
    ambulo__text_clear(&label);
    ambulo__label_number(&label, t, decimals);
    if (i == last && unit) ambulo__text_append_format(&label, " %s", unit);
    ambulo__svg_label(text, "middle", x, panel->y + 18.0, ambulo__text_data(&label));
  }
  ambulo__text_free(&label);
}
