/* tests/fuzz/folders.h - targets: files of result folders and of batches.
 *
 * One file of a folder is replaced, the others are whole. Where a seal or a checksum stands over a
 * file it is made to agree, so that what is behind is reached. */
#ifndef AMBULO_TESTS_FUZZ_FOLDERS_H
#define AMBULO_TESTS_FUZZ_FOLDERS_H

#include "formats/read_file.h"
#include "support/fake_batch.h"
#include "support/gait_folder.h"
#include "texts.h"

/* ------------------------------------------------------------------------ page */

/* a file of a folder, as it was */
typedef struct fuzz_file {
  char name[128];
  char *text;
} fuzz_file;

static fuzz_file fuzz_kept(const char *name) {
  fuzz_file file;
  (void)snprintf(file.name, sizeof file.name, "%s", name);
  file.text = read_whole(fuzz_path(name));
  return file;
}

static void fuzz_restore(const fuzz_file *file) {
  (void)fuzz_put(file->name, file->text, strlen(file->text));
}

static fuzz_file fuzz_page_files[4];

static void fuzz_open_page(void) {
  static const char *const names[] = {"r/scene.json", "r/summary.json", "r/gait.svg",
                                      "r/motion.csv"};
  ambulo_result *result = NULL;
  fuzz_open_solution();
  if (ambulo_solve(fuzz_rod, NULL, NULL, NULL, NULL, &result) ||
      ambulo_report_write(fuzz_rod, result, fuzz_path("r"), NULL, NULL, NULL))
    fuzz_fault("the result folder", "not made");
  ambulo_result_free(result);
  for (int i = 0; i < 4; i++) fuzz_page_files[i] = fuzz_kept(names[i]);
}

static void fuzz_page(unsigned choice, const char *bytes, size_t length) {
  const fuzz_file *file = &fuzz_page_files[choice % 4];
  const char *folder = fuzz_path("r");
  fuzz_call call = fuzz_begin();
  ambulo_page_options options = ambulo_page_options_default();
  options.overwrite = 1;
  (void)fuzz_put(file->name, bytes, length);
  ambulo_status status =
      ambulo_page_write(&folder, 1, fuzz_path("p.html"), &options, &fuzz_memory, call.list);
  fuzz_status(&call, status);
  fuzz_restore(file);
  fuzz_end(&call);
}

/* --------------------------------------------------------------------- compare */

static fuzz_file fuzz_gait_files[4];

static void fuzz_open_compare(void) {
  static const char *const names[] = {"g/summary.json", "g/motion.csv", "ref.csv", "map.csv"};
  fuzz_open_rod();
  if (mkdir(fuzz_path("g"), 0700)) fuzz_fault("g", "not made");
  gait_motion(fuzz_path("g"), 0.0, 1);
  gait_summary(fuzz_path("g"), "{" GAIT_BODY ", " GAIT_STRIKES "}\n");
  scratch_write(fuzz_path("ref.csv"), "# source: people\npercent,hip,hip sd,knee,knee sd\n"
                                      "0,30,5,5,4\n25,10,5,20,4\n50,-10,5,10,4\n75,20,5,60,4\n"
                                      "100,30,5,5,4\n");
  scratch_write(fuzz_path("map.csv"), "curve,reference,result,unit\nhip,hip,q.hip_flexion_l,deg\n"
                                      "knee,knee,q.knee_angle_l,deg\n");
  for (int i = 0; i < 4; i++) fuzz_gait_files[i] = fuzz_kept(names[i]);
}

static void fuzz_compare(unsigned choice, const char *bytes, size_t length) {
  const fuzz_file *file = &fuzz_gait_files[choice % 4];
  fuzz_call call = fuzz_begin();
  ambulo_comparison *comparison = NULL;
  char *text = NULL;
  ambulo_compare_options options = ambulo_compare_options_default();
  const char *whole = choice & 8 ? fuzz_path("g/motion.csv") : fuzz_path("g");
  options.map = fuzz_path("map.csv");
  if (choice & 16) options.cycles = fuzz_path("c.csv");
  options.overwrite = 1;
  (void)fuzz_put(file->name, bytes, length);
  ambulo_status status =
      ambulo_compare(whole, fuzz_path("ref.csv"), &options, &fuzz_memory, call.list, &comparison);
  fuzz_status(&call, status);
  if (!status && ambulo_comparison_json(comparison, &fuzz_memory, &text)) text = NULL;
  fuzz_free_text(text);
  ambulo_comparison_free(comparison);
  fuzz_restore(file);
  fuzz_end(&call);
}

/* ----------------------------------------------------------------------- batch */

enum { BATCH_LISTING, BATCH_CASES, BATCH_RECORD, BATCH_SUMMARY, BATCH_MOTION, BATCH_FILES };
static fuzz_file fuzz_batch_files[BATCH_FILES];

