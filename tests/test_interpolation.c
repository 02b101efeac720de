/* Barycentric interpolation against Lagrange's products in twice the digits. */
#include "gvi_test.h"
#include "wide.h"

#if GVI__KIND == 1
#define NORMAL  FLT_MIN
#define GREAT   1e37f
#elif GVI__KIND == 2
#define NORMAL  DBL_MIN
#define GREAT   1e307
#else
#define NORMAL  LDBL_MIN
#define GREAT   1e4931L
#endif
#define LEAST   (NORMAL*EPS)                    /* the smallest subnormal */

#define MOST 1000
#define FEW  20

/* l_j(t) by the product. */
static wide lagrange(int n, const gvi_real *x, int j, wide t)
{
    wide l = 1;
    for (int k = 0; k < n; ++k)
        if (k != j) l *= (t - x[k])/((wide)x[j] - x[k]);
    return l;
}

/* l_j'(t) by the product rule.  condition: what one relative unit in every difference x_j - x_k and t - x_k
   makes of it: the terms of the sum, added in absolute value. */
static wide lagrange_derivative(int n, const gvi_real *x, int j, wide t, wide *condition)
{
    wide sum = 0;
    *condition = 0;
    for (int m = 0; m < n; ++m) {
        if (m == j) continue;
        wide term = 1/((wide)x[j] - x[m]);
        for (int k = 0; k < n; ++k)
            if (k != j && k != m) term *= (t - x[k])/((wide)x[j] - x[k]);
        sum += term;
        *condition += wide_abs(term);
    }
    return sum;
}

/* p = sum l_j f_j, lebesgue = sum |l_j|, greatest = max |f_j|. */
struct exact { wide p, lebesgue, greatest; };

static struct exact exact_value(int n, const gvi_real *x, const gvi_real *f, wide t)
{
    struct exact e = { 0, 0, 0 };
    for (int j = 0; j < n; ++j) {
        wide l = lagrange(n, x, j, t);
        e.p += l*f[j];
        e.lebesgue += wide_abs(l);
        if (wide_abs(f[j]) > e.greatest) e.greatest = wide_abs(f[j]);
    }
    return e;
}

/* A relative error of one unit in each value may move p by lebesgue*greatest
   units, near and far; some 4n roundings are in every term. */
static wide value_bound(int n, struct exact e)
{
    return (4*n*UNIT + 4*n*WIDE_EPS)*e.lebesgue*e.greatest + NORMAL;
}

static const wide pi = 3.14159265358979323846264338327950288L;

static void equispaced(int n, gvi_real *x)
{
    for (int i = 0; i < n; ++i) x[i] = n > 1 ? (gvi_real)(2*i - n + 1)/(gvi_real)(n - 1) : (gvi_real)0.25;
}

static void chebyshev(int n, gvi_real *x)
{
    for (int i = 0; i < n; ++i) x[i] = (gvi_real)-cosl((long double)(pi*(2*i + 1)/(2*n)));
}

static void chebyshev_with_ends(int n, gvi_real *x)
{
    for (int i = 0; i < n; ++i) x[i] = (gvi_real)-cosl((long double)(pi*i/(n > 1 ? n - 1 : 1)));
}

static void scattered(int n, gvi_real *x)       /* in no order, 0 among them */
{
    dice = 17;
    for (int i = 0; i < n; ++i) x[i] = random_unit();
    x[n/2] = 0;
}

static void clustered(int n, gvi_real *x)       /* towards 0, at 0, and beyond */
{
    for (int i = 0; i < n; ++i) x[i] = i == 0 ? 0 : (i % 2 ? 1 : -1)*(gvi_real)ldexp(1, -i/2);
}

typedef void nodes_fn(int n, gvi_real *x);
static nodes_fn *const families[] = { equispaced, chebyshev, chebyshev_with_ends, scattered, clustered };

/* 1 to `last` nodes x of each family */
#define EACH_NODES(x, n, last) \
    for (int k_ = 0; k_ < COUNT(families); ++k_) \
        for (int n = 1; n <= (last) && (families[k_](n, x), 1); ++n)

static gvi_real next_after(gvi_real x, gvi_real towards)
{
#if GVI__KIND == 1
    return nextafterf(x, towards);
#elif GVI__KIND == 2
    return nextafter(x, towards);
#else
    return nextafterl(x, towards);
#endif
}

/* Where to look: nodes, closest neighbours of nodes, nearly there, between,
   outside.  Returns how many. */
