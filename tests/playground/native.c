/* The playground's program, natively: runs of every scene, each printed with all the bits of its
   end, for bits.mjs to repeat in WebAssembly.  A line: scene on degree rule tolerance method
   parameter, then status, evaluations, steps, q, p or v of a rival, energy and |g|.
   method -1: `parameter` is the step; the constraint that is last in the list breaks after 20, and is
   mounted again after 20 more, which is refused, but where what was held stays.
   method -2: gvi.h by the dial, which `parameter` is.
   A file that bits.mjs writes holds L and H as the page hands them over; own K: from here on, the K-th. */
#include "../../docs/playground/wasm.c"
#include <inttypes.h>
#include <stdio.h>

static void bits(double x)
{
    uint64_t u;
    memcpy(&u, &x, sizeof u);
    printf(" %016" PRIx64, x < 0 || x >= 0 ? u : UINT64_C(0x7ff8000000000000));
}

static void run(int scene, unsigned on, int degree, int rule, double tolerance, int method, double parameter)
{
    const double span = scene_number(scene, 3, 0)/4;
    for (int i = 0; i < SCENE_PARAMETERS; ++i) parameters()[i] = scene_number(scene, 33, i);
    const int dial = method == -2;
    parameters()[SCENE_PARAMETERS] = dial ? parameter : 0;
    int status = world_open(1, scene, on, degree, rule, tolerance, 0);
    parameters()[SCENE_PARAMETERS] = 0;
    if (!status) status = race_begin(1, dial ? 0 : method, parameter, span);
    while (!status) status = race_steps(1, 1000);
    printf("%d %u %d %d %.17g %d %.17g: %d", scene, on, degree, rule, tolerance, method, parameter, status);
    if (status == 1) {
        const int n = worlds[1].scene->n;
        bits(race_number(1, 1));
        bits(race_number(1, 0));
        const double *q = race_end(1);
        for (int i = 0; i < n; ++i) bits(q[i]);
        for (int i = 0; i < n; ++i) bits(method > 0 ? world_number(1, 43, n + i) : world_number(1, 31, i));
        bits(method > 0 ? world_number(1, 42, 0) : world_number(1, 20, 0));
        bits(method > 0 ? world_number(1, 44, 0) : world_number(1, 22, 0));
    }
    printf("\n");
}

static void broken(int scene, unsigned on, int degree, int rule, double h)
{
    unsigned rod = 0;
    for (int e = 0; e < 32; ++e)
        if (on >> e & 1 && scene_number(scene, 22, e) >= GVI_CONSTRAINT) rod = 1u << e;
    for (int i = 0; i < SCENE_PARAMETERS; ++i) parameters()[i] = scene_number(scene, 33, i);
    printf("%d %u %d %d 0 -1 %.17g:", scene, on, degree, rule, h);
    for (int k = 0; k < 3; ++k) {
        const int status = world_open(0, scene, k == 1 ? on & ~rod : on, degree, rule, 0, k > 0);
        printf(" %d %d", status, status ? 0 : world_advance(0, h, 20));
        for (int i = 0; i < worlds[0].scene->n; ++i) bits(world_number(0, 30, i)), bits(world_number(0, 31, i));
        bits(world_number(0, 22, 0));
        for (int e = 0; e < 4; ++e) bits(world_number(0, 3, e));
    }
    printf("\n");
}

static void all_runs(int s, unsigned on)
{
    const double h = scene_number(s, 2, 0);
    run(s, on, 1, RULE_GAUSS, 0, 0, h/8);
    run(s, on, 4, RULE_GAUSS, 0, 0, h/2);
    run(s, on, 8, RULE_GAUSS, 0, 0, h);
    run(s, on, 16, RULE_GAUSS, 0, 0, h);
    run(s, on, 8, RULE_GAUSS, 1e-9, 0, h);
    run(s, on, 3, RULE_GAUSS_MORE, 0, 0, h/2);
    run(s, on, 5, RULE_LOBATTO, 0, 0, h/2);
    run(s, on, 1, RULE_VERLET, 0, 0, h/16);
    run(s, on, 1, RULE_KICKS8, 0, 0, h/2);
    run(s, on, 8, RULE_GAUSS, 0, 0, 16*h);                  /* too large: Newton, or a failure */
    for (int j = 6; j <= 12; j += 6) run(s, on, 8, RULE_GAUSS, 0, -2, j > 6 ? 1e-12 : 1e-6);
    run(s, on, 8, RULE_GAUSS, 0, RIVAL_VERLET, h/16);
    run(s, on, 8, RULE_GAUSS, 0, RIVAL_RK4, h/16);
    run(s, on, 8, RULE_GAUSS, 0, RIVAL_DOP853, 1e-8);
}

static int typed(const char *path)
{
    FILE *file = fopen(path, "rb");
    double given[5];
    if (!file) return perror(path), 1;
    for (int k = 0; fread(given, sizeof *given, 5, file) == 5; ++k) {
        if (fread(own_typed, sizeof own_typed, 1, file) != 1) break;
        printf("own %d: %s\n", k, own_take((int)given[0], (int)given[1], (int)given[2], (int)given[3], given[4]));
        all_runs(SCENES, 1);
    }
    return fclose(file);
}

int main(int argc, char **argv)
{
    for (int s = 0; s < SCENES; ++s) {
        const int rows = (int)scene_number(s, 20, 0);
        unsigned first = 0, all = 0;
        for (int e = 0; e < rows; ++e) {
            if (scene_number(s, 21, e) > 0) first |= 1u << e;
            if (scene_number(s, 22, e) < GVI_CLOCK) all |= 1u << e;
        }
        const unsigned sets[] = { first, all, first | (all + 1), 1 };
        for (int k = 0; k < 4; ++k) {
            const unsigned on = sets[k] & ((1u << rows) - 1);
            all_runs(s, on);
        }
    }
    for (int s = 0; s < SCENES; ++s)
        for (int e = 0; e < (int)scene_number(s, 20, 0); ++e)
            if (scene_number(s, 22, e) >= GVI_CONSTRAINT) {
                broken(s, (2u << e) - 1, 8, RULE_GAUSS, scene_number(s, 2, 0));
                /* where M depends on q, a rule needs as many points as degrees */
                broken(s, (2u << e) - 1, 3, *scene_text(s, 7, 0) ? RULE_GAUSS : RULE_LOBATTO, scene_number(s, 2, 0)/8);
            }
    run(0, 1, 99, RULE_GAUSS, 0, 0, 0.1);                       /* what the library refuses */
    run(0, 1, 8, RULE_GAUSS, 0, 0, 0);
    run(99, 1, 8, RULE_GAUSS, 0, 0, 0.1);
    run(0, 1, 8, 99, 0, 0, 0.1);
    run(0, 1, 8, RULE_GAUSS, 2, 0, 0.1);
    run(0, 1, 1, RULE_VERLET, 0, -2, 1e-6);
    return argc > 1 ? typed(argv[1]) : 0;
}
