/* picture/gait_bars.c - which part of which foot is on the ground, and the time axis. */
#include <string.h>

#include "picture/gait_svg.h"
#include "picture/skeleton.h"
#include "picture/svg.h"

enum { BAR_SAMPLES = 2400 };
static const double bar_height = 14.0, bar_pitch = 19.0;

static const char *const side_bar[] = {"trunk-bar", "left-bar", "right-bar"};
static const char *const side_partial[] = {"trunk-bar partial", "left-bar partial",
                                           "right-bar partial"};
static const char *const side_text[] = {"panel end", "left-text end", "right-text end"};
static const char *const mode_words[] = {"heel", "flat", "toe"};

/* -1 in the air */
static int mode_at(const ambulo__stride *stride, int foot, double t) {
  ambulo_contact_mode mode;
  return ambulo__stride_contact(stride, foot, t, &mode) ? (int)mode : -1;
}

static void draw_span(const ambulo__panel *panel, double y, double from, double to, int mode,
                      ambulo__side side, ambulo__text_buffer *text) {
  double x = ambulo__panel_time(panel, from), width = ambulo__panel_time(panel, to) - x;
  ambulo__svg_rectangle(text, mode == AMBULO_CONTACT_FLAT ? side_bar[side] : side_partial[side], x,
                        y, width, bar_height);
  if (width > 30.0)
    ambulo__svg_label(text, "inbar", x + width / 2.0, y + bar_height - 3.5, mode_words[mode]);
}

static void draw_bar(const ambulo__stride *stride, int foot, ambulo__side side, double y,
                     const ambulo__panel *panel, ambulo__text_buffer *text) {
  ambulo__svg_rectangle(text, "lane", panel->x, y, panel->width, bar_height);
  int mode = mode_at(stride, foot, 0.0);
  double from = 0.0;
  for (int k = 1; k <= BAR_SAMPLES; k++) {
    double t = stride->duration * (double)k / (double)BAR_SAMPLES;
    int now = k == BAR_SAMPLES ? -2 : mode_at(stride, foot, t);
    if (now == mode) continue;
    if (mode >= 0) draw_span(panel, y, from, t, mode, side, text);
    mode = now;
    from = t;
  }
}

double ambulo__gait_bars(const ambulo__stride *stride, const ambulo__panel *panel,
                         ambulo__text_buffer *text) {
  const ambulo_model *model = stride->model;
  if (ambulo_problem_contact_count(stride->problem) == 0) return 0.0;
  double y = panel->y;
  for (int f = 0; f < model->foot_count; f++) {
    ambulo__side side = AMBULO__MIDDLE;
    if (strstr(model->feet[f].name, "left") || !strcmp(model->feet[f].name, "l"))
      side = AMBULO__LEFT;
    if (strstr(model->feet[f].name, "right") || !strcmp(model->feet[f].name, "r"))
      side = AMBULO__RIGHT;
    draw_bar(stride, f, side, y, panel, text);
    ambulo__svg_label(text, side_text[side], panel->x - 10.0, y + bar_height - 3.0,
                      model->feet[f].name);
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
