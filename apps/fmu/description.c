#include "description.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <libxml/xmlwriter.h>

#include "../lab/base/escape.h"
#include "../lab/base/text.h"
#include "../lab/base/units.h"
#include "carried.h"

/* ---- Writing XML, by libxml2: well-formed and escaped whatever the texts are ---- */

typedef struct document {
  xmlTextWriterPtr writer;
  int failed; /* memory has run out, which is told at the end */
} document;

/* -1 is how libxml2 says that memory has run out, also to whoever goes on without a writer. */
static void note(document *xml, int result)
{
  xml->failed |= result < 0;
}

/* Begin a document; to be ended by xml_end, whatever happens. */
static void xml_begin(document *xml, FILE *file)
{
  xmlOutputBufferPtr out = xmlOutputBufferCreateFile(file, NULL);
  xml->writer = out ? xmlNewTextWriter(out) : NULL;
  xml->failed = 0;
  note(xml, xmlTextWriterSetIndent(xml->writer, 1));
  note(xml, xmlTextWriterSetIndentString(xml->writer, BAD_CAST "  "));
  note(xml, xmlTextWriterStartDocument(xml->writer, NULL, "UTF-8", NULL));
}

static void xml_open(document *xml, const char *element)
{
  note(xml, xmlTextWriterStartElement(xml->writer, BAD_CAST element));
}

static void xml_close(document *xml)
{
  note(xml, xmlTextWriterEndElement(xml->writer));
}

static void xml_text(document *xml, const char *attribute, const char *value)
{
  xmlChar *plain = xmlStrdup(BAD_CAST value);
  xml->failed |= !plain;
  if (!plain)
    return;
  lab_make_plain((char *)plain);
  note(xml, xmlTextWriterWriteAttribute(xml->writer, BAD_CAST attribute, plain));
  xmlFree(plain);
}

static void xml_whole(document *xml, const char *attribute, long value)
{
  char text[32];
  snprintf(text, sizeof text, "%ld", value);
  xml_text(xml, attribute, text);
}

/* A number, as short as gives the same one back; left out if it is NaN. */
static void xml_real(document *xml, const char *attribute, double value)
{
  char text[32];
  if (isnan(value))
    return;
  snprintf(text, sizeof text, "%.15g", value);
  if (strtod(text, NULL) != value)
    snprintf(text, sizeof text, "%.17g", value);
  xml_text(xml, attribute, text);
}

/* Close all that is open. */
static int xml_end(document *xml, lab_error *error)
{
  note(xml, xmlTextWriterEndDocument(xml->writer));
  xmlFreeTextWriter(xml->writer);
  return xml->failed ? lab_fail_memory(error, "an XML document") : LAB_OK;
}

/* ---- SI units as FMI wants them: exponents of base units ---- */

enum { BASES = 4 };

/* Attributes of BaseUnit. */
static const char *const base_names[BASES] = {"kg", "m", "s", "K"};

/* Exponents of a unit.  Returns: 0 where it has none in whole numbers, or one of another base unit */
static int exponents_of(const char *unit, int exponent[BASES])
{
  char text[LAB_UNIT_TEXT], *part;
  lab_error ignored;
  memset(exponent, 0, BASES * sizeof *exponent);
  if (lab_unit_dimension(unit, text, &ignored))
    return 0;
  for (part = strtok(text, "."); part && strcmp(part, "1") != 0; part = strtok(NULL, ".")) {
    const size_t n = strcspn(part, "-0123456789");
    int i = 0;
    while (i < BASES && (strlen(base_names[i]) != n || strncmp(part, base_names[i], n) != 0))
      i++;
    if (i == BASES)
      return 0;
    exponent[i] = part[n] ? atoi(part + n) : 1;
  }
  return 1;
}

/* ---- Parts ---- */

/* What the two versions name differently. */
typedef struct dialect {
  const char *version, *token;
  const char *initial_unknown, *derivative, *output; /* in ModelStructure */
} dialect;

static const dialect dialects[] = {
    {"2.0", "guid", "Unknown", "Unknown", "Unknown"},
    {"3.0", "instantiationToken", "InitialUnknown", "ContinuousStateDerivative", "Output"},
};

typedef struct flag {
  const char *name;
  int fmi; /* 0: both */
  int co_simulation, model_exchange;
  int driven; /* not 0: only where pressure or position is an input */
} flag;

static const flag flags[] = {
    {"canNotUseMemoryManagementFunctions", 2, 1, 1, 0},
    {"canGetAndSetFMUstate", 2, 1, 1, 0},
    {"canSerializeFMUstate", 2, 1, 1, 0},
    {"canGetAndSetFMUState", 3, 1, 1, 0},
    {"canSerializeFMUState", 3, 1, 1, 0},
    {"providesDirectionalDerivative", 2, 1, 1, 0},
    {"providesDirectionalDerivatives", 3, 1, 1, 0},
    {"canHandleVariableCommunicationStepSize", 0, 1, 0, 0},
    {"canInterpolateInputs", 2, 1, 0, 1},
    {"needsCompletedIntegratorStep", 3, 0, 1, 0},
};
enum { FLAGS = sizeof flags / sizeof flags[0] };

