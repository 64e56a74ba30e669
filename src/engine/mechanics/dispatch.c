/* mechanics/dispatch.c - choosing a kernel set at run time.
 *
 * Nothing is cached (the library has no writable globals): callers keep the pointer.
 */
#include <stdlib.h>
#include <string.h>

#include "ambulo/mechanics.h"
#include "mechanics/kernels.h"

#if defined(__x86_64__)
static int runs_avx2(void) {
  return ambulo__kernels_avx2.forward && __builtin_cpu_supports("avx2") &&
         __builtin_cpu_supports("fma");
}

static int runs_avx512(void) {
  return ambulo__kernels_avx512.forward && __builtin_cpu_supports("avx512f") &&
         __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl") &&
         __builtin_cpu_supports("fma");
}
#endif

const ambulo__kernels *ambulo__kernels_by_name(const char *name) {
  if (!name) return NULL;
  if (!strcmp(name, "scalar")) return &ambulo__kernels_scalar;
  if (!strcmp(name, "baseline")) return &ambulo__kernels_baseline;
#if defined(__x86_64__)
  if (!strcmp(name, "avx2") && runs_avx2()) return &ambulo__kernels_avx2;
  if (!strcmp(name, "avx512") && runs_avx512()) return &ambulo__kernels_avx512;
#endif
  return NULL;
}

const ambulo__kernels *ambulo__kernels_select(void) {
  const ambulo__kernels *set = ambulo__kernels_by_name(getenv("AMBULO_ISA"));
  if (!set) set = ambulo__kernels_by_name("avx512");
  if (!set) set = ambulo__kernels_by_name("avx2");
  if (!set) set = &ambulo__kernels_baseline;
  return set;
}

const char *ambulo__instruction_set(void) {
  return ambulo__kernels_select()->name;
}
