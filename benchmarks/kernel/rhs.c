/* One right-hand side of the body's motion with the wings prescribed, by hand and eight lanes at a time.
 *
 * The arithmetic of wingbeat.mechanics.flight_model.body_rates with a coefficient model of Su-Fan's form (a sine and
 * an exponential for lift, a sine for drag), mirrored extension, force at the quarter chord. A lane is an independent
 * problem.
 * All arrays have the lanes last and their number is a multiple of WIDTH:
 *   table  (ROWS, lanes)  the leaves of WingMotion one under the other, STRIPS rows for a leaf of the strips
 *   state  (4, lanes)     body_pitch, u, w, pitch_rate; rates alike
 * Compile without -ffast-math, which would undo the rounding by a large addend.
 */
#include <math.h>
#include <stdint.h>

#define WIDTH 8
#define STRIPS 10
/* First rows of the leaves of WingMotion: those by strip have STRIPS rows. */
enum { AHEAD = 0, ABOVE = 1, FLAPPING = 1 + STRIPS, COSINE = 1 + 2 * STRIPS, PITCH = 1 + 3 * STRIPS };
enum { AREA = 1 + 4 * STRIPS, WHOLE_ROWS = 2 + 5 * STRIPS, ROWS = WHOLE_ROWS + 9 };
#define PI 3.141592653589793
#define PI_LOW 1.2246467991473532e-16
#define ROUNDER 6755399441055744.0 /* 1.5 * 2^52: adding it rounds to the nearest whole number */
#define INLINE static inline __attribute__((always_inline))

typedef double vec __attribute__((vector_size(8 * WIDTH)));
typedef double loose __attribute__((vector_size(8 * WIDTH), aligned(8), may_alias));
typedef int64_t bits __attribute__((vector_size(8 * WIDTH)));

typedef struct {
    double mass, pitch_inertia, density, gravity, drag_area, stroke_pitch, width;
    double lift_constant, lift_amplitude, lift_rate, lift_phase, decay_amplitude, decay_rate;
    double drag_constant, drag_amplitude, drag_rate, drag_phase;
    double lift_at_zero[3], lift_at_right[3], drag_at_zero[3], drag_at_right[3];
} Model;

static const double SIN[] = {1.0, -1.0 / 6, 1.0 / 120, -1.0 / 5040, 1.0 / 362880, -1.0 / 39916800,
    1.0 / 6227020800, -1.0 / 1307674368000, 1.0 / 355687428096000, -1.0 / 121645100408832000,
    1.0 / 51090942171709440000.0};
static const double ATAN[] = {1.0, -0.3333333333333312, 0.19999999999940837, -0.14285714279244968,
    0.11111110744657099, -0.09090896801472813, 0.07692045194561481, -0.06662950246036792,
    0.05846866752275139, -0.05035049795312439, 0.03796390316111083, -0.017803896394812564};
static const double EXP[] = {1.0, 1.0, 1.0 / 2, 1.0 / 6, 1.0 / 24, 1.0 / 120, 1.0 / 720, 1.0 / 5040, 1.0 / 40320,
    1.0 / 362880, 1.0 / 3628800, 1.0 / 39916800, 1.0 / 479001600, 1.0 / 6227020800};

INLINE vec all(double x) { return x - (vec){0}; }
INLINE vec choose(bits mask, vec yes, vec no) { return (vec)((mask & (bits)yes) | (~mask & (bits)no)); }
INLINE vec absolute(vec x) { return (vec)((bits)x & INT64_MAX); }
INLINE vec with_sign_of(vec x, vec of) { return (vec)((bits)x ^ ((bits)of & INT64_MIN)); }

INLINE vec root(vec x) {
    vec y;
    for (int i = 0; i < WIDTH; i++) y[i] = sqrt(x[i]);
    return y;
}

