/* apps/lab/base/text: which files are read. What would wait for ever ends the program by an alarm. */
#include "../../scratch.h"

#include <time.h>

#include "../../../apps/lab/base/checksum.h"
#include "../../../apps/lab/base/text.h"
#include "../../../apps/lab/batch/batchlist.h"
#include "../../../apps/lab/log/log.h"
#include "../../../apps/lab/rig/rig.h"

/* A file without content, but of a size.  Returns: its path */
static const char *sparse_file(const char *name, off_t size)
{
  const char *path = scratch_text(name, "t [s],u [1],p [kPa],x [mm]\n");
  assert_int_equal(truncate(path, size), 0);
  return path;
}

static const char *pipe_file(void)
{
  const char *path = scratch_path("pipe");
  remove(path);
  assert_int_equal(mkfifo(path, 0600), 0);
  return path;
}

/* Every reader says the same of such a file. */
static void assert_refused(const char *path, const char *words)
{
  lab_log_format format;
  lab_fleet_list list;
  lab_log log;
  lab_rig rig;
  lab_log_format_default(&format);
  assert_fails(lab_log_read(path, &format, 101325, &log, &error), LAB_DATA, words);
  assert_fails(lab_rig_read(path, &rig, &error), LAB_DATA, words);
  assert_fails(lab_fleet_list_open(&list, path, &error), LAB_DATA, words);
  lab_fleet_list_close(&list);
  assert_true(lab_checksum_file(LAB_CHECKSUM_SEED, path) == LAB_CHECKSUM_SEED);
}

TEST(test_lab_text_open__no_file_on_a_disk__is_refused)
{
  alarm(60);
  assert_refused(pipe_file(), "this is a pipe or a device");
  assert_refused("/dev/zero", "this is a pipe or a device");
  assert_refused("/dev/null", "this is a pipe or a device");
  assert_refused(scratch_path("."), "this is a folder");
  alarm(0);
}

TEST(test_lab_text_open__too_large__is_refused)
{
  assert_refused(sparse_file("large", (off_t)2 << 30), "expected at most 512 MB, found 2048");
}

/* Nothing is read behind the first byte that is no text. */
TEST(test_lab_text_read__as_large_as_may_be_and_empty__ends_soon)
{
  const char *path = sparse_file("sparse", LAB_TEXT_MAX);
  const clock_t start = clock();
  lab_text text;
  assert_fails(lab_text_read(path, &text, &error), LAB_DATA, "sparse:2: expected text, found a 0 byte");
  assert_true((double)(clock() - start) / CLOCKS_PER_SEC < 0.2);
}

TEST(test_lab_text_read__lines_that_end_in_cr_alone__are_lines)
{
  lab_text text;
  succeed(lab_text_read(scratch_text("mac.csv", "t [s],x [mm]\r0,1\r"), &text, &error));
  assert_string_equal(text.data, "t [s],x [mm]\n0,1\n");
  lab_text_free(&text);
  succeed(lab_text_read(scratch_text("dos.csv", "t [s],x [mm]\r\n0,1\r\n"), &text, &error));
  assert_string_equal(text.data, "t [s],x [mm]\r\n0,1\r\n");
  lab_text_free(&text);
}

TEST(test_lab_log_read__a_thousand_columns__are_refused)
{
  static char text[1000 * 8 + 2];
  lab_log_format format;
  lab_log log;
  int i;
  for (i = 0; i < 1000; i++)
    strcat(text, i ? ",- [1]" : "t [s]");
  lab_log_format_default(&format);
  assert_fails(lab_log_read(scratch_text("wide.csv", strcat(text, "\n")), &format, 101325, &log, &error), LAB_DATA,
               "expected at most 64 columns");
}

TEST(test_lab_append__more_than_fits__is_cut)
{
  char text[8] = "ab";
  lab_append(text, sizeof text, "%s", ", cd");
  assert_string_equal(text, "ab, cd");
  lab_append(text, sizeof text, "%d", 1234);
  assert_string_equal(text, "ab, cd1");
}