static int places(int n, const gvi_real *x, gvi_real *t)
{
    int count = 0;
    for (int i = 0; i < n; ++i) {
        t[count++] = x[i];
        t[count++] = next_after(x[i], 9);
        t[count++] = next_after(x[i], -9);
        t[count++] = x[i] + 100*(gvi_real)EPS;
        t[count++] = x[i] - (gvi_real)1e-5L;
        t[count++] = (x[i] + x[(i + 1) % n])/2;
        t[count++] = x[i] + (x[(i + 2) % n] - x[i])*(gvi_real)0.43L;
    }
    /* far outside l_j is 10^15 and more: what they have in common must not cancel before the values are seen */
    const gvi_real others[] = { -LEAST, 100*LEAST, -1/GREAT, -(gvi_real)1.3L, (gvi_real)1.01L, 2, -3, -50, 1000, -100000 };
    for (int i = 0; i < COUNT(others) - (n > 6 ? 3 : 0); ++i) t[count++] = others[i];          /* l_j overflow a float */
    return count;
}

#define PLACES (7*FEW + 10)

/* prod_(k /= j) (x_j - x_k) = mantissa 2^exponent, 2^-64 <= |mantissa| < 2^64. */
struct scaled { wide mantissa; int exponent; };

static struct scaled node_product(int n, const gvi_real *x, int j)
{
    const wide big = 18446744073709551616.0L;
    struct scaled z = { 1, 0 };
    for (int k = 0; k < n; ++k) {
        if (k == j) continue;
        int e;
        z.mantissa *= frexpl((long double)((wide)x[j] - x[k]), &e);
        z.exponent += e;
        for (; wide_abs(z.mantissa) < 1/big; z.exponent -= 64) z.mantissa *= big;
    }
    return z;
}

/* |a| < |b|, roughly enough: up to a factor that changes nothing but which of
   two equal maxima is taken. */
static int smaller(struct scaled a, struct scaled b)
{
    long double d = ldexpl((long double)wide_abs(a.mantissa/b.mantissa), a.exponent - b.exponent);
    return d < 1;
}

static void check_weights(int n, const gvi_real *x, const gvi_real *w)
{
    int best = 0;
    gvi_real biggest = 0;
    struct scaled least = node_product(n, x, 0);
    for (int j = 1; j < n; ++j) {
        struct scaled z = node_product(n, x, j);
        if (smaller(z, least)) least = z, best = j;
    }
    for (int j = 0; j < n; ++j) {
        /* 2n roundings for w_j, as many for the greatest by which it is divided */
        struct scaled z = node_product(n, x, j);
        wide exact = (wide)ldexpl((long double)(least.mantissa/z.mantissa), least.exponent - z.exponent);
        gvi_real sign = w[best] < 0 ? -1 : 1;
        if (node_product(n, x, best).mantissa < 0) sign = -sign;
        if (least.mantissa < 0) exact = -exact;
        assert_close(sign*w[j], exact, 4*n*UNIT*wide_abs(exact) + NORMAL);
        if ((w[j] < 0 ? -w[j] : w[j]) > biggest) biggest = w[j] < 0 ? -w[j] : w[j];
    }
    assert_true(same(biggest, 1));
}

TEST(weights_are_the_reciprocal_products_with_a_maximum_of_one)
{
    gvi_real x[FEW], w[FEW];
    EACH_NODES(x, n, FEW) {
        assert_ok(gvi_barycentric(n, x, w));
        check_weights(n, x, w);
    }
}

TEST(weights_have_the_sign_of_the_products)
{
    const gvi_real x[] = { 3, 1, 2 };                 /* products 2, 2, -1 */
    gvi_real w[3];
    assert_ok(gvi_barycentric(3, x, w));
    assert_close(w[0], 0.5L, 0);
    assert_close(w[1], 0.5L, 0);
    assert_close(w[2], -1, 0);
}

static gvi_real big_x[MOST], big_w[MOST], big_f[MOST];

TEST(weights_of_1000_points_neither_overflow_nor_vanish)
{
    for (int k = 0; k < 3; ++k) {
        families[k](MOST, big_x);
        if (k == 0 && KIND == 1) {     /* equispaced, from 1e-299 to 1: not in float */
            assert_status(gvi_barycentric(MOST, big_x, big_w), GVI_E_NODES);
            continue;
        }
        assert_ok(gvi_barycentric(MOST, big_x, big_w));
        check_weights(MOST, big_x, big_w);
        for (int j = 0; j < MOST; ++j) assert_false(same(big_w[j], 0));
    }
}

/* x scaled by a power of 2 has the same weights to the bit, and by another
   factor the weights of the points that rounding leaves. */
