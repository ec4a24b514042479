/* The work of the table in C by hand, as good as its author could: no library, no check, no bound.
 * Flights go piece by piece between the zeros of f + g, where the velocity is monotone, so that Newton's method from
 * the right end of a piece cannot miss. Orbits by Newton's method on the paper's equations.
 * cc -O3 -march=native -ffp-contract=fast by_hand.c -lm */
#define _GNU_SOURCE
#include <math.h>
#include <stdio.h>
#include <time.h>

static const double G = 0.12201, PI = M_PI, TURN = 2 * M_PI;
typedef struct { double phase, sin, cos, side, velocity; } Impact; /* side 1 is the bottom; velocity just before */
typedef struct { double r_b, r_t, d, zero, sin_zero; } Walls; /* f + g = 0 at phases zero and 2 pi - zero */

static Walls walls(double r_b, double r_t, double d) { return (Walls){r_b, r_t, d, acos(-G), sin(acos(-G))}; }

/* The impact that Newton's method leads to from s, where sin and cos are known: on a Taylor polynomial around s, then
 * on one around the better s. y is the way from the last wall, u the velocity after it. 0 if the ball turns before. */
static int meet(const Impact *at, double u, double wall, double s, double sn, double cs, Impact *to) {
  const double side = at->side, P2 = PI * PI;
  for (int step = 0; step < 60; step++) {
    double y = s * (u + side * (G * s / 2 - at->sin / PI)) - side * (cs - at->cos) / P2 - wall, x = 0;
    double v = u + side * (G * s + (sn - at->sin) / PI), a = side * (G + cs) / 2, c3 = -side * PI * sn / 6;
    double c4 = -side * P2 * cs / 24, c5 = -c3 * P2 / 20, c6 = -c4 * P2 / 30;
    for (int i = 0; i < 30; i++) {
      double way = y + x * (v + x * (a + x * (c3 + x * (c4 + x * (c5 + x * c6)))));
      double rise = v + x * (2 * a + x * (3 * c3 + x * (4 * c4 + x * (5 * c5 + x * 6 * c6))));
      if (rise * v <= 0) return 0;
      double dx = way / rise;
      x -= dx;
      if (fabs(dx) < (step ? 1e-11 : 3e-2)) break;
    }
    if (s + x <= 0) return 0;
    if (fabs(x) < 5e-3) { /* what the polynomial leaves out is below rounding; so are these series */
      double t = PI * x, tt = t * t, ds = t * (1 - tt / 6 * (1 - tt / 20 * (1 - tt / 42))), dc = -tt / 2 * (1 - tt / 12 * (1 - tt / 30));
      double there = at->phase + PI * (s + x), s1 = sn + sn * dc + cs * ds, c1 = cs + cs * dc - sn * ds;
      while (there >= TURN) there -= TURN;
      *to = (Impact){there, s1, c1, wall < 0 ? -side : side, side * u + G * (s + x) + (s1 - at->sin) / PI};
      return 1;
    }
    s += x;
    sincos(at->phase + PI * s, &sn, &cs);
  }
  return 0;
}

/* The next impact. A ball pressed to its wall and slower than 1e-6 rests until f + g changes sign. */
static Impact next(Impact at, const Walls *w) {
  double side = at.side, u = -(side > 0 ? w->r_b : w->r_t) * at.velocity * side, low = 0, y = 0, v;
  if (u > -1e-6 && (at.cos + G) * side > 0)
    u = 0, at.phase = side > 0 ? w->zero : TURN - w->zero, at.sin = side * w->sin_zero, at.cos = -G;
  double press = (at.cos + G) * side, sn = at.sin, cs = at.cos;
  double ahead[2] = {w->zero - at.phase, TURN - w->zero - at.phase};
  for (int i = 0; i < 2; i++) if (ahead[i] < 1e-13) ahead[i] += TURN;
  v = u;
  Impact to;
  for (int piece = 0; piece < 4000; piece++) {
    int i = ahead[0] > ahead[1];
    double high = ahead[i] / PI, end = i ? -w->sin_zero : w->sin_zero;
    ahead[i] += TURN;
    double v_end = u + side * (G * high + (end - at.sin) / PI);
    double y_end = high * (u + side * (G * high / 2 - at.sin / PI)) - side * (-G - at.cos) / (PI * PI);
    int pressed = v_end > v;
    double braked = pressed ? -w->d : 0, sought = pressed ? 0 : -w->d; /* the walls that v and f + g may lead to */
    double sign = pressed ? 1 : -1;
    if (v * sign < 0 && (y + v * (high - low) - braked) * sign < 0 && (v_end * sign < 0 || (y_end - v_end * (high - low) - braked) * sign < 0)
        && meet(&at, u, braked, low, sn, cs, &to)) return to;
    if ((y_end - sought) * sign > 0) {
      double hop = -2 * u / press; /* back on the same wall, as in chatter */
      if (pressed && low == 0 && hop < 0.1 * high) {
        double h_sn, h_cs;
        sincos(at.phase + PI * hop, &h_sn, &h_cs);
        if (meet(&at, u, 0, hop, h_sn, h_cs, &to)) return to;
      }
      if (meet(&at, u, sought, high, end, -G, &to)) return to;
    }
    low = high, y = y_end, v = v_end, sn = end, cs = -G;
  }
  return (Impact){NAN, NAN, NAN, side, NAN};
}

