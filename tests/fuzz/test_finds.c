/* What fuzzing has found, and what it starts from, read again. A find is a file of tests/fuzz/finds whose name begins
 * with the target (targets.h) and goes on with what it was. */
#include "../check.h"

#include <dirent.h>

#include "targets.h"

/* Feed a file to the target that its name begins with. */
static void replay(const char *folder, const char *name)
{
  const fuzz_target *target = fuzz_target_named(name, strcspn(name, "-"));
  uint8_t *data = malloc(1 << 20);
  char path[512];
  FILE *file;
  size_t size;
  snprintf(path, sizeof path, "%s/%s", folder, name);
  check_note("%.100s", name);
  file = fopen(path, "rb");
  assert_non_null(target);
  assert_non_null(data);
  assert_non_null(file);
  size = fread(data, 1, 1 << 20, file);
  fclose(file);
  target->read(data, size); /* ends the program where a promise is broken */
  free(data);
}

/* Returns: number of files replayed. */
static int replay_folder(const char *folder)
{
  DIR *open = opendir(folder);
  struct dirent *entry;
  int n = 0;
  assert_non_null(open);
  while ((entry = readdir(open)))
    if (entry->d_name[0] != '.') {
      replay(folder, entry->d_name);
      n++;
    }
  closedir(open);
  return n;
}

TEST(test_finds__replayed__keep_the_readers_promises)
{
  assert_true(replay_folder("tests/fuzz/finds") > 0);
}

TEST(test_seeds__replayed__keep_the_readers_promises)
{
  assert_true(replay_folder("tests/fuzz/seeds") >= FUZZ_TARGETS);
}