TEST(weights_do_not_depend_on_the_unit_of_the_nodes)
{
    const gvi_real units[] = { (gvi_real)1e-30L, (gvi_real)1e30L, (gvi_real)ldexp(1, -100),
                               (gvi_real)ldexp(1, 100) };
    gvi_real x[FEW], y[FEW], w[FEW], v[FEW];
    EACH_NODES(x, n, FEW)
        for (int unit = 0; unit < COUNT(units); ++unit) {
            for (int i = 0; i < n; ++i) y[i] = x[i]*units[unit];
            assert_ok(gvi_barycentric(n, x, w));
            assert_ok(gvi_barycentric(n, y, v));
            check_weights(n, y, v);
            for (int i = 0; unit >= 2 && i < n; ++i) assert_true(same(w[i], v[i]));
        }
}

static void check_values(int n, const gvi_real *x, const gvi_real *f)
{
    gvi_real w[FEW], t[PLACES];
    assert_ok(gvi_barycentric(n, x, w));
    int count = places(n, x, t);
    for (int i = 0; i < count; ++i) {
        struct exact e = exact_value(n, x, f, t[i]);
        assert_close(gvi_interpolate(n, x, w, f, t[i]), e.p, value_bound(n, e));
    }
}

TEST(interpolation_is_that_of_lagrange_at_near_and_far_from_nodes)
{
    gvi_real x[FEW], f[FEW];
    EACH_NODES(x, n, FEW) {
        for (int i = 0; i < n; ++i) f[i] = random_unit();
        check_values(n, x, f);
        for (int i = 0; i < n; ++i) f[i] = i % 2 ? -1 : 1;
        check_values(n, x, f);
        for (int i = 0; i < n; ++i) f[i] = i == n/2;
        check_values(n, x, f);
    }
}

TEST(interpolation_is_exact_at_nodes)
{
    gvi_real x[FEW], w[FEW], f[FEW], l[FEW];
    EACH_NODES(x, n, FEW) {
        assert_ok(gvi_barycentric(n, x, w));
        for (int i = 0; i < n; ++i) f[i] = random_unit();
        for (int i = 0; i < n; ++i) {
            assert_true(same(gvi_interpolate(n, x, w, f, x[i]), f[i]));
            gvi_basis(n, x, w, x[i], l);
            for (int j = 0; j < n; ++j) assert_true(same(l[j], i == j));
        }
    }
}

TEST(interpolation_next_to_a_node_at_zero_survives_the_smallest_distances)
{
    const gvi_real x[] = { -1, 0, (gvi_real)0.5L, 2 }, f[] = { 3, -2, 7, 1 };
    const gvi_real near[] = { LEAST, 3*LEAST, 1/GREAT, (gvi_real)EPS*EPS, (gvi_real)EPS*EPS*EPS };
    gvi_real w[4], l[4];
    wide unused;
    assert_ok(gvi_barycentric(4, x, w));
    for (int k = 0; k < COUNT(near); ++k)
        for (int side = -1; side <= 1; side += 2) {
            gvi_real t = (gvi_real)side*near[k];
            assert_true(same(gvi_interpolate(4, x, w, f, t), -2));
            gvi_basis(4, x, w, t, l);
            assert_close(l[1], 1, EPS);
            assert_close(l[0], (wide)t*lagrange_derivative(4, x, 0, 0, &unused), 32*UNIT*wide_abs(t) + NORMAL);
            assert_close(gvi_interpolate_derivative(4, x, w, f, t),
                         gvi_interpolate_derivative(4, x, w, f, 0), 100*EPS);
        }
}

static void check_basis(int n, const gvi_real *x)
{
    gvi_real w[FEW], l[FEW], t[PLACES];
    assert_ok(gvi_barycentric(n, x, w));
    int count = places(n, x, t);
    for (int i = 0; i < count; ++i) {
        wide sum = 0, lebesgue = 0;
        for (int j = 0; j < n; ++j) lebesgue += wide_abs(lagrange(n, x, j, t[i]));
        gvi_basis(n, x, w, t[i], l);
        for (int j = 0; j < n; ++j) {
            assert_close(l[j], lagrange(n, x, j, t[i]), 4*n*UNIT*lebesgue + NORMAL);
            sum += l[j];
        }
        assert_close(sum, 1, 4*n*UNIT*lebesgue);
    }
}

TEST(basis_is_that_of_lagrange_and_sums_to_one)
{
    gvi_real x[FEW];
    EACH_NODES(x, n, FEW) check_basis(n, x);
}

static wide runge(wide t) { return 1/(1 + 25*t*t); }

/* 1.22^-1000 of truncation, and rounding that does not grow with n in practice:
   Higham's bound would be 6000 units times the Lebesgue constant. */
