/* show/versions.c - what is running: this library and the ones below it. */
#include "ambulo/tools/tools.h"

#include <nlopt.h>
#include <stdio.h>
#include <string.h>
#include <yaml.h>

/* Only OpenBLAS has it; with another BLAS the symbol stays undefined and its address NULL. */
extern char *openblas_get_config(void) __attribute__((weak));

/* "OpenBLAS 0.3.21 NO_LAPACKE ..." -> "OpenBLAS 0.3.21" */
static void blas_version(char *text, size_t size) {
  const char *config = openblas_get_config ? openblas_get_config() : "unnamed BLAS";
  const char *space = strchr(config, ' ');
  space = space ? strchr(space + 1, ' ') : NULL;
  int length = space ? (int)(space - config) : (int)strlen(config);
  snprintf(text, size, "%.*s", length, config);
}

void ambulo_versions_get(ambulo_versions *versions) {
  int major, minor, patch;
  snprintf(versions->ambulo, sizeof versions->ambulo, "%s", ambulo_version());
  nlopt_version(&major, &minor, &patch);
  snprintf(versions->nlopt, sizeof versions->nlopt, "%d.%d.%d", major, minor, patch);
  yaml_get_version(&major, &minor, &patch);
  snprintf(versions->libyaml, sizeof versions->libyaml, "%d.%d.%d", major, minor, patch);
  blas_version(versions->blas, sizeof versions->blas);
  snprintf(versions->instruction_set, sizeof versions->instruction_set, "%s",
           ambulo_instruction_set());
}
