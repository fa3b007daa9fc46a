#include "export.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "carried.h"
#include "description.h"
#include "modeldata.h"
#include "package.h"

enum { PATH_TEXT = 256 };

/* Folders for binaries in FMI 2 and FMI 3, where this compiler's machine has one. */
#if defined __x86_64__ && defined __linux__
static const char *const platforms[] = {"linux64", "x86_64-linux"};
#elif defined __aarch64__ && defined __linux__
static const char *const platforms[] = {NULL, "aarch64-linux"};
#else
static const char *const platforms[] = {NULL, NULL}; /* sources only */
#endif

/* What is at hand while an FMU is made. */
typedef struct maker {
  const lab_rig *rig;
  fmu_data data;
  fmu_list list;
  char identifier[LAB_NAME_TEXT + 1];
  fmu_description description;
  fmu_package package;
} maker;

/* "37-13" is no name in C: "_37_13" is. */
static void identify(const char *name, char *identifier)
{
  if (!isalpha((unsigned char)*name))
    *identifier++ = '_';
  for (; *name; name++)
    *identifier++ = (char)(isalnum((unsigned char)*name) ? *name : '_');
  *identifier = '\0';
}

static int add_xml(maker *m, const char *name, void (*describe)(fmu_xml *, const fmu_description *), lab_error *error)
{
  fmu_xml xml;
  char *text;
  size_t size;
  fmu_xml_begin(&xml);
  describe(&xml, &m->description);
  if (fmu_xml_end(&xml, &text, &size, error) == LAB_OK)
    fmu_package_add(&m->package, name, text, size, error);
  free(text);
  return error->status;
}

static int add_carried(maker *m, const char *name, const char *carried, lab_error *error)
{
  const fmu_file *file = fmu_carried_find(carried);
  return fmu_package_add(&m->package, name, file->bytes, file->size, error);
}

static int add_binary(maker *m, lab_error *error)
{
  const int fmi = m->description.fmi;
  const char *platform = platforms[fmi - 2];
  char name[PATH_TEXT];
  unsigned char *bytes;
  size_t size;
  if (!platform)
    return LAB_OK;
  snprintf(name, sizeof name, "binaries/%s/%s.so", platform, m->identifier);
  if (fmu_data_binary(&m->data, fmi, &bytes, &size, error) == LAB_OK)
    fmu_package_add(&m->package, name, bytes, size, error);
  free(bytes);
  return error->status;
}

static int add_header(maker *m, const char *name, lab_error *error)
{
  char *text;
  size_t size;
  if (fmu_data_header(m->rig, &m->data, &text, &size, error) == LAB_OK)
    fmu_package_add(&m->package, name, text, size, error);
  free(text);
  return error->status;
}

/* The sources, in the folders of the repository, and the model's header in the place of the empty one. */
static int add_sources(maker *m, lab_error *error)
{
  const fmu_file *file;
  int i;
  for (i = 0; (file = fmu_carried(i)); i++) {
    char name[PATH_TEXT];
    if (!fmu_is_source(file, m->description.fmi))
      continue;
    snprintf(name, sizeof name, "sources/%s", file->name);
    if (strstr(name, "/model_data.h") ? add_header(m, name, error)
                                      : fmu_package_add(&m->package, name, file->bytes, file->size, error))
      return error->status;
  }
  return LAB_OK;
}

/* The model file, for the other programs. */
static int add_model(maker *m, lab_error *error)
{
  char *text = NULL;
  size_t size;
  FILE *file = open_memstream(&text, &size);
  if (!file)
    return lab_fail_memory(error, "the model");
  lab_rig_write(file, m->rig, "The model of this FMU, for libpneu's programs.");
  if (fclose(file) == 0)
    fmu_package_add(&m->package, "resources/model.cfg", text, size, error);
  else
    lab_fail_memory(error, "the model");
  free(text);
  return error->status;
}