/* below `name`: the first entry whose name has this ending and is not hidden; "" none */
static void fuzz_find(const char *name, const char *ending, char *found, size_t size) {
  DIR *stream = opendir(fuzz_path(name));
  if (!stream) fuzz_fault(name, "not there");
  found[0] = '\0';
  for (struct dirent *e = readdir(stream); e; e = readdir(stream)) {
    size_t length = strlen(e->d_name), end = strlen(ending);
    if (e->d_name[0] == '.' || length < end || strcmp(e->d_name + length - end, ending) != 0)
      continue;
    (void)snprintf(found, size, "%s/%s", name, e->d_name);
    break;
  }
  (void)closedir(stream);
}

static void fuzz_open_batch(void) {
  fake_batch batch;
  char fan[100], record[128], name[160];
  if (fake_batch_open(&batch, &fuzz_state,
                      "axes:\n  - {key: time.duration, values: [1, 1.1]}\n"
                      "outputs: [objective, max(tau.pin)]\n"))
    fuzz_fault("the batch", "not run");
  fake_batch_close(&batch);
  fuzz_find("b/cases", "", fan, sizeof fan);
  fuzz_find(fan, ".json", record, sizeof record);
  fuzz_batch_files[BATCH_LISTING] = fuzz_kept("b/batch.json");
  fuzz_batch_files[BATCH_CASES] = fuzz_kept("b/cases.tsv");
  fuzz_batch_files[BATCH_RECORD] = fuzz_kept(record);
  record[strlen(record) - strlen(".json")] = '\0';
  (void)snprintf(name, sizeof name, "%s/summary.json", record);
  fuzz_batch_files[BATCH_SUMMARY] = fuzz_kept(name);
  (void)snprintf(name, sizeof name, "%s/motion.csv", record);
  fuzz_batch_files[BATCH_MOTION] = fuzz_kept(name);
}

/* the digest behind `key": "` in a sealed text, and the seal, are those of what is there now */
static void fuzz_seal(char *text, const char *key, const char *digest) {
  static const char seal[] = "  \"sha256\": \"";
  char *at = key ? strstr(text, key) : NULL, *last = NULL, sum[AMBULO__SHA256_TEXT];
  if (at && strlen(at) > strlen(key) + 64) memcpy(at + strlen(key), digest, 64);
  for (char *found = strstr(text, seal); found; found = strstr(found + 1, seal)) last = found;
  if (!last || strlen(last) < sizeof seal - 1 + 64) return;
  ambulo__sha256_of(text, (size_t)(last - text), sum);
  memcpy(last + sizeof seal - 1, sum, 64);
}

/* file `over` says that the digest of file `of` is that of these bytes */
static void fuzz_agree(int over, const char *key, const char *bytes, size_t length) {
  char digest[AMBULO__SHA256_TEXT], *text = strdup(fuzz_batch_files[over].text);
  if (!text) abort();
  ambulo__sha256_of(bytes, length, digest);
  fuzz_seal(text, key, digest);
  (void)fuzz_put(fuzz_batch_files[over].name, text, strlen(text));
  free(text);
}

static void fuzz_put_of_batch(int which, const char *bytes, size_t length) {
  char *text = malloc(length + 1);
  if (!text) abort();
  memcpy(text, bytes, length);
  text[length] = '\0';
  if (which == BATCH_LISTING || which == BATCH_RECORD) fuzz_seal(text, NULL, NULL);
  if (which == BATCH_CASES) fuzz_agree(BATCH_LISTING, "\"cases_sha256\": \"", bytes, length);
  if (which == BATCH_SUMMARY) fuzz_agree(BATCH_RECORD, "summary.json\": \"", bytes, length);
  if (which == BATCH_MOTION) fuzz_agree(BATCH_RECORD, "motion.csv\": \"", bytes, length);
  (void)fuzz_put(fuzz_batch_files[which].name, text, length);
  free(text);
}

static void fuzz_batch(unsigned choice, const char *bytes, size_t length) {
  int which = (int)(choice % BATCH_FILES);
  fuzz_put_of_batch(which, bytes, length);
  for (int k = 0; k < 4; k++) {
    fuzz_call call = fuzz_begin();
    ambulo_batch_census census = {0};
    const char *folder = fuzz_path("b");
    ambulo_page_options page = ambulo_page_options_default();
    page.overwrite = 1;
    ambulo_status status =
        k == 0   ? ambulo_batch_status(folder, &fuzz_memory, call.list, &census)
        : k == 1 ? ambulo_batch_collect(folder, &fuzz_memory, call.list, &census)
        : k == 2 ? ambulo_batch_verify(folder, NULL, NULL, &fuzz_memory, call.list, &census)
                 : ambulo_batch_page(folder, fuzz_path("p.html"), &page, &fuzz_memory, call.list,
                                     &census);
    fuzz_status(&call, status);
    fuzz_end(&call);
  }
  for (int i = 0; i < BATCH_FILES; i++) fuzz_restore(&fuzz_batch_files[i]);
}

#endif
