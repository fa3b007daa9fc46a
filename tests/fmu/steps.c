/* An FMI 2 importer for co-simulation, the same on Linux and on Windows: fill for half a second, vent for another,
 * print pressure and position every 10 ms.
 *
 *   steps LIBRARY TOKEN */
#include <stdio.h>
#include <stdlib.h>

#include "../../apps/fmu/runtime/fmi2.h"

#ifdef _WIN32
#include <windows.h>
#else
#include <dlfcn.h>
#endif

enum { U = 1, PRESSURE = 21, POSITION = 23 };

typedef fmi2Component instantiate(fmi2String, fmi2Type, fmi2String, fmi2String, const fmi2CallbackFunctions *,
                                  fmi2Boolean, fmi2Boolean);
typedef fmi2Status call(fmi2Component);
typedef fmi2Status set_up(fmi2Component, fmi2Boolean, fmi2Real, fmi2Real, fmi2Boolean, fmi2Real);
typedef fmi2Status set_real(fmi2Component, const fmi2ValueReference *, size_t, const fmi2Real *);
typedef fmi2Status get_real(fmi2Component, const fmi2ValueReference *, size_t, fmi2Real *);
typedef fmi2Status do_step(fmi2Component, fmi2Real, fmi2Real, fmi2Boolean);

static void *library;

static void open_library(const char *path)
{
#ifdef _WIN32
  library = LoadLibraryA(path);
#else
  library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
#endif
}

/* Out: function  a pointer of its type; POSIX gives an object's address, which C turns into no function's but in memory
 */
static void find(const char *name, void *function)
{
  union {
    void *object;
    call *function;
  } *to = function;
  if (library) {
#ifdef _WIN32
    to->function = (call *)GetProcAddress((HMODULE)library, name);
#else
    to->object = dlsym(library, name);
#endif
    if (to->function)
      return;
  }
  fprintf(stderr, "steps: no %s\n", name);
  exit(1);
}

static void check(fmi2Status status, const char *what)
{
  if (status != fmi2OK) {
    fprintf(stderr, "steps: %s: status %d\n", what, (int)status);
    exit(1);
  }
}

static void ignore(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status, fmi2String category,
                   fmi2String message, ...)
{
  (void)environment, (void)instance, (void)status, (void)category, (void)message;
}

int main(int argc, char **argv)
{
  static const fmi2ValueReference in[] = {U}, out[] = {PRESSURE, POSITION};
  const fmi2CallbackFunctions callbacks = {ignore, calloc, free, NULL, NULL};
  const double step = 0.01;
  instantiate *make;
  call *enter, *leave, *end;
  set_up *begin;
  set_real *set;
  get_real *get;
  do_step *go;
  fmi2Component c;
  int i;
  if (argc == 3)
    open_library(argv[1]);
  find("fmi2Instantiate", &make);
  find("fmi2SetupExperiment", &begin);
  find("fmi2EnterInitializationMode", &enter);
  find("fmi2ExitInitializationMode", &leave);
  find("fmi2SetReal", &set);
  find("fmi2GetReal", &get);
  find("fmi2DoStep", &go);
  find("fmi2Terminate", &end);
  c = make("a", fmi2CoSimulation, argv[2], NULL, &callbacks, 0, 0);
  check(c ? fmi2OK : fmi2Error, "fmi2Instantiate");
  check(begin(c, 0, 0, 0, 0, 0), "fmi2SetupExperiment");
  check(enter(c), "fmi2EnterInitializationMode");
  check(leave(c), "fmi2ExitInitializationMode");
  for (i = 0; i < 100; i++) {
    const fmi2Real u = i < 50 ? 1 : -1;
    fmi2Real v[2];
    check(set(c, in, 1, &u), "fmi2SetReal");
    check(go(c, i * step, step, 1), "fmi2DoStep");
    check(get(c, out, 2, v), "fmi2GetReal");
    printf("%.2f,%.12g,%.12g\n", (i + 1) * step, v[0], v[1]);
  }
  check(end(c), "fmi2Terminate");
  return 0;
}
