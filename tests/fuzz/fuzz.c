/* tests/fuzz/fuzz.c - one target (FUZZ_TARGET) for libFuzzer; `make fuzz` builds and runs all. */
#include "mutate.h"
#include "targets.h"

#define QUOTED(name) #name
#define TEXT_OF(name) QUOTED(name)

size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t most);
int LLVMFuzzerInitialize(int *argc, char ***argv);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static const fuzz_target *target;

static void close_folder(void) {
  (void)scratch_close(&fuzz_state);
}

int LLVMFuzzerInitialize(int *argc, char ***argv) {
  (void)argc, (void)argv;
  for (int i = 0; i < FUZZ_TARGETS; i++)
    if (strcmp(fuzz_targets[i].name, TEXT_OF(FUZZ_TARGET)) == 0) target = &fuzz_targets[i];
  if (!target || scratch_open(&fuzz_state)) abort();
  (void)atexit(close_folder);
  if (target->open) target->open();
  return 0;
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed) {
  uint32_t state = seed * 2654435761U + 1;
  if (size < 3 || mutate_draw(&state, 3) == 0) return LLVMFuzzerMutate(data, size, most);
  return mutate(data, size, most, &state);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  fuzz_run(target, data, size);
  return 0;
}
