/* What the lab uses of UDUNITS-2, for machines for which there is no build of it. The meaning of each function is that
 * of the manual of UDUNITS-2. Left out: logarithmic units, dates, formatting but by definition.
 * SPDX-License-Identifier: MIT */
#ifndef UNITS_UDUNITS2_H
#define UNITS_UDUNITS2_H

#include <stdarg.h>
#include <stddef.h>

typedef struct ut_system ut_system;
typedef struct ut_unit ut_unit;
typedef struct cv_converter cv_converter;
typedef enum { UT_ASCII = 0, UT_UTF8 = 2 } ut_encoding;
enum { UT_DEFINITION = 8 };
typedef int ut_error_message_handler(const char *format, va_list arguments);

ut_error_message_handler *ut_set_error_message_handler(ut_error_message_handler *handler);
int ut_ignore(const char *format, va_list arguments);
ut_system *ut_read_xml(const char *path);
char *ut_trim(char *text, ut_encoding encoding);
ut_unit *ut_parse(const ut_system *units, const char *text, ut_encoding encoding);
void ut_free(ut_unit *unit);
int ut_format(const ut_unit *unit, char *text, size_t size, unsigned options);
int ut_are_convertible(const ut_unit *a, const ut_unit *b);
cv_converter *ut_get_converter(ut_unit *from, ut_unit *to);
double cv_convert_double(const cv_converter *converter, double value);
void cv_free(cv_converter *converter);

#endif
