#include "xml.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "../lab/base/escape.h"

/* -1 is how libxml2 says that memory has run out. */
static void note(fmu_xml *xml, int result)
{
  xml->failed |= result < 0;
}

void fmu_xml_begin(fmu_xml *xml)
{
  memset(xml, 0, sizeof *xml);
  xml->buffer = xmlBufferCreate();
  xml->writer = xml->buffer ? xmlNewTextWriterMemory(xml->buffer, 0) : NULL;
  if (!xml->writer) {
    xml->failed = 1;
    return;
  }
  note(xml, xmlTextWriterSetIndent(xml->writer, 1));
  note(xml, xmlTextWriterSetIndentString(xml->writer, BAD_CAST "  "));
  note(xml, xmlTextWriterStartDocument(xml->writer, NULL, "UTF-8", NULL));
}

void fmu_xml_open(fmu_xml *xml, const char *element)
{
  if (!xml->failed)
    note(xml, xmlTextWriterStartElement(xml->writer, BAD_CAST element));
}

void fmu_xml_close(fmu_xml *xml)
{
  if (!xml->failed)
    note(xml, xmlTextWriterEndElement(xml->writer));
}

void fmu_xml_text(fmu_xml *xml, const char *attribute, const char *value)
{
  xmlChar *plain = xml->failed ? NULL : xmlStrdup(BAD_CAST value);
  xml->failed |= !plain;
  if (!plain)
    return;
  lab_make_plain((char *)plain);
  note(xml, xmlTextWriterWriteAttribute(xml->writer, BAD_CAST attribute, plain));
  xmlFree(plain);
}

void fmu_xml_whole(fmu_xml *xml, const char *attribute, long value)
{
  char text[32];
  snprintf(text, sizeof text, "%ld", value);
  fmu_xml_text(xml, attribute, text);
}

void fmu_xml_real(fmu_xml *xml, const char *attribute, double value)
{
  char text[32];
  if (isnan(value))
    return;
  snprintf(text, sizeof text, "%.15g", value);
  if (strtod(text, NULL) != value)
    snprintf(text, sizeof text, "%.17g", value);
  fmu_xml_text(xml, attribute, text);
}

int fmu_xml_end(fmu_xml *xml, char **text, size_t *size, lab_error *error)
{
  *text = NULL;
  if (xml->writer) {
    note(xml, xmlTextWriterEndDocument(xml->writer));
    xmlFreeTextWriter(xml->writer);
  }
  if (!xml->failed) {
    *size = (size_t)xmlBufferLength(xml->buffer);
    *text = malloc(*size + 1);
  }
  if (*text)
    memcpy(*text, xmlBufferContent(xml->buffer), *size + 1);
  xmlBufferFree(xml->buffer);
  return *text ? LAB_OK : lab_fail_memory(error, "an XML document");
}
