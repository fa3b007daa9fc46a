/* The completed model of tube-vent, by closeloop; for libpneu 0.1.0 with its whole catalogue.
 * const pneu_params p = MODEL_PARAMS; const pneu_laws law = MODEL_LAWS; */
#define MODEL_PARAMS \
  { \
    (pneu_real)0.00012565999999999999, /* area [m2] */ \
    (pneu_real)2.1832120247732462e-07, /* dead_volume [m3] */ \
    (pneu_real)1, /* swept_ratio [1] */ \
    (pneu_real)0.80000000000000004, /* stroke [m] */ \
    (pneu_real)400000, /* spring_rate [N/m] */ \
    (pneu_real)0.01, /* spring_preload [m] */ \
    (pneu_real)2, /* moving_mass [kg] */ \
    (pneu_real)480, /* dry_friction [N] */ \
    (pneu_real)500, /* viscous_friction [N.s/m] */ \
    (pneu_real)1000, /* damping [N.s/m] */ \
    (pneu_real)0, /* external_force [N] */ \
    (pneu_real)1.3999999999999999e-06, /* fill_area [m2] */ \
    (pneu_real)6.0058158343509442e-06, /* vent_area [m2] */ \
    (pneu_real)0.29999999999999999, /* critical_ratio [1] */ \
    (pneu_real)0.5, /* subsonic_index [1] */ \
    (pneu_real)0, /* proportional_band [Pa] */ \
    (pneu_real)500000, /* supply_pressure [Pa] */ \
    (pneu_real)295, /* supply_temperature [K] */ \
    (pneu_real)101325, /* ambient_pressure [Pa] */ \
    (pneu_real)295, /* ambient_temperature [K] */ \
    (pneu_real)287.10151933701661, /* gas_constant [J/kg/K] */ \
    (pneu_real)1.3999999999999999, /* heat_ratio [1] */ \
    (pneu_real)1.3999999999999999, /* polytropic_index [1] */ \
    { \
      (pneu_real)0, /* area_loss [1] */ \
      (pneu_real)0, /* leak_area [m2] */ \
      (pneu_real)0, /* channel_skew [s] */ \
      (pneu_real)0, /* choked_share [1] */ \
      (pneu_real)59969559.297765158, /* tube_resistance [Pa.s/kg] */ \
      (pneu_real)1.0489011218227284e-05, /* tube_volume [m3] */ \
      (pneu_real)0.024810850846733727, /* dead_time [s] */ \
      (pneu_real)0, /* exhaust_resistance [Pa.s/kg] */ \
      (pneu_real)0, /* friction_slope [1] */ \
      (pneu_real)0, /* friction_per_pressure [m2] */ \
      (pneu_real)0, /* film_resistance [K/W] */ \
      (pneu_real)0, /* film_conductance [W/K] */ \
      (pneu_real)0, /* free_convection [W/K^1.333333333333333] */ \
      (pneu_real)0, /* laminar_leak [kg/s/Pa2] */ \
      (pneu_real)0, /* porous_leak [kg/s/Pa2] */ \
      (pneu_real)300000, /* crossover_pressure [Pa] */ \
      (pneu_real)0.17059191534570206, /* position_bias [m] */ \
      (pneu_real)0, /* position_gain [1] */ \
      (pneu_real)0, /* position_time [s] */ \
      (pneu_real)0, /* presliding_length [m] */ \
      (pneu_real)1000, /* bristle_damping [N.s/m] */ \
      (pneu_real)0, /* pressure_bias [Pa] */ \
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
#define MODEL_LAWS {0, 1, 0, 1} /* isothermal, choked */
#define MODEL_N_TERMS 1
/* static const pneu_term term[] = MODEL_TERMS; pneu_model_terms(&model, term, MODEL_N_TERMS); */
#define MODEL_TERMS \
  { \
    { PNEU_TERM_SHOWN_PRESSURE, PNEU_TERM_OVER_PRESSURE, 13, (pneu_real)0, (pneu_real)609218, /* Pa over p [Pa] */ \
      { (pneu_real)9.8129939482116947e+02, (pneu_real)-1.1284265528199503e+04, (pneu_real)-1.4862524608298780e+04, \
        (pneu_real)-1.7440007194663576e+04, (pneu_real)7.3853917954411345e+03, (pneu_real)-4.5767668426480894e+04, \
        (pneu_real)-9.1505088513456521e+03, (pneu_real)1.9811243185464900e+04, (pneu_real)1.9255279463309175e+03, \
        (pneu_real)4.4358138591039751e+04, (pneu_real)2.0483842894936472e+04, (pneu_real)3.5607000550200719e+04, \
        (pneu_real)-1.3999095271095890e+04 } } \
  }
