/* Fill in a template: the part of Mustache, mustache(5), that a report needs, with values from a cJSON object.
 *
 *   {{name}}              text, escaped for HTML
 *   {{{name}}}            text as it stands
 *   {{#name}}..{{/name}}  once for each item of an array; once inside an object; once for a text that is not empty
 *   {{^name}}..{{/name}}  where there is no such text, item or object
 *   {{.}}                 the item itself, of an array of texts
 *
 * A name is looked up in the innermost object first, then in those around it. A newline after {{#}}, {{^}}, {{/}} is
 * left out.
 * SPDX-License-Identifier: MIT */
#ifndef LAB_TEMPLATE_H
#define LAB_TEMPLATE_H

#include <stdio.h>

#include <cjson/cJSON.h>

#include "message.h"

/* Write a filled-in template; errors of the stream are left to lab_out_close.
 * Returns: LAB_OK; LAB_DATA for a tag that is not closed. */
int lab_template_write(FILE *file, const char *template, const cJSON *values, lab_error *error);

/* Write it into a file, whole or not at all.
 * In:      piece  of the template, as in lab_template_text
 * Returns: LAB_OK; LAB_DATA for a tag that is not closed; LAB_WORLD. */
int lab_template_file(const char *path, const char *const *piece, const cJSON *values, lab_error *error);

/* A template or another text that a program carries inside, from its pieces, which end with NULL.
 * Returns: to be freed; NULL without memory. */
char *lab_template_text(const char *const *piece);

#endif