TEST(runge_by_1000_chebyshev_points_is_exact_to_rounding)
{
    for (int k = 1; k <= 2; ++k) {
        families[k](MOST, big_x);
        assert_ok(gvi_barycentric(MOST, big_x, big_w));
        for (int i = 0; i < MOST; ++i) big_f[i] = (gvi_real)runge(big_x[i]);
        for (int i = -999; i <= 999; i += 3) {
            gvi_real t = (gvi_real)i/999;
            assert_close(gvi_interpolate(MOST, big_x, big_w, big_f, t), runge(t), 64*EPS);
        }
    }
}

static void check_derivatives(int n, const gvi_real *x, const gvi_real *f)
{
    gvi_real w[FEW], l[FEW], t[PLACES];
    assert_ok(gvi_barycentric(n, x, w));
    int count = places(n, x, t);
    for (int i = 0; i < count; ++i) {
        wide sum = 0, size = 0, exact = 0, greatest = 0, slopes[FEW];
        gvi_basis_derivative(n, x, w, t[i], l);
        for (int j = 0; j < n; ++j) {
            wide condition, slope = slopes[j] = lagrange_derivative(n, x, j, t[i], &condition);
            size += condition;
            sum += l[j];
            exact += slope*f[j];
            if (wide_abs(f[j]) > greatest) greatest = wide_abs(f[j]);
        }
        for (int j = 0; j < n; ++j)
            assert_close(l[j], slopes[j], 4*n*UNIT*size + NORMAL);
        assert_close(sum, 0, n*UNIT*size);
        assert_close(gvi_interpolate_derivative(n, x, w, f, t[i]), exact,
                     8*n*UNIT*size*greatest + NORMAL);
    }
}

TEST(derivatives_are_those_of_lagrange_at_near_and_far_from_nodes)
{
    gvi_real x[FEW], f[FEW];
    for (int k = 0; k < COUNT(families); ++k)
        for (int n = 1; n <= FEW; n += n < 9 ? 1 : 4) {
            families[k](n, x);
            for (int i = 0; i < n; ++i) f[i] = random_unit();
            check_derivatives(n, x, f);
        }
}

TEST(constants_have_exactly_the_derivative_zero)
{
    gvi_real x[FEW], w[FEW], f[FEW], t[PLACES];
    EACH_NODES(x, n, FEW) {
        assert_ok(gvi_barycentric(n, x, w));
        for (int i = 0; i < n; ++i) f[i] = (gvi_real)0.1L;
        int count = places(n, x, t);
        for (int i = 0; i < count; ++i) {
            assert_true(same(gvi_interpolate_derivative(n, x, w, f, t[i]), 0));
            assert_true(same(gvi_interpolate(n, x, w, f, t[i]), f[0]));
        }
    }
}

TEST(coinciding_nodes_are_refused)
{
    gvi_real x[] = { 0, 1, 2, 1 }, zeros[] = { 0, -(gvi_real)0 }, w[4];
    assert_status(gvi_barycentric(4, x, w), GVI_E_NODES);
    assert_status(gvi_barycentric(2, zeros, w), GVI_E_NODES);
    const gvi_real near = (gvi_real)sqrt(MIN)*EPS, clustered[] = { 0, near, 2*near, 1 };   // w_3/w_0 = 2 near^2 is no number
    assert_status(gvi_barycentric(4, clustered, w), GVI_E_NODES);
    x[3] = next_after(1, 2);
    assert_ok(gvi_barycentric(4, x, w));
    check_weights(4, x, w);
    zeros[1] = LEAST;
    assert_ok(gvi_barycentric(2, zeros, w));
    assert_true(same(w[0], -w[1]));
}

TEST(faulty_arguments_are_refused_and_leave_the_output_alone)
{
    const gvi_real x[] = { 0, 1 };
    const gvi_real bad[] = { (gvi_real)NAN, (gvi_real)INFINITY, -(gvi_real)INFINITY };
    gvi_real w[2] = { 7, 8 };
    assert_status(gvi_barycentric(0, x, w), GVI_E_ARGUMENT);
    assert_status(gvi_barycentric(-1, x, w), GVI_E_ARGUMENT);
    assert_status(gvi_barycentric(INT32_MIN, x, w), GVI_E_ARGUMENT);
    assert_status(gvi_barycentric(2, NULL, w), GVI_E_ARGUMENT);
    assert_status(gvi_barycentric(2, x, NULL), GVI_E_ARGUMENT);
    for (int k = 0; k < COUNT(bad); ++k)
        for (int where = 0; where < 2; ++where) {
            gvi_real y[] = { 0, 1 };
            y[where] = bad[k];
            assert_status(gvi_barycentric(2, y, w), GVI_E_ARGUMENT);
        }
    assert_true(same(w[0], 7) && same(w[1], 8));
}

RUN_TESTS(NULL, NULL)
