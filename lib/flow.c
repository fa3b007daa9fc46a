/* Mass flow through an orifice under each flow law. */
#include "internal.h"

/* A law without area and temperature: q = area p_up gain psi(r) / sqrt(T_up), r = p_down/p_up. */
typedef struct shape {
  int slopes;          /* 0: the slope is not wanted, and may be anything */
  pneu_real gain;      /* [sqrt(kg K/J)] */
  pneu_real psi, dpsi; /* value and slope in r */
  int choked;
} shape;

/* w^m of w = 1 - r; within PNEU_BLEND of equal pressures the odd polynomial w_b^m z (a + b z^2 + c z^4),
 * z = w/w_b, which meets value, slope and curvature of the power at z = 1 and is linear at 0:
 * c = (m - 1)(m - 3)/8, b = (m - 1)(5 - m)/4, a = 1 - b - c.  Out: slope in w. */
static pneu_real power(pneu_real w, pneu_real m, int slopes, pneu_real *slope)
{
  const int root = m == PNEU_C(0.5);
  const pneu_real at = w >= PNEU_BLEND ? w : PNEU_BLEND, value = root ? PNEU_M(sqrt)(at) : PNEU_M(pow)(at, m);
  pneu_real a, b, c, z, z2;
  *slope = 0;
  if (w >= PNEU_BLEND) {
    if (slopes)
      *slope = m * value / w;
    return value;
  }
  c = (m - 1) * (m - 3) / 8;
  b = (m - 1) * (5 - m) / 4;
  a = 1 - b - c;
  z = w * (1 / PNEU_BLEND);
  z2 = z * z;
  *slope = value * (a + z2 * (3 * b + z2 * 5 * c)) * (1 / PNEU_BLEND);
  return value * z * (a + z2 * (b + z2 * c));
}

/* [B, Eq. 8]: psi = sqrt(1 - r). */
static void paper(const pneu_model *model, pneu_real w, shape *s)
{
  pneu_real slope;
  s->gain = model->paper_gain;
  s->psi = power(w, PNEU_C(0.5), s->slopes, &slope);
  s->dpsi = -slope;
  s->choked = 0;
}

/* The nozzle: psi = sqrt(r^a - r^b), a = 2/gamma, b = (gamma+1)/gamma, held below the critical ratio r_c. Written as
 * sqrt(w) G(w): G^2 is smooth and far from 0 up to choking, so that the model carries a polynomial for it, in
 * z = 2 w/w_c - 1, w_c = 1 - r_c, which interpolates it at Chebyshev's nodes: exact to 1e-14, in a third of the time of
 * two powers. With d = 1 - 1/gamma and e = r^d - 1, G = r sqrt(-e/w)/(1 + e), without cancellation. */
static pneu_real nozzle_square(const pneu_model *model, pneu_real w)
{
  const pneu_real e = PNEU_M(expm1)((1 - 1 / model->p.heat_ratio) * PNEU_M(log1p)(-w)), g = (1 - w) / (1 + e);
  return g * g * -e / w;
}

/* Add f, the value at a node z, to the sums of f(z) = sum of c_j T_j(z). */
static void add_node(pneu_real z, pneu_real f, pneu_real *c)
{
  pneu_real t = 1, next = z;
  int j;
  for (j = 0; j < PNEU_NOZZLE_TERMS; j++) {
    const pneu_real after = 2 * z * next - t;
    c[j] += (j ? 2 : 1) * f * t / PNEU_NOZZLE_TERMS;
    t = next;
    next = after;
  }
}

/* From a sum of c_j T_j(z) to powers of z. */
static void to_powers(const pneu_real *c, pneu_real *power_of_z)
{
  enum { N = PNEU_NOZZLE_TERMS };
  pneu_real before[N] = {0}, now[N] = {1}; /* T_{j-1} and T_j */
  int i, j;
  for (i = 0; i < N; i++)
    power_of_z[i] = 0;
  for (j = 0; j < N; j++)
    for (i = N - 1; i >= 0; i--) {
      const pneu_real next = (j ? 2 : 1) * (i ? now[i - 1] : 0) - before[i];
      power_of_z[i] += c[j] * now[i];
      before[i] = now[i];
      now[i] = next;
    }
}

