/* Trees of JSON, for documents and for the values of a template. What is added to NULL is dropped.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_JSON_H
#define LAB_JSON_H

#include <stdio.h>

#include <cjson/cJSON.h>

#include "message.h"

/* Add a text, under a name. */
void lab_json_put(cJSON *to, const char *name, const char *format, ...) LAB_PRINTF(3, 4);

/* Add a text to a list; where items are shown one behind the other, with `between` in front of all but the first. */
void lab_json_join(cJSON *list, const char *between, const char *format, ...) LAB_PRINTF(3, 4);
#define lab_json_say(list, ...) lab_json_join(list, "", __VA_ARGS__)

/* Add an item that has values of its own to a list.  Returns: NULL without list or memory */
cJSON *lab_json_append(cJSON *list);

/* Add numbers under their names; one that is not finite becomes null. LAB_JSON_NUMBERS(to, {"name", value}, ...)
 * In:      number  up to one without a name */
#define LAB_JSON_NUMBERS(to, ...) lab_json_numbers(to, (const lab_json_named[]){__VA_ARGS__, {NULL, 0}})
typedef struct lab_json_named {
  const char *name;
  double value;
} lab_json_named;
void lab_json_numbers(cJSON *to, const lab_json_named *number);

/* Add [low, high]. */
void lab_json_range(cJSON *to, const char *name, double low, double high);

/* Write a document, all of its strings plain and its numbers to nine digits, and free it; errors of the stream are left
 * to lab_out_close.
 * In:      what  it is, for the error
 * Returns: LAB_OK, LAB_WORLD without memory. */
int lab_json_write(FILE *file, cJSON *root, const char *what, lab_error *error);

#endif
