/* Write table.c for table.h: every unit and prefix of UDUNITS-2, as the UDUNITS-2 of this machine understands it.
 *   table_make FILE.xml...    tables of UDUNITS-2
 * SPDX-License-Identifier: MIT */
#include <libxml/xmlreader.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <udunits2.h>

enum { TEXT = 256 };

static ut_system *units;

/* "6894.75 kg.m-1.s-2" -> "kg.m-1.s-2", "K @ 273.15" -> "K"; of a bare number nothing is left. */
static void base_of(const ut_unit *unit, char *base)
{
  char text[TEXT], *at = text;
  *base = '\0';
  if (ut_format(unit, text, sizeof text, UT_ASCII | UT_DEFINITION) < 0)
    return;
  text[strcspn(text, "@")] = '\0';
  strtod(text, &at);
  at += strspn(at, " ");
  at[strcspn(at, " ")] = '\0';
  strcpy(base, at);
}

static void write_line(const char *name, int is_symbol, const cv_converter *to_base, const char *base)
{
  const double far = 1048576, offset = cv_convert_double(to_base, 0.0);
  const double scale = offset == 0 ? cv_convert_double(to_base, 1.0)
                                   : (cv_convert_double(to_base, far) - cv_convert_double(to_base, -far)) / (2 * far);
  printf("  {\"%s\", %d, %.17g, %.17g, \"%s\"},\n", name, is_symbol, scale, offset, base);
}

/* A unit, if the tables have it by this name and a straight line leads to base units. */
static void write_unit(const char *name, int is_symbol)
{
  char base[TEXT], text[TEXT] = "";
  ut_unit *unit = is_symbol ? ut_get_unit_by_symbol(units, name) : ut_get_unit_by_name(units, name), *to;
  cv_converter *converter;
  if (!unit)
    return;
  ut_format(unit, text, sizeof text, UT_ASCII | UT_DEFINITION);
  base_of(unit, base);
  to = ut_parse(units, *base ? base : "1", UT_ASCII);
  converter = to && !strstr(text, "(re") ? ut_get_converter(unit, to) : NULL;
  if (converter && !strpbrk(name, "\"\\ "))
    write_line(name, is_symbol, converter, base);
  cv_free(converter);
  ut_free(to);
  ut_free(unit);
}

/* A name and the plural that UDUNITS-2 makes of it. */
static void write_name(const char *name)
{
  static const char *const ends[] = {"s", "es", "ies"};
  size_t i;
  write_unit(name, 0);
  for (i = 0; i < sizeof ends / sizeof ends[0]; i++) {
    char plural[TEXT];
    snprintf(plural, sizeof plural, "%.*s%s", (int)(strlen(name) - (i == 2)), name, ends[i]);
    write_unit(plural, 0);
  }
}

static void write_names(xmlTextReaderPtr reader)
{
  while (xmlTextReaderRead(reader) == 1) {
    const char *tag = (const char *)xmlTextReaderConstName(reader);
    const int is_symbol = strcmp(tag, "symbol") == 0;
    if (xmlTextReaderNodeType(reader) != XML_READER_TYPE_ELEMENT)
      continue;
    if (is_symbol || strcmp(tag, "singular") == 0 || strcmp(tag, "plural") == 0) {
      xmlChar *name = xmlTextReaderReadString(reader);
      if (is_symbol)
        write_unit((char *)name, 1);
      else
        write_name((char *)name);
      xmlFree(name);
    }
  }
}

static void write_prefixes(xmlTextReaderPtr reader)
{
  char value[TEXT] = "";
  while (xmlTextReaderRead(reader) == 1) {
    const char *tag = (const char *)xmlTextReaderConstName(reader);
    xmlChar *text;
    if (xmlTextReaderNodeType(reader) != XML_READER_TYPE_ELEMENT)
      continue;
    text = xmlTextReaderReadString(reader);
    if (strcmp(tag, "value") == 0)
      snprintf(value, sizeof value, "%s", (char *)text);
    else if (strcmp(tag, "name") == 0 || strcmp(tag, "symbol") == 0)
      printf("  {\"%s\", %d, %s},\n", (char *)text, *tag == 's', value);
    xmlFree(text);
  }
}

static void write_of(int n, char **path, void (*write)(xmlTextReaderPtr), int prefixes)
{
  int i;
  for (i = 0; i < n; i++) {
    xmlTextReaderPtr reader =
        (strstr(path[i], "prefixes") != NULL) == prefixes ? xmlReaderForFile(path[i], NULL, 0) : NULL;
    if (reader)
      write(reader);
    xmlFreeTextReader(reader);
  }
}

int main(int argc, char **argv)
{
  ut_set_error_message_handler(ut_ignore);
  units = ut_read_xml(NULL);
  if (argc < 2 || !units) {
    fprintf(stderr, "table_make: expected the tables of UDUNITS-2\n");
    return 1;
  }
  printf("/* Written by table_make.c from the tables of UDUNITS-2. */\n#include \"table.h\"\n\n");
  printf("const units_row units_rows[] = {\n");
  write_of(argc - 1, argv + 1, write_names, 0);
  printf("};\nconst int units_row_count = sizeof units_rows / sizeof units_rows[0];\n\n");
  printf("const units_prefix units_prefixes[] = {\n");
  write_of(argc - 1, argv + 1, write_prefixes, 1);
  printf("};\nconst int units_prefix_count = sizeof units_prefixes / sizeof units_prefixes[0];\n");
  return 0;
}