void pneu_nozzle_prepare(pneu_model *model)
{
  const pneu_real step = PNEU_C(3.14159265358979324) / PNEU_NOZZLE_TERMS;
  pneu_real c[PNEU_NOZZLE_TERMS] = {0};
  int i;
  for (i = 0; i < PNEU_NOZZLE_TERMS; i++) {
    const pneu_real z = PNEU_M(cos)(step * ((pneu_real)i + PNEU_C(0.5)));
    add_node(z, nozzle_square(model, (1 + z) / 2 * (1 - model->critical_ratio)), c);
  }
  to_powers(c, model->nozzle);
}

/* Four terms at a time, which do not wait for each other. */
static pneu_real polynomial(const pneu_real *c, pneu_real z)
{
  const pneu_real z2 = z * z, z4 = z2 * z2;
  pneu_real sum = 0;
  int i;
  for (i = PNEU_NOZZLE_TERMS - 4; i >= 0; i -= 4)
    sum = sum * z4 + ((c[i] + c[i + 1] * z) + (c[i + 2] + c[i + 3] * z) * z2);
  return sum;
}

static pneu_real polynomial_slope(const pneu_real *c, pneu_real z)
{
  pneu_real sum = 0;
  int i;
  for (i = PNEU_NOZZLE_TERMS - 1; i > 0; i--)
    sum = sum * z + (pneu_real)i * c[i];
  return sum;
}

static void nozzle(const pneu_model *model, pneu_real w, shape *s)
{
  const pneu_real per_width = 1 / (1 - model->critical_ratio), z = 2 * w * per_width - 1;
  pneu_real g, s0, slope;
  s->gain = model->nozzle_gain;
  s->choked = 1 - w <= model->critical_ratio;
  if (s->choked) {
    s->gain = model->choked_gain;
    s->psi = 1;
    s->dpsi = 0;
    return;
  }
  g = PNEU_M(sqrt)(polynomial(model->nozzle, z));
  s0 = power(w, PNEU_C(0.5), s->slopes, &slope);
  s->psi = s0 * g;
  if (s->slopes)
    s->dpsi = -(slope * g + s0 * polynomial_slope(model->nozzle, z) * per_width / g);
}

/* phi = (1 - ((r - b)/(1 - b))^2)^m = (w (1 + z)/(1 - b))^m, z = (r - b)/(1 - b); 1 below b. */
static void iso6358(const pneu_model *model, pneu_real w, shape *s)
{
  const pneu_real b = model->p.critical_ratio, m = model->p.subsonic_index;
  pneu_real c, cm, s0, slope;
  s->gain = model->choked_gain;
  s->choked = 1 - w <= b;
  if (s->choked) {
    s->psi = 1;
    s->dpsi = 0;
    return;
  }
  c = (2 - 2 * b - w) / ((1 - b) * (1 - b)); /* (1 + z)/(1 - b) */
  cm = m == PNEU_C(0.5) ? PNEU_M(sqrt)(c) : PNEU_M(pow)(c, m);
  s0 = power(w, m, s->slopes, &slope);
  s->psi = s0 * cm;
  s->dpsi = cm * (s0 * m / (c * (1 - b) * (1 - b)) - slope);
}

typedef void shape_function(const pneu_model *, pneu_real, shape *);
static shape_function *const shapes[PNEU_FLOW_COUNT] = {paper, nozzle, iso6358};

/* An orifice and what lies on both sides. */
typedef struct passage {
  pneu_real area, p_up, T_up, p_down;
} passage;

/* As pneu_orifice; without `slopes` these stay as they are. */
static void orifice(const pneu_model *model, int law, const passage *at, int slopes, pneu_flow *flow)
{
  const pneu_real r = at->p_down / at->p_up;
  pneu_real k;
  shape s;
  s.slopes = slopes;
  shapes[law](model, 1 - r, &s);
  k = at->area * s.gain / PNEU_M(sqrt)(at->T_up);
  flow->q = k * at->p_up * s.psi;
  flow->choked = s.choked;
  if (!slopes)
    return;
  flow->dq_dup = k * (s.psi - r * s.dpsi);
  flow->dq_ddown = k * s.dpsi;
  flow->dq_dT = -flow->q / (2 * at->T_up);
}

void pneu_orifice(const pneu_model *model, int law, pneu_real area, pneu_real p_up, pneu_real T_up, pneu_real p_down,
                  pneu_flow *flow)
{
  const passage at = {area, p_up, T_up, p_down};
  orifice(model, law, &at, 1, flow);
}

