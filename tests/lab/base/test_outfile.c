/* apps/lab/base/outfile */
#include "../../scratch.h"

#include "../../../apps/lab/base/outfile.h"

static lab_outfile out;
static char path[512], part[520]; /* of the file in use, and of what is not whole of it */

static void use(const char *name)
{
  snprintf(path, sizeof path, "%s", name);
  snprintf(part, sizeof part, "%s.part", path);
}

static void assert_content(const char *file, const char *want)
{
  char *got = scratch_read(file);
  assert_string_equal(got, want);
  free(got);
}

/* Returns: the status of the whole. */
static int write_text(const char *file, const char *text)
{
  int status = lab_out_open(&out, file, &error);
  if (status != LAB_OK)
    return status;
  fputs(text, out.file);
  return lab_out_close(&out, &error);
}

TEST(test_lab_out_close__good_disk__puts_the_file_in_place)
{
  use(scratch_path("new.csv"));
  assert_int_equal(write_text(path, "whole\n"), LAB_OK);
  assert_content(path, "whole\n");
  assert_false(scratch_exists(part));
}

TEST(test_lab_out_open__while_writing__leaves_the_old_file)
{
  use(scratch_text("old.csv", "old\n"));
  succeed(lab_out_open(&out, path, &error));
  fputs("new\n", out.file);
  fflush(out.file);
  assert_content(path, "old\n");
  succeed(lab_out_close(&out, &error));
  assert_content(path, "new\n");
}

TEST(test_lab_out_abandon__half_written__leaves_the_old_file_alone)
{
  use(scratch_text("kept.csv", "old\n"));
  succeed(lab_out_open(&out, path, &error));
  fputs("half", out.file);
  assert_true(scratch_exists(part));
  lab_out_abandon(&out);
  assert_content(path, "old\n");
  assert_false(scratch_exists(part));
}

TEST(test_lab_out_end__status_of_who_wrote__decides)
{
  use(scratch_text("ended.csv", "old\n"));
  succeed(lab_out_open(&out, path, &error));
  fputs("new\n", out.file);
  assert_int_equal(lab_out_end(&out, LAB_NUMERIC, &error), LAB_NUMERIC);
  assert_content(path, "old\n");
  succeed(lab_out_open(&out, path, &error));
  fputs("new\n", out.file);
  succeed(lab_out_end(&out, LAB_OK, &error));
  assert_content(path, "new\n");
}

TEST(test_lab_out_open__missing_folders__are_made)
{
  use(scratch_path("a/b/c.csv"));
  assert_int_equal(write_text(path, "x"), LAB_OK);
  assert_content(path, "x");
}

TEST(test_lab_out_open__name_without_folder__is_in_the_present_one)
{
  char before[1024];
  assert_non_null(getcwd(before, sizeof before));
  assert_int_equal(chdir(scratch_folder), 0);
  assert_int_equal(write_text("bare.csv", "x"), LAB_OK);
  assert_content("bare.csv", "x");
  assert_int_equal(chdir(before), 0);
}

TEST(test_lab_out_open__file_on_the_way__is_the_worlds_fault)
{
  scratch_text("plain", "x");
  use(scratch_path("plain/out.csv"));
  assert_int_equal(write_text(path, "x"), LAB_WORLD);
  assert_contains(error.text, "plain");
  use(scratch_path("plain/deeper/out.csv"));
  assert_int_equal(write_text(path, "x"), LAB_WORLD);
  assert_contains(error.text, "cannot be made");
}

TEST(test_lab_out_open__folder_that_cannot_be_made__names_it)
{
  assert_int_equal(write_text("/proc/none/out.csv", "x"), LAB_WORLD);
  assert_contains(error.text, "/proc/none: cannot be made");
}

TEST(test_lab_out_open__forbidden_folder__is_the_worlds_fault)
{
  if (geteuid() == 0)
    skip();
  assert_int_equal(mkdir(scratch_path("locked"), 0500), 0);
  use(scratch_path("locked/out.csv"));
  assert_int_equal(write_text(path, "x"), LAB_WORLD);
  assert_contains(error.text, "Permission denied");
}

TEST(test_lab_out_close__folder_in_its_place__leaves_no_part)
{
  use(scratch_path("taken"));
  assert_int_equal(mkdir(path, 0777), 0);
  assert_int_equal(write_text(path, "x"), LAB_WORLD);
  assert_contains(error.text, "cannot be put in place");
  assert_false(scratch_exists(part));
}

TEST(test_lab_out_close__full_disk__is_the_worlds_fault)
{
  use(scratch_device("full", "/dev/full"));
  assert_int_equal(write_text(path, "x"), LAB_WORLD);
  assert_contains(error.text, "full: cannot be written: No space left on device");
  assert_true(scratch_is_link(path)); /* not replaced by a file */
  assert_false(scratch_exists(part));
}

TEST(test_lab_out_close__full_disk_in_the_middle__is_the_worlds_fault)
{
  int i;
  succeed(lab_out_open(&out, scratch_device("full", "/dev/full"), &error));
  for (i = 0; i < 100000; i++)
    fputs("0123456789\n", out.file);
  assert_fails(lab_out_close(&out, &error), LAB_WORLD, "full: cannot be written: No space left on device");
}

TEST(test_lab_out_close__device__is_written_in_place)
{
  use(scratch_device("null", "/dev/null"));
  assert_int_equal(write_text(path, "x"), LAB_OK);
  assert_true(scratch_is_link(path));
  assert_false(scratch_exists(part));
}

TEST(test_lab_out_open__no_path__is_standard_output)
{
  succeed(lab_out_open(&out, NULL, &error));
  assert_ptr_equal(out.file, stdout);
  succeed(lab_out_close(&out, &error));
  assert_true(printf("%s", "") == 0); /* still open */
  succeed(lab_out_open(&out, NULL, &error));
  lab_out_abandon(&out);
}

TEST(test_lab_make_folder__nested_or_there__is_made)
{
  use(scratch_path("x/y/z/"));
  succeed(lab_make_folder(path, &error));
  assert_true(scratch_exists(path));
  succeed(lab_make_folder(path, &error));
  succeed(lab_make_folder("/", &error));
}

TEST(test_lab_make_folder__file_of_that_name__is_refused)
{
  assert_int_equal(lab_make_folder(scratch_text("a_file", "x"), &error), LAB_WORLD);
}
