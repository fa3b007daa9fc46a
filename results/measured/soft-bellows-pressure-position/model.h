/* The completed model of soft-bellows-pressure-position, by closeloop; for libpneu 0.1.0 with its whole catalogue.
 * const pneu_params p = MODEL_PARAMS; const pneu_laws law = MODEL_LAWS; */
#define MODEL_PARAMS \
  { \
    (pneu_real)0.001, /* area [m2] */ \
    (pneu_real)4.000000000000001e-05, /* dead_volume [m3] */ \
    (pneu_real)1, /* swept_ratio [1] */ \
    (pneu_real)0.04, /* stroke [m] */ \
    (pneu_real)1628.0838854203391, /* spring_rate [N/m] */ \
    (pneu_real)0, /* spring_preload [m] */ \
    (pneu_real)0.0332, /* moving_mass [kg] */ \
    (pneu_real)6.336671353920885, /* dry_friction [N] */ \
    (pneu_real)0.1462242338778352, /* viscous_friction [N.s/m] */ \
    (pneu_real)0, /* damping [N.s/m] */ \
    (pneu_real)0, /* external_force [N] */ \
    (pneu_real)8.93e-07, /* fill_area [m2] */ \
    (pneu_real)8.93e-07, /* vent_area [m2] */ \
    (pneu_real)0.3, /* critical_ratio [1] */ \
    (pneu_real)0.5, /* subsonic_index [1] */ \
    (pneu_real)0, /* proportional_band [Pa] */ \
    (pneu_real)100000, /* supply_pressure [Pa] */ \
    (pneu_real)293, /* supply_temperature [K] */ \
    (pneu_real)101200, /* ambient_pressure [Pa] */ \
    (pneu_real)293, /* ambient_temperature [K] */ \
    (pneu_real)287.1015193370166, /* gas_constant [J/kg/K] */ \
    (pneu_real)1.4, /* heat_ratio [1] */ \
    (pneu_real)1.4, /* polytropic_index [1] */ \
    { \
      (pneu_real)0.853913254029026, /* area_loss [1] */ \
      (pneu_real)0, /* leak_area [m2] */ \
      (pneu_real)0, /* channel_skew [s] */ \
      (pneu_real)0, /* choked_share [1] */ \
      (pneu_real)0, /* tube_resistance [Pa.s/kg] */ \
      (pneu_real)2e-05, /* tube_volume [m3] */ \
      (pneu_real)0, /* dead_time [s] */ \
      (pneu_real)0, /* exhaust_resistance [Pa.s/kg] */ \
      (pneu_real)0, /* friction_slope [1] */ \
      (pneu_real)0, /* friction_per_pressure [m2] */ \
      (pneu_real)0, /* film_resistance [K/W] */ \
      (pneu_real)0, /* film_conductance [W/K] */ \
      (pneu_real)0, /* free_convection [W/K^1.333333333333333] */ \
      (pneu_real)0, /* laminar_leak [kg/s/Pa2] */ \
      (pneu_real)0, /* porous_leak [kg/s/Pa2] */ \
      (pneu_real)300000, /* crossover_pressure [Pa] */ \
      (pneu_real)0, /* position_bias [m] */ \
      (pneu_real)0, /* position_gain [1] */ \
      (pneu_real)0, /* position_time [s] */ \
      (pneu_real)0.009996281669191932, /* presliding_length [m] */ \
      (pneu_real)0.01828602973671816, /* bristle_damping [N.s/m] */ \
      (pneu_real)3106.653210963458, /* pressure_bias [Pa] */ \
      (pneu_real)0, /* pressure_gain [1] */ \
      (pneu_real)0, /* pressure_time [s] */ \
      (pneu_real)0, /* spring_cubic [N/m3] */ \
      (pneu_real)0, /* hysteresis_force [N] */ \
      (pneu_real)0.001, /* hysteresis_length [m] */ \
      (pneu_real)0, /* stop_compliance [m/N] */ \
      (pneu_real)10000, /* stop_damping [N.s/m] */ \
      (pneu_real)0, /* stribeck_excess [1] */ \
      (pneu_real)0.001, /* stribeck_velocity [m/s] */ \
      (pneu_real)0, /* supply_resistance [Pa.s/kg] */ \
      (pneu_real)0, /* temperature_time [s] */ \
      (pneu_real)0, /* transducer_time [s] */ \
      (pneu_real)0, /* travel_loss [m] */ \
      (pneu_real)0, /* vent_restriction [1] */ \
      (pneu_real)0, /* wall_compliance [K/J] */ \
      (pneu_real)1, /* wall_loss [W/K] */ \
      (pneu_real)0 } \
  }
#define MODEL_LAWS {0, 1, 1, 0} /* isothermal, choked */
#define MODEL_N_TERMS 0