#define HORNER(table, x) horner(table, sizeof(table) / sizeof(*table), x)
INLINE vec horner(const double *c, int n, vec x) {
    vec total = all(c[n - 1]);
#pragma GCC unroll 16
    for (int i = n - 2; i >= 0; i--) total = total * x + c[i];
    return total;
}

INLINE vec sine(vec x) {
    vec shifted = x * (1 / PI) + ROUNDER, turns = shifted - ROUNDER;
    vec rest = (x - turns * PI) - turns * PI_LOW;
    return (vec)((bits)(rest * HORNER(SIN, rest * rest)) ^ ((bits)shifted << 63));
}

INLINE vec cosine(vec x) { return sine(x + 0.5 * PI); }

INLINE vec exponential(vec x) { /* for -700 < x < 700 */
    vec shifted = x * 1.4426950408889634 + ROUNDER, twos = shifted - ROUNDER;
    vec rest = (x - twos * 0.6931471805599453) - twos * 2.3190468138462996e-17;
    return (vec)((bits)HORNER(EXP, rest) + ((bits)shifted << 52));
}

INLINE vec angle(vec y, vec x, vec length) {
    vec half = absolute(y) / (length + absolute(x) + 1e-300);
    vec quarter = half / (1.0 + root(1.0 + half * half));
    vec acute = 4.0 * quarter * HORNER(ATAN, quarter * quarter);
    return with_sign_of(choose(x < 0, PI - acute, acute), y);
}

INLINE void lift_drag(const Model *m, vec alpha, vec *lift, vec *drag) {
    vec turns = (alpha * (1 / PI) + ROUNDER) - ROUNDER;
    vec folded = alpha - turns * PI, acute = absolute(folded), less = acute - 0.5 * PI;
    bits near_zero = acute < m->width, near_right = -less < m->width;
    vec squared = folded * folded, less_squared = less * less;
    vec by_formula = m->lift_constant + m->lift_amplitude * sine(m->lift_rate * acute + m->lift_phase)
                     + m->decay_amplitude * exponential(-m->decay_rate * acute);
    vec outer = choose(near_right, less * HORNER(m->lift_at_right, less_squared), by_formula);
    *lift = choose(near_zero, folded * HORNER(m->lift_at_zero, squared), with_sign_of(outer, folded));
    by_formula = m->drag_constant + m->drag_amplitude * sine(m->drag_rate * acute + m->drag_phase);
    outer = choose(near_right, HORNER(m->drag_at_right, less_squared), by_formula);
    *drag = choose(near_zero, HORNER(m->drag_at_zero, squared), outer);
}

/* Row of the table; `stride` is the number of lanes, or 0 where one column serves all. */
INLINE vec row(const double *table, long stride, int i) {
    return stride ? (vec) * (const loose *)(table + i * stride) : all(table[i]);
}
#define STRIP(leaf) row(table, stride, (leaf) + k)
#define WHOLE(leaf) row(table, stride, WHOLE_ROWS + (leaf))

