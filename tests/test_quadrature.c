/* Gauss and Lobatto rules against an independent 40-digit table, and the
   measured order of rules. */
#include "gvi_test.h"
#include "wide.h"
#include "data/nodes.h"

#define MOST 1024
static gvi_real c[MOST], b[MOST];

typedef gvi_status make_fn(int n, gvi_real *c, gvi_real *b);

/* One kind of rule with its table; degree 2n - loss is the last exact one. */
struct kind {
    const char *name;
    make_fn *make;
    const struct node_rule *rules;
    int count;
    const struct node *nodes;
    int loss;
};

static const struct kind kinds[] = {
    { "Gauss",   gvi_gauss,   gauss_rules,   COUNT(gauss_rules),   gauss_nodes,   1 },
    { "Lobatto", gvi_lobatto, lobatto_rules, COUNT(lobatto_rules), lobatto_nodes, 3 },
};

/* Twofold arithmetic leaves one final rounding, 1/2 eps, at every n up to 1024
   and in every precision: values are correctly rounded but for near-ties.  The
   table has a rounding of its own, to 28 digits and then to long double.
   Registers wider than the type (x87) spoil some of the twofold sums. */
#define ROUNDING (FLT_EVAL_METHOD == 0 || KIND == 3 ? 0.51L : 4)
#define ALLOWED (ROUNDING*(long double)EPS + (LDBL_EPSILON > EPS/2 ? LDBL_EPSILON/2 : 0) + 1e-28L)

static void check_relative(const char *name, char what, int n, int i,
                           gvi_real got, long double exact)
{
    long double error = fabsl((long double)got - exact);
    if (error <= ALLOWED*fabsl(exact)) return;
    print_error("%s n = %d: %c[%d] = %.21Lg, exact %.21Lg, off by %.3Lg eps\n", name, n, what, i,
                (long double)got, exact, error/fabsl(exact)/(long double)EPS);
    fail();
}

static void check_against_table(const struct kind *kind, const struct node_rule *rule)
{
    int n = rule->n;
    assert_ok(kind->make(n, c, b));
    for (int i = 0; i < n; ++i) {
        int j = 2*i < n ? i : n - 1 - i;
        const struct node *exact = kind->nodes + rule->first + j;
        check_relative(kind->name, 'c', n, i, c[i], i == j ? exact->c : 1 - exact->c);
        check_relative(kind->name, 'b', n, i, b[i], exact->b);
    }
}

TEST(gauss_nodes_and_weights_are_correctly_rounded)
{
    for (int k = 0; k < kinds[0].count; ++k) check_against_table(&kinds[0], &kinds[0].rules[k]);
}

TEST(lobatto_nodes_and_weights_are_correctly_rounded)
{
    for (int k = 0; k < kinds[1].count; ++k) check_against_table(&kinds[1], &kinds[1].rules[k]);
}

static void check_symmetry(const struct kind *kind, int n)
{
    assert_ok(kind->make(n, c, b));
    for (int i = 0; i < n; ++i) {
        assert_true(same(c[i] + c[n-1-i], 1));
        assert_true(same(b[i], b[n-1-i]));
        assert_true(b[i] > 0);
        assert_true(c[i] >= 0 && c[i] <= 1);
        if (i > 0) assert_true(c[i] > c[i-1]);
    }
    if (n % 2) assert_true(same(2*c[n/2], 1));
}

TEST(rules_are_symmetric_and_ascending_at_every_size)
{
    for (int k = 0; k < COUNT(kinds); ++k) {
        for (int n = k + 1; n <= 100; ++n) check_symmetry(&kinds[k], n);
        check_symmetry(&kinds[k], 511);
        check_symmetry(&kinds[k], 512);
    }
}

/* sum b P_degree(2c - 1), and by how much it can move, in units of the relative
   error of nodes and weights. */