/* An element that has a name alone. */
static void named(document *xml, const char *element, const char *name)
{
  xml_open(xml, element);
  xml_text(xml, "name", name);
  xml_close(xml);
}

/* The sources that are to be compiled. */
static void sources(document *xml, int fmi, const char *element)
{
  const fmu_file *file;
  for (file = fmu_files; file->name; file++)
    if (fmu_is_source(file, fmi) && strcmp(strrchr(file->name, '.'), ".c") == 0)
      named(xml, element, file->name);
}

static int has_flag(const fmu_description *d, const flag *f, int co_simulation)
{
  const pneu_laws *law = &d->data.law;
  return (!f->fmi || f->fmi == d->fmi) && (co_simulation ? f->co_simulation : f->model_exchange) &&
         (!f->driven || law->pressure_input || law->position_input);
}

static void interface(document *xml, const fmu_description *d, int co_simulation)
{
  int i;
  xml_open(xml, co_simulation ? "CoSimulation" : "ModelExchange");
  xml_text(xml, "modelIdentifier", d->identifier);
  for (i = 0; i < FLAGS; i++)
    if (has_flag(d, &flags[i], co_simulation))
      xml_text(xml, flags[i].name, "true");
  if (d->fmi == 2) {
    xml_open(xml, "SourceFiles");
    sources(xml, 2, "File");
    xml_close(xml);
  }
  xml_close(xml);
}

/* ---- Units ---- */

static void unit(document *xml, const char *name)
{
  int exponent[BASES], i;
  xml_open(xml, "Unit");
  xml_text(xml, "name", name);
  if (exponents_of(name, exponent)) {
    xml_open(xml, "BaseUnit");
    for (i = 0; i < BASES; i++)
      if (exponent[i])
        xml_whole(xml, base_names[i], exponent[i]);
    xml_close(xml);
  }
  xml_close(xml);
}

static int is_first_of_unit(const fmu_list *list, int at)
{
  int i;
  for (i = 0; i < at; i++)
    if (list->variable[i].unit && strcmp(list->variable[i].unit, list->variable[at].unit) == 0)
      return 0;
  return 1;
}

static void units(document *xml, const fmu_list *list)
{
  int i;
  xml_open(xml, "UnitDefinitions");
  for (i = 0; i < list->n; i++)
    if (list->variable[i].unit && is_first_of_unit(list, i))
      unit(xml, list->variable[i].unit);
  xml_close(xml);
}

/* ---- Variables ---- */

static void nature(document *xml, const fmu_variable *v)
{
  static const char *const causality[] = {"independent", "parameter", "input", "output", "local"};
  static const char *const initial[] = {NULL, "exact", NULL, "calculated", "calculated"};
  xml_text(xml, "name", v->name);
  xml_whole(xml, "valueReference", (long)v->reference);
  if (v->meaning)
    xml_text(xml, "description", v->meaning);
  xml_text(xml, "causality", causality[v->causality]);
  xml_text(xml, "variability", v->causality == FMU_PARAMETER ? "fixed" : v->integer ? "discrete" : "continuous");
  if (initial[v->causality])
    xml_text(xml, "initial", initial[v->causality]);
}

static void numbers(document *xml, const fmu_description *d, const fmu_variable *v)
{
  if (v->unit)
    xml_text(xml, "unit", v->unit);
  xml_real(xml, "min", v->lower);
  xml_real(xml, "max", v->upper);
  xml_real(xml, "nominal", v->nominal);
  xml_real(xml, "start", v->start);
  if (v->rate_of)
    xml_whole(xml, "derivative", d->fmi == 2 ? fmu_list_find(&d->list, v->rate_of) + 1L : (long)v->rate_of);
  if (v->jumps)
    xml_text(xml, "reinit", "true");
}

static void variable(document *xml, const fmu_description *d, const fmu_variable *v)
{
  static const char *const elements[2][2] = {{"Real", "Integer"}, {"Float64", "Int32"}};
  const char *element = elements[d->fmi - 2][v->integer != 0];
  if (d->fmi == 2)
    xml_open(xml, "ScalarVariable");
  else
    xml_open(xml, element);
  nature(xml, v);
  if (d->fmi == 2)
    xml_open(xml, element);
  numbers(xml, d, v);
  xml_close(xml);
  if (d->fmi == 2)
    xml_close(xml);
}

static void variables(document *xml, const fmu_description *d)
{
  int i;
  xml_open(xml, "ModelVariables");
  for (i = 0; i < d->list.n; i++)
    variable(xml, d, &d->list.variable[i]);
  xml_close(xml);
}

/* ---- Structure ---- */

/* How a variable is named there: FMI 2 counts from 1. */
static long pointer(const fmu_description *d, int place)
{
  return d->fmi == 2 ? place + 1L : (long)d->list.variable[place].reference;
}