pneu_real pneu_sonic_conductance(const pneu_model *model, pneu_real area)
{
  /* choked: q = C rho_0 p_up sqrt(T_0/T_up) with rho_0 = 100 kPa/(R T_0), T_0 = 293.15 K */
  return area * model->choked_gain * model->p.gas_constant * PNEU_M(sqrt)(PNEU_C(293.15)) / PNEU_C(1e5);
}

/* The declared law, mixed with the nozzle's as far as choked_flow says; so are the slopes that Newton needs below. The
 * one in T serves the analytic Jacobian alone, which is not used with an effect. Here and below: only effects ask for
 * that and for a line, and a build without effects need not link it. */
static void mixed_flow(const pneu_terms *t, const passage *at, int slopes, pneu_flow *flow)
{
  const pneu_real c = t->choked_share;
  pneu_flow nozzle_flow;
  if (t->model->own_flow)
    t->model->own_flow(t->model, at->area, at->p_up, at->T_up, at->p_down, flow);
  else
    orifice(t->model, t->model->law.flow, at, slopes, flow);
  if (PNEU_EFFECT_COUNT == 0 || c == 0)
    return;
  orifice(t->model, PNEU_FLOW_CHOKED, at, slopes, &nozzle_flow);
  flow->q += c * (nozzle_flow.q - flow->q);
  flow->choked = nozzle_flow.choked;
  if (!slopes)
    return;
  flow->dq_dup += c * (nozzle_flow.dq_dup - flow->dq_dup);
  flow->dq_ddown += c * (nozzle_flow.dq_ddown - flow->dq_ddown);
}

/* Find the orifice that stands for the turbulence of a line: one under the model's law that by itself loses
 * resistance turbulence q_f at the full flow q_f of the fill orifice, were that little. A law begins as
 * area sqrt(p_up (p_up - p_down)); under ISO 6358 with a subsonic index other than 0.5 it is compared where the share
 * 2 PNEU_BLEND of p_up is lost.
 * In/out:  line  area; nothing is lost yet */
static void make_ready(const pneu_terms *t, pneu_line *line)
{
  static const pneu_real little = 2 * PNEU_BLEND; /* of p_up */
  const pneu_params *p = &t->model->p;
  const pneu_real T = p->supply_temperature, p_up = t->model->scale[0], lost = line->resistance * line->turbulence;
  const passage at = {1, p_up, T, p_up * (1 - little)};
  pneu_flow flow;
  line->area = line->lost = 0;
  if (!(lost > 0 && p->fill_area > 0))
    return;
  mixed_flow(t, &at, 0, &flow);
  line->area = PNEU_M(sqrt)(t->model->choked_gain * p->fill_area / (PNEU_M(sqrt)(T) * lost) * little) * p_up / flow.q;
}

/* Flow through a line that is ready, of a resistance above 0, q: linear q + (p_up - p_down) (q/q_o)^2 = p_up - p_down
 * is lost, where linear = resistance (1 - turbulence), and q_o is what passes the orifice.
 * In:      p_up >= p_down [Pa] abs, T_up [K]
 * Out:     flow  q [kg/s] and its slopes in the pressures */
static void line_flow(const pneu_terms *t, const pneu_line *line, pneu_real p_up, pneu_real T_up, pneu_real p_down,
                      pneu_flow *flow)
{
  const pneu_real lost = p_up - p_down, linear = line->resistance * (line->area > 0 ? 1 - line->turbulence : 1);
  const passage at = {line->area, p_up, T_up, p_down};
  pneu_real ratio, bend, root, sum;
  if (!(line->area > 0)) {
    flow->dq_dup = 1 / linear;
    flow->dq_ddown = -flow->dq_dup;
    flow->q = lost * flow->dq_dup;
    return;
  }
  mixed_flow(t, &at, 1, flow);
  ratio = flow->q > 0 ? lost / flow->q : 1 / flow->dq_dup;
  root = PNEU_M(sqrt)(linear * linear + 4 * ratio * ratio);
  sum = linear + root;
  bend = flow->q > 0 ? 4 * ratio * ratio / (root * sum) : 0;
  flow->dq_dup = 2 / sum * (1 - bend * (1 - ratio * flow->dq_dup));
  flow->dq_ddown = -2 / sum * (1 - bend * (1 + ratio * flow->dq_ddown));
  flow->q = 2 * lost / sum;
}