static wide legendre_moment(int n, int degree, wide *sensitivity)
{
    wide sum = 0;
    *sensitivity = 0;
    for (int i = 0; i < n; ++i) {
        wide x = 2*(wide)c[i] - 1, P = 1, before = 0, slope = 0;
        for (int k = 0; k < degree; ++k) {
            wide next = ((2*k + 1)*x*P - k*before)/(k + 1);
            slope = x*slope + (k + 1)*P;                  /* P_(k+1)' */
            before = P;
            P = next;
        }
        sum += b[i]*P;
        *sensitivity += b[i]*(wide_abs(P) + 2*c[i]*wide_abs(slope));
    }
    return sum;
}

/* Leading coefficient of P_2m over the square of that of P_m. */
static wide leading(int m)
{
    wide x = 1;
    for (int k = 1; k <= m; ++k) x *= (wide)(4*(m + k) - 2)*k/((wide)(m + k)*(4*k - 2));
    return x;
}

/* What a rule makes of the first Legendre polynomial that it cannot integrate:
   P_2m = leading P_m^2 + lower degrees, P_m^2 has the integral 1/(2m+1), the
   Gauss rule sees 0 and the Lobatto rule 1/m. */
static wide first_wrong_moment(int lobatto, int n)
{
    wide m = lobatto ? n - 1 : n;
    return leading((int)m)*((lobatto ? 1/m : 0) - 1/(2*m + 1));
}

static void check_degrees(int k, int n)
{
    wide sensitivity;
    int last = 2*n - kinds[k].loss;
    assert_ok(kinds[k].make(n, c, b));
    for (int degree = 0; degree <= last; ++degree) {
        wide sum = legendre_moment(n, degree, &sensitivity);
        assert_close(sum, degree == 0, ROUNDING*EPS*sensitivity);
    }
    wide sum = legendre_moment(n, last + 1, &sensitivity), wanted = first_wrong_moment(k, n);
    assert_close(sum, wanted, ROUNDING*EPS*sensitivity);
    if (n < 100) assert_true(wide_abs(wanted) > (wide)0.05);
}

TEST(rules_are_exact_to_their_degree_and_wrong_by_the_known_amount_beyond)
{
    if (!WIDE_IS_WIDER) skip();       /* the sum would round as much as it may be off */
    for (int k = 0; k < COUNT(kinds); ++k) {
        for (int n = k + 1; n <= 32; ++n) check_degrees(k, n);
        check_degrees(k, 64);
        check_degrees(k, 99);
    }
}

static void check_measured_order(const struct kind *kind, int n)
{
    assert_ok(kind->make(n, c, b));
    assert_int_equal(gvi_rule_order(n, c, b), 2*n + 1 - kind->loss);
}

/* The rounding of nodes and weights hides nothing at these sizes; 512 points
   pass as well, and take a second. */
static void check_measured_orders(const struct kind *kind)
{
    for (int n = 2; n <= 64; ++n) check_measured_order(kind, n);
    check_measured_order(kind, 100);
    check_measured_order(kind, 200);
}

TEST(order_of_gauss_is_twice_the_points)
{
    check_measured_order(&kinds[0], 1);
    check_measured_orders(&kinds[0]);
}

TEST(order_of_lobatto_is_two_less)
{
    check_measured_orders(&kinds[1]);
}

struct cotes { int n, order, denominator, weights[11]; };
static const struct cotes newton_cotes[] = {
    { 2,  2, 2,      { 1, 1 } },
    { 3,  4, 6,      { 1, 4, 1 } },
    { 4,  4, 8,      { 1, 3, 3, 1 } },
    { 5,  6, 90,     { 7, 32, 12, 32, 7 } },
    { 6,  6, 288,    { 19, 75, 50, 50, 75, 19 } },
    { 7,  8, 840,    { 41, 216, 27, 272, 27, 216, 41 } },
    { 8,  8, 17280,  { 751, 3577, 1323, 2989, 2989, 1323, 3577, 751 } },
    { 9,  10, 28350, { 989, 5888, -928, 10496, -4540, 10496, -928, 5888, 989 } },
    { 11, 12, 598752, { 16067, 106300, -48525, 272400, -260550, 427368,
                        -260550, 272400, -48525, 106300, 16067 } },
};

