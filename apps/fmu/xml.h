/* Writing XML, by libxml2: well-formed and escaped whatever the texts are. Failures are kept and told at the end.
 * SPDX-License-Identifier: MIT */
#ifndef FMU_XML_H
#define FMU_XML_H

#include <stddef.h>

#include <libxml/xmlwriter.h>

#include "../lab/base/message.h"

typedef struct fmu_xml {
  xmlBufferPtr buffer;
  xmlTextWriterPtr writer;
  int failed;
} fmu_xml;

/* Begin a document; to be ended by fmu_xml_end, whatever happens. */
void fmu_xml_begin(fmu_xml *xml);

/* Begin and end an element; attributes follow its beginning. */
void fmu_xml_open(fmu_xml *xml, const char *element);
void fmu_xml_close(fmu_xml *xml);

void fmu_xml_text(fmu_xml *xml, const char *attribute, const char *value);
void fmu_xml_whole(fmu_xml *xml, const char *attribute, long value);

/* A number, as short as gives the same one back; left out if it is NaN. */
void fmu_xml_real(fmu_xml *xml, const char *attribute, double value);

/* Out: text  to be freed with free, NULL on error.  Returns: LAB_OK, LAB_WORLD. */
int fmu_xml_end(fmu_xml *xml, char **text, size_t *size, lab_error *error);

#endif