static Impact start(void) { return (Impact){6.18, sin(6.18), cos(6.18), 1, 0.5293}; }

/* (10) and (12) at a 1-1 motion of r_B = r_T = 0.5, with its velocities from (14) and (9). */
static void balance(double p, double t1, double d, double out[2], double vw[2]) {
  double s0, c0, s1, c1, t2 = 2 - t1, r = 0.5, P2 = PI * PI;
  sincos(p, &s0, &c0), sincos(p + PI * t1, &s1, &c1);
  double rise = G * t1 + (s1 - s0) / PI, v = (2 * G - (1 + r) * rise) / (1 - r * r), w = rise - r * v;
  out[0] = t1 * (G / 2 * t1 - r * v - s0 / PI) - (c1 - c0) / P2 + d;
  out[1] = t2 * (G / 2 * t2 - r * w - s1 / PI) - (c0 - c1) / P2 - d;
  vw[0] = v, vw[1] = w;
}

/* Newton's method with differences: at[] = (phase, T_1). */
static void orbit(double at[2], double d, double vw[2]) {
  for (int i = 0; i < 20; i++) {
    double h = 1e-7, r[2], a[2], b[2];
    balance(at[0], at[1], d, r, vw), balance(at[0] + h, at[1], d, a, vw), balance(at[0], at[1] + h, d, b, vw);
    double j00 = a[0] - r[0], j10 = a[1] - r[1], j01 = b[0] - r[0], j11 = b[1] - r[1], det = j00 * j11 - j01 * j10;
    double x = h * (j11 * r[0] - j01 * r[1]) / det, y = h * (j00 * r[1] - j10 * r[0]) / det;
    at[0] -= x, at[1] -= y;
    if (fabs(x) + fabs(y) < 1e-9) break; /* the next step is below rounding */
  }
  double r[2];
  balance(at[0], at[1], d, r, vw);
}

/* Tr(DP) + 1 + Det(DP), 0 where the period doubles; from (18), (20), (21). at[] is a guess, then the orbit. */
static double above_doubling(double at[2], double d) {
  double vw[2], r = 0.5, t1, t2;
  orbit(at, d, vw);
  t1 = at[1], t2 = 2 - t1;
  double a = G + cos(at[0]), b = G + cos(at[0] + PI * t1), v = vw[0], w = vw[1];
  double A = (a * t1 - r * v) / w, B = r * t1 / w, C = b * A - a, D = b * B - r;
  double E = (b * t2 - r * w) / v, F = r * t2 / v, H = a * E - b, K = a * F - r;
  return E * A + F * C + H * B + K * D + 1 + r * r * r * r;
}

static double doubling(void) { /* secant method */
  double at[2] = {0.14811268, 1.31700614}, d0 = 0.26, d1 = 0.255, f0 = above_doubling(at, d0);
  for (int i = 0; i < 20; i++) {
    double f1 = above_doubling(at, d1), d2 = d1 - f1 * (d1 - d0) / (f1 - f0);
    d0 = d1, f0 = f1, d1 = d2;
    if (fabs(d1 - d0) < 1e-11) break;
  }
  return d1;
}

static double now(void) { struct timespec t; clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t); return t.tv_sec + 1e-9 * t.tv_nsec; }

static volatile double sink;
/* The least mean time of `job` over nine batches. */
#define SECONDS(least, repeats, job) do { least = INFINITY; for (int b_ = 0; b_ < 9; b_++) { double t_ = now(); \
  for (int k_ = 0; k_ < (repeats); k_++) { job; } t_ = (now() - t_) / (repeats); if (t_ < least) least = t_; } } while (0)

/* The fastest of the last 60 impacts of so many flights from the start. */
static double fastest(double d, int flights) {
  Walls w = walls(0.6, 0.3, d);
  Impact at = start();
  double most = 0;
  for (int i = 1; i <= flights; i++) {
    at = next(at, &w);
    if (i > flights - 60) most = fmax(most, fabs(at.velocity));
  }
  return most;
}

int main(void) {
  double seconds, r[][3] = {{.5, .5, .4}, {.6, .3, .26}};
  for (int i = 0; i < 2; i++) {
    Walls w = walls(r[i][0], r[i][1], r[i][2]);
    Impact at = start(), end;
    for (int k = 0; k < 100; k++) at = next(at, &w);
    end = at;
    SECONDS(seconds, 200000, at = next(at, &w));
    sink = at.phase;
    printf("%s\tC by hand\t%.3e\t%.17g;%.17g\n", i ? "impact-three" : "impact-focus", seconds, end.phase, end.velocity);
  }
  double ends[401];
  SECONDS(seconds, 1, for (int i = 0; i < 401; i++) ends[i] = fastest(0.1 + 0.001 * i, 499));
  printf("sweep\tC by hand\t%.3e\t", seconds);
  for (int i = 0; i < 401; i++) printf(i ? ";%.17g" : "%.17g", ends[i]);
  double at[2], vw[2], d;
  SECONDS(seconds, 20000, (at[0] = 0.95 * 0.4893951147, at[1] = 1.05 * 1.1165006593, orbit(at, 0.4, vw), sink = vw[0]));
  printf("\norbit\tC by hand\t%.3e\t%.17g;%.17g;%.17g\n", seconds, at[1], vw[0], vw[1]);
  SECONDS(seconds, 5000, sink = d = doubling());
  printf("doubling\tC by hand\t%.3e\t%.17g\n", seconds, d);
  return 0;
}