TEST(order_of_newton_cotes_rules_is_known)
{
    for (int k = 0; k < COUNT(newton_cotes); ++k) {
        const struct cotes *rule = &newton_cotes[k];
        for (int i = 0; i < rule->n; ++i) {
            c[i] = (gvi_real)i/(gvi_real)(rule->n - 1);
            b[i] = (gvi_real)rule->weights[i]/(gvi_real)rule->denominator;
        }
        assert_int_equal(gvi_rule_order(rule->n, c, b), rule->order);
    }
}

static void check_order(int n, const gvi_real *nodes, const gvi_real *weights, int order)
{
    gvi_real mirrored[8];
    assert_int_equal(gvi_rule_order(n, nodes, weights), order);
    for (int i = 0; i < n; ++i) mirrored[i] = 1 - nodes[i];
    assert_int_equal(gvi_rule_order(n, mirrored, weights), order);
}

#define Q(p, q) ((gvi_real)p/(gvi_real)q)

TEST(order_of_unsymmetric_and_open_rules_is_known)
{
    const gvi_real root6 = R(2.449489742783178098197284074705891391966),
                   root2 = R(1.414213562373095048801688724209698078570);
    const gvi_real rectangle[] = { 0 }, midpoint[] = { Q(1,2) }, one[] = { 1 };
    check_order(1, rectangle, one, 1);
    check_order(1, midpoint, one, 2);

    const gvi_real radau2[] = { Q(1,3), 1 }, radau2b[] = { Q(3,4), Q(1,4) };
    check_order(2, radau2, radau2b, 3);
    const gvi_real radau3[] = { (4 - root6)/10, (4 + root6)/10, 1 };
    const gvi_real radau3b[] = { (16 - root6)/36, (16 + root6)/36, Q(1,9) };
    check_order(3, radau3, radau3b, 5);

    const gvi_real milne[] = { Q(1,4), Q(1,2), Q(3,4) }, milneb[] = { Q(2,3), Q(-1,3), Q(2,3) };
    check_order(3, milne, milneb, 4);
    const gvi_real clenshaw[] = { 0, (2 - root2)/4, Q(1,2), (2 + root2)/4, 1 };
    const gvi_real curtis[] = { Q(1,30), Q(4,15), Q(2,5), Q(4,15), Q(1,30) };
    check_order(5, clenshaw, curtis, 6);

    /* right sum, wrong centre */
    const gvi_real third[] = { Q(1,3) };
    check_order(1, third, one, 1);
    const gvi_real ends[] = { 0, 1 }, uneven[] = { Q(3,4), Q(1,4) };
    check_order(2, ends, uneven, 1);
}

TEST(order_is_zero_when_the_weights_do_not_sum_to_one)
{
    static const gvi_real x[] = { 0, Q(1,2), 1 };
    gvi_real simpson[] = { Q(1,6), Q(2,3), Q(1,6) }, zero[] = { 0, 0, 0 };
    assert_int_equal(gvi_rule_order(3, x, simpson), 4);
    assert_int_equal(gvi_rule_order(3, x, zero), 0);
    simpson[1] += 100*EPS;
    assert_int_equal(gvi_rule_order(3, x, simpson), 0);
    for (int n = 1; n <= 32; ++n) {
        assert_ok(gvi_gauss(n, c, b));
        for (int i = 0; i < n; ++i) b[i] *= 2;                 /* weights for [-1,1] */
        assert_int_equal(gvi_rule_order(n, c, b), 0);
    }
}

