// How much later does the stem arrive when there is more volume between transducer and diaphragm?
// SPDX-License-Identifier: MIT
#include <cstdio>
#include <stdexcept>

#include <pneu.h>

namespace
{

class actuator
{
public:
  explicit actuator(double dead_volume) : work()
  {
    const pneu_laws law = {PNEU_GAS_POLYTROPIC, PNEU_FLOW_ISO6358, 0, 0};
    pneu_params params;
    pneu_params_default(&params);
    params.dead_volume = dead_volume;
    require(pneu_model_init(&model, &params, &law, NULL));
    pneu_input_default(&model, &input);
    require(pneu_state_rest(&model, 0, params.ambient_temperature, 0, &input, &state));
  }

  // [s] from the command to the upper stop
  double fill_time()
  {
    const double step = 1e-3;
    double t = 0;
    input.u = 1;
    for (; state.mode != PNEU_MODE_UPPER; t += step) {
      if (t > 60)
        throw std::runtime_error("the stem does not arrive");
      require(pneu_step(&model, &state, &input, step, &work));
    }
    return t;
  }

private:
  static void require(int status)
  {
    if (status != PNEU_OK)
      throw std::runtime_error(pneu_status_text(status));
  }

  pneu_model model;
  pneu_workspace work;
  pneu_input input;
  pneu_state state;
};

} // namespace

int main()
{
  const double litres[] = {0.002, 0.04, 0.4, 1.2};
  double before = 0;
  bool grows = true;
  for (unsigned i = 0; i < sizeof litres / sizeof *litres; i++) {
    const double time = actuator(1e-3 * litres[i]).fill_time();
    std::printf("%6.3f L  %6.3f s\n", litres[i], time);
    grows = grows && time > before;
    before = time;
  }
  return grows ? 0 : 1;
}