static int add_page(maker *m, lab_error *error)
{
  static const char page[] =
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Pneumatic "
      "actuator</title></head><body>\n"
      "<h1>Single-acting pneumatic actuator</h1>\n"
      "<p>Chamber, transducer, spring-loaded stem with dry friction between two stops, by libpneu " PNEU_VERSION
      "; the model file is resources/model.cfg. Units are SI, pressures are gauge but for ambient_pressure.</p>\n"
      "<p><b>Inputs</b>: command u, supply pressure, external force. <b>Outputs</b>: pressure, temperature, position, "
      "velocity, mass flow, what the sensors show, mode of the stem, whether flow is choked. x grows in the direction "
      "in "
      "which the air drives the stem.</p>\n"
      "<p>Where the model file makes pressure an input, it is one here, in the place of command and supply; where "
      "position is one, holding_force is an output. From the time at which it is set to the next it runs along a "
      "straight line, with the slope pressure_rate or velocity. Without pressure_rate it holds, for a step of "
      "co-simulation; velocity is needed always, since it pumps the gas.</p>\n"
      "<p><b>Parameters</b> are fixed: they can be set before initialisation ends. The stem starts at rest, at "
      "start_position with start_pressure. Built in are the laws of gas and flow, free terms, and which effects have a "
      "state of their own: such an effect can be switched off here, but not on.</p>\n"
      "<p><b>Model exchange</b>: states are those of the moving stem; while it rests, the derivatives of position and "
      "velocity are 0. Break-away, reversal, stops and choking are state events. A dead time makes time events; a "
      "command "
      "that changes continuously is then kept step by step. <b>Co-simulation</b>: the library's own stepper, with "
      "events "
      "inside the communication step located to 1e-9 s; inputs hold during a step, but for pressure and position "
      "whose slope is given.</p>\n"
      "<p>Not applied: the effect channel_skew, the age of the position in a recorder. Derivatives by direction are "
      "provided.</p>\n</body></html>\n";
  return fmu_package_add(&m->package, "documentation/index.html", page, sizeof page - 1, error);
}

/* What only one version has. */
static int add_own(maker *m, lab_error *error)
{
  if (m->description.fmi == 2)
    return add_carried(m, "model.png", "icon.png", error);
  if (add_xml(m, "sources/buildDescription.xml", fmu_describe_build, error) ||
      add_xml(m, "terminalsAndIcons/terminalsAndIcons.xml", fmu_describe_icon, error) ||
      add_carried(m, "terminalsAndIcons/icon.png", "icon.png", error))
    return error->status;
  return add_carried(m, "terminalsAndIcons/icon.svg", "icon.svg", error);
}

static int add_all(maker *m, lab_error *error)
{
  if (add_xml(m, "modelDescription.xml", fmu_describe, error) || add_binary(m, error) || add_sources(m, error) ||
      add_model(m, error) || add_page(m, error) ||
      add_carried(m, "documentation/licenses/license.txt", "license.txt", error))
    return error->status;
  return add_own(m, error);
}

static int prepare(maker *m, int fmi, lab_error *error)
{
  pneu_model model;
  if (lab_rig_model(m->rig, &model, error))
    return error->status;
  fmu_data_of(m->rig, fmi, &m->data);
  fmu_list_of(&m->data, &model, &m->list);
  identify(m->rig->name, m->identifier);
  m->description.fmi = fmi;
  m->description.name = m->rig->name;
  m->description.identifier = m->identifier;
  m->description.data = &m->data;
  m->description.list = &m->list;
  return LAB_OK;
}

int fmu_export(const lab_rig *rig, int fmi, const char *path, lab_error *error)
{
  char own_path[LAB_NAME_TEXT + 8];
  maker m;
  memset(&m, 0, sizeof m);
  m.rig = rig;
  error->status = LAB_OK;
  if (prepare(&m, fmi, error) || fmu_package_begin(&m.package, error))
    return error->status;
  if (add_all(&m, error)) {
    fmu_package_drop(&m.package);
    return error->status;
  }
  snprintf(own_path, sizeof own_path, "%s.fmu", m.identifier);
  return fmu_package_write(&m.package, path ? path : own_path, error);
}
