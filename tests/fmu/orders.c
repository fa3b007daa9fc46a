/* An FMI 3 importer without manners, linked with the sources of an FMU under the sanitizers: calls in any order, with
 * any numbers, on several instances; then, if asked for, one with fixed steps, that knows events by changes of sign
 * alone and prints time, position and mode.
 *   orders TOKEN CALLS SEED [STEP] */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "calls.h"

enum { INSTANCES = 3, STATES_MAX = 32, BYTES_MAX = 1 << 16 };

static const char *token;
static unsigned long long seed;

static unsigned draw(unsigned n)
{
  seed = seed * 6364136223846793005ULL + 1442695040888963407ULL;
  return (unsigned)(seed >> 33) % n;
}

static double any_number(void)
{
  static const double odd[] = {0, 1, -1, 0.5, 1e-3, 300, 1e5, 4e5, -1e5, 1e300, -1e300};
  const unsigned i = draw(16);
  return i < 11 ? odd[i] : i == 11 ? (double)NAN : i == 12 ? (double)INFINITY : draw(1000) / 500.0 - 1;
}

static fmi3ValueReference any_reference(void)
{
  static const fmi3ValueReference first[] = {0, 11, 21, 41, 100, 200, 300, 1000, 1023, 99999};
  return first[draw(10)] + draw(12);
}

static fmi3Instance make(void)
{
  return draw(2) ? fmi3InstantiateModelExchange("a", token, NULL, false, false, NULL, NULL)
                 : fmi3InstantiateCoSimulation("b", token, NULL, false, false, false, false, NULL, 0, NULL, NULL, NULL);
}

/* One call with one instance; half of them are such as come next in a run.  Returns: its status */
static int call(fmi3Instance *c, fmi3FMUState *state, double *t)
{
  static fmi3Byte bytes[BYTES_MAX];
  fmi3ValueReference r = any_reference(), pair[2];
  fmi3Float64 v = any_number(), x[STATES_MAX], seeds[2] = {any_number(), any_number()};
  fmi3Int32 whole;
  fmi3Boolean a, b, d, e, f;
  size_t n = 0, z = 0, size = 0;
  int status;
  fmi3GetNumberOfContinuousStates(*c, &n);
  fmi3GetNumberOfEventIndicators(*c, &z);
  if (n > STATES_MAX || z > STATES_MAX)
    abort();
  switch (draw(26)) {
  case 0:
    fmi3FreeFMUState(*c, state);
    fmi3FreeInstance(*c);
    *c = draw(20) ? make() : NULL;
    *t = 0;
    return fmi3OK;
  case 1:
    *t = 0;
    return fmi3EnterInitializationMode(*c, draw(2), v, 0, false, 0);
  case 2:
  case 3:
    return fmi3ExitInitializationMode(*c);
  case 4:
    return draw(8) ? fmi3OK : fmi3Terminate(*c);
  case 5:
    *t = 0;
    return draw(8) ? fmi3OK : fmi3Reset(*c);
  case 6:
    return fmi3GetFloat64(*c, &r, 1, &v, 1);
  case 7:
    return fmi3SetFloat64(*c, &r, 1, &v, 1);
  case 8:
    r = 1 + draw(7);
    return fmi3SetFloat64(*c, &r, 1, &v, 1);
  case 9:
    r = 41 + draw(3);
    return fmi3GetInt32(*c, &r, 1, &whole, 1);
  case 10:
    return fmi3EnterEventMode(*c);
  case 11:
    return fmi3EnterContinuousTimeMode(*c);
  case 12:
    return fmi3UpdateDiscreteStates(*c, &a, &b, &d, &e, &f, &v);
  case 13:
    return fmi3CompletedIntegratorStep(*c, true, &a, &b);
  case 14:
    return fmi3SetTime(*c, *t += 1e-3 * draw(10));
  case 15:
    status = fmi3GetContinuousStates(*c, x, n);
    if (status == fmi3OK && n > 0 && draw(2))
      x[draw((unsigned)n)] = any_number();
    return status == fmi3OK ? (int)fmi3SetContinuousStates(*c, x, n) : status;
  case 16:
    return fmi3GetContinuousStateDerivatives(*c, x, n + (draw(8) == 0));
  case 17:
    return fmi3GetEventIndicators(*c, x, z);
  case 18:
    return fmi3GetNominalsOfContinuousStates(*c, x, n);
  case 19:
  case 20:
    status = fmi3DoStep(*c, draw(8) ? *t : v, draw(8) ? 1e-3 * draw(20) : v, true, &a, &b, &d, &v);
    *t = status == fmi3OK ? v : *t;
    return status;
  case 21:
    return fmi3GetFMUState(*c, state);
  case 22:
    return *state ? fmi3SetFMUState(*c, *state) : fmi3OK;
  case 23:
    if (*state && fmi3SerializedFMUStateSize(*c, *state, &size) == fmi3OK && size <= BYTES_MAX &&
        fmi3SerializeFMUState(*c, *state, bytes, size) == fmi3OK) {
      fmi3FreeFMUState(*c, state);
      if (draw(2)) /* damaged on the way */
        bytes[draw((unsigned)size)] ^= (fmi3Byte)(1u << draw(8));
      return fmi3DeserializeFMUState(*c, bytes, size, state);
    }
    return fmi3OK;
  case 24:
    pair[0] = any_reference();
    pair[1] = 1 + draw(7);
    return fmi3GetDirectionalDerivative(*c, &r, 1, pair, 2, seeds, 2, x, 1);
  default:
    return fmi3EnterStepMode(*c);
  }
}