TEST(order_sees_a_rule_that_was_copied_with_a_mistake)
{
    for (int n = 2; n <= 24; ++n) {
        assert_ok(gvi_gauss(n, c, b));
        gvi_real shift = 200*EPS/(c[1] - c[0]);     /* the sum stays, the centre moves 200 eps */
        b[0] -= shift;
        b[1] += shift;
        assert_int_equal(gvi_rule_order(n, c, b), 1);
        assert_ok(gvi_gauss(n, c, b));
        c[0] += 200*EPS/b[0];
        assert_int_equal(gvi_rule_order(n, c, b), 1);
    }
}

TEST(order_is_minus_one_for_nodes_that_cannot_be)
{
    const gvi_real below = -(gvi_real)EPS, above = 1 + (gvi_real)EPS;
    const gvi_real bad[] = { below, above, -1, 2, (gvi_real)NAN, (gvi_real)INFINITY,
                             -(gvi_real)INFINITY };
    const gvi_real weights[] = { Q(1,2), Q(1,2) };
    for (int k = 0; k < COUNT(bad); ++k)
        for (int where = 0; where < 2; ++where) {
            gvi_real x[2] = { Q(1,4), Q(1,4) };
            x[where] = bad[k];
            assert_int_equal(gvi_rule_order(2, x, weights), -1);
        }

    const gvi_real equal[] = { Q(1,2), 0, Q(1,2) }, zeros[] = { -(gvi_real)0, 0 };
    const gvi_real three[] = { Q(1,4), Q(1,2), Q(1,4) };
    assert_int_equal(gvi_rule_order(3, equal, three), -1);
    assert_int_equal(gvi_rule_order(2, zeros, weights), -1);
}

TEST(order_is_never_that_of_a_rule_with_weights_that_are_not_finite)
{
    const gvi_real x[] = { 0, 1 }, nan[] = { (gvi_real)NAN, Q(1,2) },
                   infinite[] = { (gvi_real)INFINITY, -(gvi_real)INFINITY };
    assert_true(gvi_rule_order(2, x, nan) <= 0);
    assert_true(gvi_rule_order(2, x, infinite) <= 0);
    /* exact for parabolas, by weights that cancel: their rounding is not an error of the rule */
    const gvi_real e = Q(1,100), near[] = { 0, e, 2*e }, last = (Q(1,3) - e/2)/(2*e*e), mid = (e - Q(1,3))/(e*e),
                   big[] = { 1 - mid - last, mid, last };
    assert_int_equal(gvi_rule_order(3, near, big), 3);
}

static void check_refused(make_fn *make, int n, gvi_real *x, gvi_real *y)
{
    if (x) x[0] = 7, x[1] = 8;
    if (y) y[0] = 9, y[1] = 10;
    assert_status(make(n, x, y), GVI_E_ARGUMENT);
    if (x) assert_true(same(x[0], 7) && same(x[1], 8));
    if (y) assert_true(same(y[0], 9) && same(y[1], 10));
}

TEST(rules_refuse_faulty_arguments_and_leave_the_output_alone)
{
    gvi_real x[2], y[2];
    for (int k = 0; k < COUNT(kinds); ++k) {
        check_refused(kinds[k].make, 0, x, y);
        check_refused(kinds[k].make, -1, x, y);
        check_refused(kinds[k].make, INT32_MIN, x, y);
        check_refused(kinds[k].make, 2, NULL, y);
        check_refused(kinds[k].make, 2, x, NULL);
        check_refused(kinds[k].make, 2, NULL, NULL);
    }
    check_refused(gvi_lobatto, 1, x, y);
}

TEST(order_refuses_faulty_arguments)
{
    const gvi_real x[] = { Q(1,2) }, y[] = { 1 };
    assert_int_equal(gvi_rule_order(0, x, y), -1);
    assert_int_equal(gvi_rule_order(-1, x, y), -1);
    assert_int_equal(gvi_rule_order(1, NULL, y), -1);
    assert_int_equal(gvi_rule_order(1, x, NULL), -1);
}

RUN_TESTS(NULL, NULL)
