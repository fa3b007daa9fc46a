/* What the lab uses of POSIX and Windows lacks. The build includes it before every file of the lab.
 * SPDX-License-Identifier: MIT */
#ifndef WINDOWS_POSIX_H
#define WINDOWS_POSIX_H

#include <direct.h>
#include <stdio.h>
#include <sys/stat.h>

#define O_NONBLOCK        0 /* files alone are opened */
#define mkdir(path, mode) _mkdir(path)

/* As POSIX has it: what is there is replaced. */
int windows_rename(const char *from, const char *to);
#define rename windows_rename

/* In the folder of temporary files; the system's own would need the root of the disk. */
FILE *windows_tmpfile(void);
#define tmpfile windows_tmpfile

/* As POSIX has it, but that text and size are told by fclose alone. */
FILE *open_memstream(char **text, size_t *size);
int windows_fclose(FILE *file);
#define fclose windows_fclose

#endif