static int disorder(long calls)
{
  fmi3Instance c[INSTANCES] = {NULL};
  fmi3FMUState state[INSTANCES] = {NULL};
  double t[INSTANCES] = {0};
  long count[5] = {0}, i;
  int k;
  for (i = 0; i < calls; i++) {
    int status;
    k = (int)draw(INSTANCES);
    status = call(&c[k], &state[k], &t[k]);
    if (status < fmi3OK || status > fmi3Error) {
      printf("call %ld gave status %d\n", i, status);
      return 1;
    }
    count[status]++;
  }
  for (k = 0; k < INSTANCES; k++) {
    free(state[k]);
    fmi3FreeInstance(c[k]);
  }
  fprintf(stderr, "%ld right, %ld discarded, %ld refused\n", count[fmi3OK], count[fmi3Discard], count[fmi3Error]);
  return count[fmi3OK] < calls / 10 || count[fmi3Error] < calls / 10; /* else it has tried nothing */
}

/* After an event no indicator may stand at or above 0, or its next crossing would be lost. */
static int all_armed(const fmi3Float64 *z, size_t n)
{
  size_t k;
  for (k = 0; k < n; k++)
    if (!(z[k] < 0))
      return 0;
  return 1;
}

/* Fill for 1 s from t = 0 and vent for 1 s, by forward Euler. */
static int fixed_steps(double h)
{
  fmi3Instance c = fmi3InstantiateModelExchange("euler", token, NULL, false, false, NULL, NULL);
  const fmi3ValueReference u = 1, position = 23, mode_reference = 41;
  fmi3Float64 x[STATES_MAX], dx[STATES_MAX], z[STATES_MAX], before[STATES_MAX], command = 1, next, at;
  fmi3Boolean a, b, d, changed, timed, step_event, stop;
  fmi3Int32 mode;
  size_t n, n_z, k;
  long i, steps = (long)(2 / h + 0.5);
  int status;
  fmi3GetNumberOfContinuousStates(c, &n);
  fmi3GetNumberOfEventIndicators(c, &n_z);
  fmi3SetFloat64(c, &u, 1, &command, 1);
  status = fmi3EnterInitializationMode(c, false, 0, 0, false, 0);
  status |= fmi3ExitInitializationMode(c);
  status |= fmi3UpdateDiscreteStates(c, &a, &b, &d, &changed, &timed, &next);
  status |= fmi3EnterContinuousTimeMode(c);
  status |= fmi3GetContinuousStates(c, x, n);
  status |= fmi3GetEventIndicators(c, before, n_z);
  for (i = 0; i < steps && status == fmi3OK; i++) {
    const double t = (double)(i + 1) * h;
    int event = i + 1 == steps / 2 || (timed && t >= next - h / 2);
    status |= fmi3GetContinuousStateDerivatives(c, dx, n);
    for (k = 0; k < n; k++)
      x[k] += h * dx[k];
    status |= fmi3SetTime(c, t);
    status |= fmi3SetContinuousStates(c, x, n);
    status |= fmi3GetEventIndicators(c, z, n_z);
    status |= fmi3CompletedIntegratorStep(c, true, &step_event, &stop);
    for (k = 0; k < n_z; k++)
      event |= (z[k] > 0) != (before[k] > 0);
    if (event || step_event) {
      status |= fmi3EnterEventMode(c);
      if (i + 1 == steps / 2) {
        command = -1;
        status |= fmi3SetFloat64(c, &u, 1, &command, 1);
      }
      status |= fmi3UpdateDiscreteStates(c, &a, &b, &d, &changed, &timed, &next);
      status |= fmi3EnterContinuousTimeMode(c);
      status |= fmi3GetContinuousStates(c, x, n);
      status |= fmi3GetEventIndicators(c, z, n_z);
      if (!all_armed(z, n_z)) {
        fprintf(stderr, "an indicator is not below 0 after an event at %.9g s\n", t);
        status = fmi3Error;
      }
    }
    memcpy(before, z, sizeof before);
    if (i % (steps / 20) == 0 || i + 1 == steps) {
      status |= fmi3GetFloat64(c, &position, 1, &at, 1);
      status |= fmi3GetInt32(c, &mode_reference, 1, &mode, 1);
      printf("%.9g,%.9g,%d\n", t, at, (int)mode);
    }
  }
  fmi3FreeInstance(c);
  return status;
}

int main(int argc, char **argv)
{
  if (argc != 4 && argc != 5)
    return 2;
  token = argv[1];
  seed = strtoull(argv[3], NULL, 10);
  return disorder(atol(argv[2])) || (argc == 5 && fixed_steps(atof(argv[4])));
}