static void unknown(document *xml, const fmu_description *d, const char *element, int place)
{
  const int is_output = d->list.variable[place].causality == FMU_OUTPUT && strcmp(element, "InitialUnknown") != 0;
  char dependencies[16 * PNEU_STATE_MAX] = "";
  int depends[PNEU_STATE_MAX], n = is_output ? fmu_dependencies(&d->data, &d->list, place, depends) : -1, i;
  xml_open(xml, element);
  xml_whole(xml, d->fmi == 2 ? "index" : "valueReference", pointer(d, place));
  for (i = 0; i < n; i++)
    lab_append(dependencies, sizeof dependencies, "%s%ld", i ? " " : "", pointer(d, depends[i]));
  if (n >= 0)
    xml_text(xml, "dependencies", dependencies);
  xml_close(xml);
}

static int is_state(const fmu_variable *v)
{
  return !isnan(v->nominal);
}

/* Which variables are in a part of the structure. */
static int is_output(const fmu_variable *v)
{
  return v->causality == FMU_OUTPUT;
}

static int is_rate(const fmu_variable *v)
{
  return v->rate_of != 0 && v->causality == FMU_LOCAL;
}

static int is_initial(const fmu_variable *v)
{
  return is_output(v) || is_state(v) || is_rate(v);
}

static int is_event(const fmu_variable *v)
{
  return v->reference >= FMU_REF_INDICATOR && v->reference < FMU_REF_INDICATOR + FMU_INDICATOR_COUNT;
}

static void unknowns(document *xml, const fmu_description *d, const char *group, const char *element,
                     int (*belongs)(const fmu_variable *))
{
  int i, n = 0;
  for (i = 0; i < d->list.n; i++)
    if (belongs(&d->list.variable[i])) {
      if (d->fmi == 2 && n++ == 0)
        xml_open(xml, group);
      unknown(xml, d, element, i);
    }
  if (n > 0)
    xml_close(xml);
}

static void structure(document *xml, const fmu_description *d)
{
  const dialect *words = &dialects[d->fmi - 2];
  xml_open(xml, "ModelStructure");
  unknowns(xml, d, "Outputs", words->output, is_output);
  unknowns(xml, d, "Derivatives", words->derivative, is_rate);
  unknowns(xml, d, "InitialUnknowns", words->initial_unknown, is_initial);
  if (d->fmi == 3)
    unknowns(xml, d, NULL, "EventIndicator", is_event);
  xml_close(xml);
}

/* ---- Documents ---- */

static void head(document *xml, const fmu_description *d)
{
  char what[128];
  snprintf(what, sizeof what, "Single-acting pneumatic actuator, %s gas, %s flow", pneu_gas_key(d->data.law.gas),
           pneu_flow_key(d->data.law.flow));
  xml_text(xml, "fmiVersion", dialects[d->fmi - 2].version);
  xml_text(xml, "modelName", d->rig->name);
  xml_text(xml, dialects[d->fmi - 2].token, d->data.token);
  xml_text(xml, "description", what);
  xml_text(xml, "license", "MIT");
  xml_text(xml, "generationTool", "libpneu " PNEU_VERSION);
  xml_text(xml, "variableNamingConvention", "structured");
  if (d->fmi == 2)
    xml_whole(xml, "numberOfEventIndicators", FMU_INDICATOR_COUNT);
}

static void log_categories(document *xml)
{
  xml_open(xml, "LogCategories");
  named(xml, "Category", "logStatusWarning");
  named(xml, "Category", "logStatusError");
  xml_close(xml);
}

int fmu_describe(FILE *file, const fmu_description *d, lab_error *error)
{
  document xml;
  xml_begin(&xml, file);
  xml_open(&xml, "fmiModelDescription");
  head(&xml, d);
  interface(&xml, d, 0);
  interface(&xml, d, 1);
  units(&xml, &d->list);
  log_categories(&xml);
  xml_open(&xml, "DefaultExperiment");
  xml_real(&xml, "startTime", 0);
  xml_real(&xml, "stopTime", 30.5);
  xml_real(&xml, "tolerance", 1e-7);
  xml_close(&xml);
  variables(&xml, d);
  structure(&xml, d);
  return xml_end(&xml, error);
}

int fmu_describe_build(FILE *file, const fmu_description *d, lab_error *error)
{
  document xml;
  xml_begin(&xml, file);
  xml_open(&xml, "fmiBuildDescription");
  xml_text(&xml, "fmiVersion", "3.0");
  xml_open(&xml, "BuildConfiguration");
  xml_text(&xml, "modelIdentifier", d->identifier);
  xml_open(&xml, "SourceFileSet");
  xml_text(&xml, "language", "C99");
  sources(&xml, 3, "SourceFile");
  xml_close(&xml);
  xml_open(&xml, "Library");
  xml_text(&xml, "name", "m");
  xml_text(&xml, "external", "true");
  xml_text(&xml, "description", "the C library's mathematics, where that is apart");
  return xml_end(&xml, error);
}