INLINE void rates_of(const Model *m, const double *table, long stride, const vec *state, vec *rates) {
    vec attitude = state[0] + m->stroke_pitch;
    vec s = sine(attitude), c = cosine(attitude), u = state[1], w = state[2], q = state[3];
    vec ahead = row(table, stride, AHEAD);
    vec forward = c * u + s * w, up = c * w - s * u;
    vec force_forward = all(0), force_up = all(0), moment = all(0);
#pragma GCC unroll 1
    for (int k = 0; k < STRIPS; k++) {
        vec above = STRIP(ABOVE), cosine_of_flap = STRIP(COSINE);
        vec vc = forward - q * above;
        vec vn = (up + q * ahead) * cosine_of_flap + STRIP(FLAPPING);
        vec speed = root(vc * vc + vn * vn), lift, drag;
        vec alpha = STRIP(PITCH) - angle(vn, vc, speed);
        alpha -= 2 * PI * ((alpha * (0.5 / PI) + ROUNDER) - ROUNDER);
        lift_drag(m, alpha, &lift, &drag);
        vec pressure = (0.5 * m->density) * STRIP(AREA) * speed;
        vec along = pressure * (-lift * vn - drag * vc);
        vec across = pressure * (lift * vc - drag * vn) * cosine_of_flap;
        force_forward += along;
        force_up += across;
        moment += ahead * across - above * along;
    }
    vec body = (-0.5 * m->density * m->drag_area) * root(forward * forward + up * up);
    force_forward = 2.0 * force_forward + body * forward;
    force_up = 2.0 * force_up + body * up;
    vec fx = WHOLE(0), fz = WHOLE(1), rx = WHOLE(2), rz = WHOLE(3);
    vec pull_forward = -m->gravity * s, pull_up = -m->gravity * c;
    vec push_forward = force_forward + m->mass * pull_forward + q * (q * fx + 2.0 * rz) - WHOLE(4);
    vec push_up = force_up + m->mass * pull_up + q * (q * fz - 2.0 * rx) - WHOLE(5);
    vec turn = 2.0 * moment - fz * pull_forward + fx * pull_up - q * WHOLE(7) - WHOLE(8);
    double light = 1.0 / m->mass;
    vec inertia = m->pitch_inertia + WHOLE(6) - (fx * fx + fz * fz) * light;
    vec pitch_acceleration = (turn - (fx * push_up - fz * push_forward) * light) / inertia;
    forward = (push_forward + pitch_acceleration * fz) * light;
    up = (push_up - pitch_acceleration * fx) * light;
    rates[0] = q;
    rates[1] = c * forward - s * up;
    rates[2] = s * forward + c * up;
    rates[3] = pitch_acceleration;
}

#define STATE(array, i) (*(loose *)((array) + (i) * lanes + lane))

/* Rates of all lanes, `repeats` times over. */
void body_rates(const Model *m, const double *table, double *state, double *rates, long lanes, long repeats) {
    for (long again = 0; again < repeats; again++)
        for (long lane = 0; lane < lanes; lane += WIDTH) {
            vec here[4], there[4];
            for (int i = 0; i < 4; i++) here[i] = STATE(state, i);
            rates_of(m, table + lane, lanes, here, there);
            for (int i = 0; i < 4; i++) STATE(rates, i) = there[i];
        }
}

INLINE void runge_kutta(const Model *m, const double *tables, long stride, double step, long steps, double *state,
                        long lanes) {
    static const double advance[] = {0.5, 0.5, 1.0}, weight[] = {1.0 / 6, 1.0 / 3, 1.0 / 3, 1.0 / 6};
    static const int when[] = {0, 1, 1, 2};
    long size = ROWS * (stride ? stride : 1);
    for (long k = 0; k < steps; k++)
        for (long lane = 0; lane < lanes; lane += WIDTH) {
            vec start[4], here[4], rates[4], end[4];
            for (int i = 0; i < 4; i++) start[i] = here[i] = end[i] = STATE(state, i);
#pragma GCC unroll 1
            for (int stage = 0; stage < 4; stage++) {
                rates_of(m, tables + (2 * k + when[stage]) * size + (stride ? lane : 0), stride, here, rates);
                for (int i = 0; i < 4; i++) {
                    end[i] += step * weight[stage] * rates[i];
                    if (stage < 3) here[i] = start[i] + step * advance[stage] * rates[i];
                }
            }
            for (int i = 0; i < 4; i++) STATE(state, i) = end[i];
        }
}

/* Classical Runge-Kutta; tables (2 steps + 1, ROWS, lanes), or (2 steps + 1, ROWS) where all lanes share them. */
void march(const Model *m, const double *tables, long shared, double step, long steps, double *state, long lanes) {
    if (shared)
        runge_kutta(m, tables, 0, step, steps, state, lanes);
    else
        runge_kutta(m, tables, lanes, step, steps, state, lanes);
}