pneu_real pneu_line_pass(const pneu_terms *t, pneu_real resistance, pneu_real turbulence, pneu_real p_from,
                         pneu_real T_from, pneu_real p_to, pneu_real T_to, pneu_real *slope)
{
  static const pneu_real least = PNEU_C(1e4); /* [Pa s/kg] */
  pneu_line line = {PNEU_M(fmax)(resistance, least), turbulence, 0, 0};
  const int forth = p_from > p_to;
  pneu_flow flow;
  make_ready(t, &line);
  if (forth)
    line_flow(t, &line, p_from, T_from, p_to, &flow);
  else
    line_flow(t, &line, p_to, T_to, p_from, &flow);
  *slope = flow.dq_dup;
  return forth ? flow.q : -flow.q;
}

/* An orifice in series with a line, between p_up and p_down: which pressure lies between them. */
typedef struct series {
  const pneu_terms *t;
  passage whole;
  pneu_line *line;
  int before; /* the line lies before the orifice, else behind it */
} series;

enum { SERIES_ITERATIONS = 16 };

/* Flow of the orifice less that of the line, at a pressure between, and its slope. */
static pneu_real series_gap(const series *s, pneu_real p, pneu_flow *flow, pneu_real *slope)
{
  const pneu_real up = s->before ? s->whole.p_up : p, down = s->before ? p : s->whole.p_down;
  passage at = s->whole;
  pneu_flow through;
  line_flow(s->t, s->line, up, at.T_up, down, &through);
  *(s->before ? &at.p_up : &at.p_down) = p;
  mixed_flow(s->t, &at, 1, flow);
  *slope = s->before ? flow->dq_dup - through.dq_ddown : flow->dq_ddown - through.dq_dup;
  s->line->lost = s->before ? up - down : down - up;
  return flow->q - through.q;
}

/* Newton, kept inside the bracket by bisection; so many times at most, so that the work is bounded. */
static void series_flow(const series *s, pneu_flow *flow)
{
  pneu_real low = s->whole.p_down, high = s->whole.p_up, p = s->before ? high : low, slope;
  int i;
  for (i = 0; i < SERIES_ITERATIONS; i++) {
    const pneu_real gap = series_gap(s, p, flow, &slope), before = p;
    if ((gap > 0) == (s->before != 0))
      high = p;
    else
      low = p;
    p -= gap / slope;
    if (!(p >= low && p <= high))
      p = (low + high) / 2;
    if (p == before)
      return;
  }
  series_gap(s, p, flow, &slope);
}

/* Flow from up to down, through a line before or behind the orifice if there is one. */
static void flow_between(const pneu_terms *t, const passage *at, pneu_line *line, int before, pneu_flow *flow)
{
  if (PNEU_EFFECT_COUNT > 0 && line && line->resistance > 0 && at->p_up > at->p_down) {
    const series s = {t, *at, line, before};
    make_ready(t, line);
    series_flow(&s, flow);
  } else
    mixed_flow(t, at, t->extent == PNEU_EXTENT_SLOPES, flow);
}

void pneu_let_in(pneu_terms *t, pneu_real q)
{
  if (t->model->law.pressure_input)
    return;
  if (q > 0) {
    t->mass_in += q;
    t->mass_in_T += q * t->model->p.ambient_temperature;
  } else
    t->mass_out -= q;
}

int pneu_exchange(pneu_terms *t, pneu_real area, pneu_real p_other, pneu_real T_other, pneu_line *line)
{
  const int out = p_other < t->p;
  pneu_flow flow = {0, 0, 0, 0, 0};
  if (area <= 0)
    return 0;
  if (out) {
    const passage at = {area, t->p, t->T, p_other};
    flow_between(t, &at, line, 0, &flow);
    t->mass_out += flow.q;
  } else {
    const passage at = {area, p_other, T_other, t->p};
    flow_between(t, &at, line, 1, &flow);
    t->mass_in += flow.q;
    t->mass_in_T += flow.q * T_other;
  }
  if (t->extent < PNEU_EXTENT_SLOPES)
    return flow.choked;
  if (out) {
    t->dout_dp += flow.dq_dup;
    t->dout_dT += flow.dq_dT;
  } else
    t->din_dp += flow.dq_ddown;
  return flow.choked;
}
