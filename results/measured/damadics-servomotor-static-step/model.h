/* The completed model of damadics-servomotor-static-step, by closeloop; for libpneu 0.1.0 with its whole catalogue.
 * const pneu_params p = MODEL_PARAMS; const pneu_laws law = MODEL_LAWS; */
#define MODEL_PARAMS \
  { \
    (pneu_real)0.129, /* area [m2] */ \
    (pneu_real)0.0055000000000000014, /* dead_volume [m3] */ \
    (pneu_real)1, /* swept_ratio [1] */ \
    (pneu_real)0.040176450000000002, /* stroke [m] */ \
    (pneu_real)256623.40363379044, /* spring_rate [N/m] */ \
    (pneu_real)0.010792252448359239, /* spring_preload [m] */ \
    (pneu_real)2, /* moving_mass [kg] */ \
    (pneu_real)467.23309835755163, /* dry_friction [N] */ \
    (pneu_real)1500, /* viscous_friction [N.s/m] */ \
    (pneu_real)0, /* damping [N.s/m] */ \
    (pneu_real)0, /* external_force [N] */ \
    (pneu_real)8.9299999999999996e-07, /* fill_area [m2] */ \
    (pneu_real)8.9299999999999996e-07, /* vent_area [m2] */ \
    (pneu_real)0.29999999999999999, /* critical_ratio [1] */ \
    (pneu_real)0.5, /* subsonic_index [1] */ \
    (pneu_real)0, /* proportional_band [Pa] */ \
    (pneu_real)140000, /* supply_pressure [Pa] */ \
    (pneu_real)293, /* supply_temperature [K] */ \
    (pneu_real)101325, /* ambient_pressure [Pa] */ \
    (pneu_real)293, /* ambient_temperature [K] */ \
    (pneu_real)287.10151933701661, /* gas_constant [J/kg/K] */ \
    (pneu_real)1.3999999999999999, /* heat_ratio [1] */ \
    (pneu_real)1.3999999999999999, /* polytropic_index [1] */ \
    { \
      (pneu_real)0, /* area_loss [1] */ \
      (pneu_real)0, /* leak_area [m2] */ \
      (pneu_real)0, /* channel_skew [s] */ \
      (pneu_real)0, /* choked_share [1] */ \
      (pneu_real)0, /* tube_resistance [Pa.s/kg] */ \
      (pneu_real)2.0000000000000002e-05, /* tube_volume [m3] */ \
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
#define MODEL_LAWS {0, 1, 1, 0} /* isothermal, choked */
#define MODEL_N_TERMS 1
/* static const pneu_term term[] = MODEL_TERMS; pneu_model_terms(&model, term, MODEL_N_TERMS); */
#define MODEL_TERMS \
  { \
    { PNEU_TERM_FRICTION, PNEU_TERM_OVER_POSITION, 25, (pneu_real)0, (pneu_real)0.040176450000000002, /* N over x [m] */ \
      { (pneu_real)3.3779973106191795e+02, (pneu_real)1.6195919149161462e+01, (pneu_real)-9.9674198757279157e+01, \
        (pneu_real)-2.2998423810229127e+02, (pneu_real)6.4581746896887907e+01, (pneu_real)-9.3821416273075116e+01, \
        (pneu_real)1.7710611012313942e+02, (pneu_real)2.1108003412307454e+01, (pneu_real)-5.8717078077074447e+01, \
        (pneu_real)-9.4140406859507692e+01, (pneu_real)-4.6551186742185010e+01, (pneu_real)2.8129613777057106e+01, \
        (pneu_real)2.6403802609495038e+01, (pneu_real)-3.3038497576760257e+01, (pneu_real)5.6802102428376591e+00, \
        (pneu_real)1.7506892949304651e+02, (pneu_real)4.1130319186197717e+00, (pneu_real)4.3534924114313732e+01, \
        (pneu_real)1.3832913012066584e+02, (pneu_real)4.1713941938770809e+01, (pneu_real)1.4044726903943925e+02, \
        (pneu_real)-1.2141044496710822e+02, (pneu_real)1.9543566976756503e+02, (pneu_real)-5.0795304394700857e+01, \
        (pneu_real)-2.0516012416063134e+01 } } \
  }
