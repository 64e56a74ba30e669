/* What --symmetrize refuses: each kind of difference beyond its limit, with both names. */
#include "support/import_case.h"

#define INERTIAL(at, mass, moments)                                                                \
  "<inertial pos='" at "' mass='" mass "' diaginertia='" moments "'/>"

/* two arms on a trunk of 5 kg; the body is 1 m wide, its places may differ by 20 mm */
static void arms(void **state, const char *right, ambulo_status status, const char *want) {
  ambulo_import_options o = ambulo_import_options_default();
  o.symmetrize = 1;
  char text[2400];
  (void)snprintf(
      text, sizeof text,
      "<mujoco><worldbody><body name='trunk'><freejoint name='root'/>" INERTIAL(
          "0 0 0", "5",
          ".1 .1 .1") "<body name='arm_l' pos='0 .5 0'><joint name='arm_l' axis='1 0 "
                      "0'/>" INERTIAL("0 .1 0", "1",
                                      ".1 .1 .02") "</body>%s</body></worldbody></mujoco>",
      right);
  import_case c = import_text(state, text, &o);
  if (c.status != status) import_print(&c);
  assert_int_equal(c.status, status);
  if (status) assert_null(c.text);
  if (want) assert_told(&c, want);
  import_shut(&c);
}

#define ARM(at, axis, inertial)                                                                    \
  "<body name='arm_r' pos='" at "'><joint name='arm_r' axis='" axis "'/>" inertial "</body>"
#define SAME INERTIAL("0 -.1 0", "1", ".1 .1 .02")

static void each_limit(void **state) {
  static const struct {
    const char *good, *bad, *want;
  } cases[] = {
      {ARM("0 -.5 .015", "1 0 0", SAME), ARM("0 -.5 .025", "1 0 0", SAME),
       "'arm_l' and 'arm_r' differ too much (got 0.025 m between joints); expected at most 0.02"},
      {ARM("0 -.5 0", "1 0 0", INERTIAL("0 -.1 0", "1.09", ".1 .1 .02")),
       ARM("0 -.5 0", "1 0 0", INERTIAL("0 -.1 0", "1.2", ".1 .1 .02")),
       "differ too much (got 0.2 kg); expected at most 0.11"},
      {ARM("0 -.5 0", "1 0 0", INERTIAL(".015 -.1 0", "1", ".1 .1 .02")),
       ARM("0 -.5 0", "1 0 0", INERTIAL(".025 -.1 0", "1", ".1 .1 .02")),
       "differ too much (got 0.025 m between centres of mass); expected at most 0.02"},
      {ARM("0 -.5 0", "1 0 0", INERTIAL("0 -.1 0", "1", ".12 .12 .02")),
       ARM("0 -.5 0", "1 0 0", INERTIAL("0 -.1 0", "1", ".15 .15 .02")),
       "differ too much (got 0.05 kg m^2); expected at most 0.0375"},
      {ARM("0 -.5 0", "1 0 .08", SAME), ARM("0 -.5 0", "1 0 .12", SAME),
       "between unit vectors along their axes); expected at most 0.09"},
  };
  for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
    arms(state, cases[i].good, AMBULO_OK, NULL);
    arms(state, cases[i].bad, AMBULO_E_MODEL, cases[i].want);
  }
}

/* an arm on one side alone, and one that hangs on another link */
static void no_images(void **state) {
  arms(state, "", AMBULO_E_MODEL,
       "'arm_l' and its own image 'arm_l' differ too much (got 0.5 m between joints)");
  arms(state,
       "<body name='plate'><joint name='plate' axis='0 1 0'/>" INERTIAL("0 0 0", "1", ".1 .1 .1")
           ARM("0 -.5 0", "1 0 0", SAME) "</body>",
       AMBULO_E_MODEL, "'arm_l' and 'arm_r' are no images (they hang on different links");
}

int main(void) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(each_limit), cmocka_unit_test(no_images)};
  return cmocka_run_group_tests(tests, scratch_open, scratch_close);
}
