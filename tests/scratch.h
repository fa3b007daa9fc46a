/* A folder for a test program's files, removed afterwards. A set-up and a tear-down of its own call scratch_open and
 * scratch_close.
 * SPDX-License-Identifier: MIT */
#ifndef TESTS_SCRATCH_H
#define TESTS_SCRATCH_H

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include "words.h"

static char scratch_folder[64];

static inline int scratch_open(void **state)
{
  strcpy(scratch_folder, "/tmp/libpneu-test-XXXXXX");
  return mkdtemp(scratch_folder) ? 0 : -1;
}

/* Path of a file in the folder; good until the fourth call after this one. */
static inline const char *scratch_path(const char *name)
{
  static char path[4][512];
  static int turn;
  turn = (turn + 1) % 4;
  snprintf(path[turn], sizeof path[turn], "%s/%s", scratch_folder, name);
  return path[turn];
}

/* Write a file of `size` bytes.  Returns: its path */
static inline const char *scratch_bytes(const char *name, const void *bytes, size_t size)
{
  const char *path = scratch_path(name);
  FILE *file = fopen(path, "wb");
  assert_non_null(file);
  assert_int_equal(fwrite(bytes, 1, size, file), size);
  assert_int_equal(fclose(file), 0);
  return path;
}

static inline const char *scratch_text(const char *name, const char *text)
{
  return scratch_bytes(name, text, strlen(text));
}

/* The whole of a file, to be freed. */
static inline char *scratch_read(const char *path)
{
  FILE *file = fopen(path, "rb");
  char *text = calloc(1, 1 << 20);
  assert_non_null(file);
  assert_non_null(text);
  assert_true(fread(text, 1, (1 << 20) - 1, file) < (1 << 20) - 1);
  fclose(file);
  return text;
}

static inline int scratch_exists(const char *path)
{
  struct stat info;
  return stat(path, &info) == 0;
}

/* A link in the folder to a device: code that puts a file in its place destroys the link, never the device, whoever
 * runs the test.  Returns: its path */
static inline const char *scratch_device(const char *name, const char *device)
{
  const char *path = scratch_path(name);
  if (!scratch_exists(device))
    skip();
  remove(path);
  assert_int_equal(symlink(device, path), 0);
  return path;
}

static inline int scratch_is_link(const char *path)
{
  struct stat info;
  return lstat(path, &info) == 0 && S_ISLNK(info.st_mode);
}

static inline void scratch_remove(const char *path)
{
  DIR *folder = scratch_is_link(path) ? NULL : opendir(path);
  struct dirent *entry;
  char inner[1024];
  while (folder && (entry = readdir(folder)))
    if (strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0) {
      if (snprintf(inner, sizeof inner, "%s/%s", path, entry->d_name) < (int)sizeof inner)
        scratch_remove(inner);
    }
  if (folder)
    closedir(folder);
  remove(path);
}

static inline int scratch_close(void **state)
{
  scratch_remove(scratch_folder);
  return 0;
}

TESTS_WITH(scratch_open, scratch_close)

#endif
